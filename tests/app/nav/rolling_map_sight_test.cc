// What the rolling map takes back, and what it does not, by what the camera shows.
#include <gtest/gtest.h>

#include "app/nav/rolling_map.h"
#include "tests/support/rolling_map_world.h"

namespace lakshya {
namespace {

using RollingMapSightTest = test::RollingMapWorld;
using test::kSecondNs;

// A matcher has gone on with the floor into a wall that shows nothing; nearer to it there is none.
TEST_F(RollingMapSightTest, FreeGroundThatIsLookedAtAndNotSeenIsTakenBack) {
  params.view = radians(40);
  configure();
  fill(kCellUnoccupied);
  add();
  block(15, 60, 0, 80, kCellUnknown);
  for (int i = 1; i < RollingMap::kDoubts; ++i)
    add();
  EXPECT_EQ(cell(17, 40), kCellUnoccupied);
  add();
  EXPECT_EQ(cell(17, 40), kCellUnknown);
  EXPECT_EQ(cell(18, 33), kCellUnknown);
  EXPECT_EQ(cell(14, 40), kCellUnoccupied);
  EXPECT_EQ(cell(25, 40), kCellUnoccupied);  // beyond 1.0 m and 1.2 m: too far away to say
  EXPECT_EQ(cell(15, 20), kCellUnoccupied);  // 52 degrees to the left: not in view
}

// Before a wall that shows nothing, 3 m away, floor seems to go on for the height of a window.
TEST_F(RollingMapSightTest, FloorThatGoesOnIntoTheUnknownEndsSooner) {
  params.row_m = 1 / (190 * 1.05);  // five rows: 0.22 m at 3 m
  configure();
  block(0, 30, 0, 80, kCellUnoccupied);
  add();
  EXPECT_EQ(cell(25, 40), kCellUnoccupied);
  EXPECT_EQ(cell(29, 40), kCellUnknown);
  EXPECT_EQ(cell(28, 40), kCellUnknown);
  block(30, 31, 0, 80, kCellObstacle);  // one that can be seen
  add();
  EXPECT_EQ(cell(29, 40), kCellUnoccupied);
}

// The board of a shelf, 0.85 m high and 1.9 m away: floor is seen below it in every frame, and the board in a few rows of the image.
TEST_F(RollingMapSightTest, ABoardThatIsStillInTheImageIsNotClearedByTheFloorBelow) {
  constexpr double kFocalBaseline = 200 * 0.12;
  params.camera.height_m = 1;
  params.sight = {
      .focal_px = 200, .baseline_m = 0.12, .center_u = 160, .center_v = 120, .height_m = 1, .depth_sigma = 0.01};
  configure();
  fill(kCellUnoccupied);
  block(18, 20, 38, 42, kCellObstacle, 850);
  add();
  Image<std::int16_t> disparity{320, 240, static_cast<std::int16_t>(16 * kFocalBaseline / 5)};
  for (int v = 133; v < 139; ++v) {
    for (int u = 0; u < 320; ++u)
      disparity.view().at(u, v) = static_cast<std::int16_t>(16 * kFocalBaseline / 1.9);
  }
  fill(kCellUnoccupied);
  const auto see = [&] {
    at.time_ns += kSecondNs / 10;
    ASSERT_EQ(map.add(frame(), at, disparity.view()), Status::ok);
    ASSERT_EQ(map.view(type.view(), shown.view()), Status::ok);
  };
  for (int k = 0; k < 20; ++k)
    see();
  EXPECT_EQ(cell(18, 40), kCellObstacle);
  for (int v = 133; v < 139; ++v) {  // it has been taken away
    for (int u = 0; u < 320; ++u)
      disparity.view().at(u, v) = static_cast<std::int16_t>(16 * kFocalBaseline / 5);
  }
  for (int k = 0; k < 6; ++k)
    see();
  EXPECT_EQ(cell(18, 40), kCellUnoccupied);
}

// A person of 0.7 m mean height has stood 0.8 m before the vehicle, where it sees no floor, and has gone on.
class RollingMapThroughTest : public test::RollingMapWorld {
 protected:
  static constexpr double kFocalBaseline = 200 * 0.12;

  RollingMapThroughTest() {
    params.camera.height_m = 1;
    params.sight = {
        .focal_px = 200, .baseline_m = 0.12, .center_u = 160, .center_v = 120, .height_m = 1, .depth_sigma = 0.01};
  }
  void stand_before_it(int height_mm) {
    configure();
    fill(kCellUnknown);
    block(7, 9, 38, 42, kCellObstacle, height_mm);
    add();
    fill(kCellUnknown);
  }
  void see(double depth_m) {
    Image<std::int16_t> disparity{320, 240, static_cast<std::int16_t>(16 * kFocalBaseline / depth_m)};
    for (int k = 0; k < 6; ++k) {
      at.time_ns += kSecondNs / 10;
      ASSERT_EQ(map.add(frame(), at, disparity.view()), Status::ok);
    }
    ASSERT_EQ(map.view(type.view(), shown.view()), Status::ok);
  }
};

TEST_F(RollingMapThroughTest, WhatIsSeenThroughLeavesUnknownGround) {
  stand_before_it(700);
  see(4);
  EXPECT_EQ(cell(8, 40), kCellUnknown);
}

TEST_F(RollingMapThroughTest, WhatIsStillThereStays) {
  stand_before_it(700);
  see(0.8);
  EXPECT_EQ(cell(8, 40), kCellObstacle);
}

TEST_F(RollingMapThroughTest, WhatIsTooLowToBeSeenFromSoNearStays) {
  stand_before_it(250);
  see(4);
  EXPECT_EQ(cell(8, 40), kCellObstacle);
}

TEST_F(RollingMapSightTest, WhatCameToFreeGroundIsKnownAsSuch) {
  configure();
  fill(kCellUnoccupied);
  block(30, 32, 0, 80, kCellUnknown);
  for (int k = 0; k < 5; ++k)
    add();
  fill(kCellUnoccupied);
  block(20, 22, 30, 50, kCellObstacle);
  block(30, 32, 0, 80, kCellObstacle);
  add();
  EXPECT_TRUE(map.was_free(21, 0));   // 2.1 m ahead
  EXPECT_FALSE(map.was_free(31, 0));  // a wall that was always there
  EXPECT_FALSE(map.was_free(31, 1000));
  for (int k = 0; k < RollingMap::kMostFree; ++k)
    add();
  EXPECT_FALSE(map.was_free(21, 0));  // it stands
}

// Near by, three frames add up to as much as there is; far away less is believed for good.
TEST_F(RollingMapSightTest, WhatWasSeenFromFarAwayOnlyIsForgottenSooner) {
  params.keep_s = 2;
  configure();
  fill(kCellUnknown);
  block(15, 16, 40, 41, kCellObstacle);
  block(55, 56, 40, 41, kCellObstacle);
  for (int k = 0; k < 10; ++k)
    add();
  EXPECT_EQ(cell(15, 40), kCellObstacle);
  EXPECT_EQ(cell(55, 40), kCellObstacle);
  fill(kCellUnknown);
  add(4);
  EXPECT_EQ(cell(15, 40), kCellObstacle);
  EXPECT_EQ(cell(55, 40), kCellUnknown);
  add(3);
  EXPECT_EQ(cell(15, 40), kCellUnknown);
}

// A wall across the way with a doorway in it: what lies beyond the wall is not known, nor is the doorway.
TEST_F(RollingMapSightTest, ForTheRouteAWallIsThickBehindAndNotBesideItsEnd) {
  configure();
  fill(kCellUnknown);
  block(30, 31, 0, 40, kCellObstacle);  // 3 m ahead, to the left of straight ahead
  add();
  add();
  Image<std::uint8_t> window(80, 80, kCellUnknown);
  ASSERT_EQ(map.window(0, -40, window.view()), Status::ok);
  const auto at_cell = [&](int x, int y) { return window.view().at(x, y + 40); };
  EXPECT_EQ(at_cell(30, 5), kCellObstacle);
  EXPECT_EQ(at_cell(31, 5), kCellObstacle);
  EXPECT_EQ(at_cell(32, 5), kCellObstacle);
  EXPECT_EQ(at_cell(33, 5), kCellUnknown);
  EXPECT_EQ(at_cell(29, 5), kCellUnknown);
  EXPECT_EQ(at_cell(30, 0), kCellObstacle);
  EXPECT_EQ(at_cell(30, -1), kCellUnknown);
  // From 0.95 m away its end will not come into view any more.
  at.pose.east_m = 2.1;
  fill(kCellUnknown);
  add();
  ASSERT_EQ(map.window(0, -40, window.view()), Status::ok);
  EXPECT_EQ(at_cell(30, -2), kCellObstacle);
  EXPECT_EQ(at_cell(28, 0), kCellObstacle);
}

// What was put behind a wall from far away could never be looked at from before it.
TEST_F(RollingMapSightTest, BehindWhatIsSeenNowADistantViewIsForgotten) {
  configure();
  fill(kCellUnknown);
  block(50, 51, 38, 42, kCellObstacle);
  block(18, 19, 60, 62, kCellObstacle);
  for (int k = 0; k < 5; ++k)
    add();
  EXPECT_EQ(cell(50, 40), kCellObstacle);
  fill(kCellUnknown);
  block(30, 31, 30, 50, kCellObstacle);
  block(14, 15, 54, 60, kCellObstacle);
  for (int k = 0; k < 8; ++k)
    add();
  EXPECT_EQ(cell(50, 40), kCellUnknown);
  EXPECT_EQ(cell(18, 60), kCellObstacle);  // it was seen from near by
  fill(kCellUnknown);
  block(40, 41, 30, 50, kCellObstacle);
  for (int k = 0; k < 5; ++k)
    add();
  fill(kCellUnknown);
  for (int k = 0; k < 20; ++k)
    add();
  EXPECT_EQ(cell(40, 40), kCellObstacle);  // nothing hides it
}

// From afar the matcher carries the floor on into a wall that shows nothing; from near by there is none.
TEST_F(RollingMapSightTest, WhereItWasLookedInVainFromNearByFloorFromFarAwayDoesNotCount) {
  params.view = radians(30);
  params.blind_m = 1;
  params.keep_s = 2;
  configure();
  fill(kCellUnoccupied);
  add();
  EXPECT_FALSE(map.looked_in_vain(20, 0));
  block(16, 60, 0, 80, kCellUnknown);
  for (int k = 0; k < RollingMap::kDoubts; ++k) {
    EXPECT_EQ(cell(20, 40), kCellUnoccupied);
    add();
  }
  EXPECT_EQ(cell(20, 40), kCellUnknown);
  EXPECT_TRUE(map.looked_in_vain(20, 0));
  EXPECT_FALSE(map.looked_in_vain(20, 19));  // beyond the border of the view
  EXPECT_FALSE(map.looked_in_vain(23, 0));   // too far away for a judgement
  EXPECT_FALSE(map.looked_in_vain(20, 1000));
  // 2 m back it counts as free ground again only after some time; from there on it is free in one frame.
  fill(kCellUnoccupied);
  at.pose.east_m -= 2;
  add();
  EXPECT_EQ(cell(40, 40), kCellUnknown);
  EXPECT_TRUE(map.looked_in_vain(20, 0));
  at.pose.east_m += 2;
  add();
  EXPECT_EQ(cell(20, 40), kCellUnoccupied);
  EXPECT_FALSE(map.looked_in_vain(20, 0));
  block(16, 60, 0, 80, kCellUnknown);
  for (int k = 0; k < RollingMap::kDoubts; ++k)
    add();
  at.pose.east_m -= 2;
  add(2.5 * params.keep_s);
  EXPECT_TRUE(map.looked_in_vain(20, 0));
  add(params.keep_s);
  EXPECT_FALSE(map.looked_in_vain(20, 0));
}

// What hides the floor is no reason to doubt it.
TEST_F(RollingMapSightTest, BehindAnObstacleNothingIsLookedForInVain) {
  params.view = radians(30);
  params.blind_m = 1;
  configure();
  fill(kCellUnknown);
  block(13, 14, 36, 44, kCellObstacle);
  for (int k = 0; k < 2 * RollingMap::kDoubts; ++k)
    add();
  EXPECT_FALSE(map.looked_in_vain(20, 0));
  EXPECT_TRUE(map.looked_in_vain(16, 8));
}

}  // namespace
}  // namespace lakshya

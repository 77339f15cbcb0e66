#include "app/nav/rolling_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/count_allocations.h"
#include "tests/support/rolling_map_world.h"

namespace lakshya {
namespace {

using RollingMapTest = test::RollingMapWorld;
using test::kSecondNs;

TEST_F(RollingMapTest, FloorWithHolesStaysFree) {
  params.view = radians(40);
  configure();
  for (int i = 0; i < 30; ++i) {
    fill(kCellUnoccupied);
    if (i % RollingMap::kDoubts != 0) block(15, 20, 35, 45, kCellUnknown);
    add();
    ASSERT_EQ(cell(17, 40), kCellUnoccupied) << i;
  }
}

TEST_F(RollingMapTest, AFrameOfTheStandingVehicleIsShownAsItIs) {
  configure();
  fill(kCellUnoccupied);
  block(10, 12, 30, 33, kCellObstacle);
  block(40, 60, 0, 80, kCellUnknown);
  add();
  for (int r = 5; r < 60; ++r) {
    for (int c = 0; c < 80; ++c)
      ASSERT_EQ(cell(r, c), type.view().at(c, r)) << r << " " << c;
  }
}

// Rule a: one noisy cell far away is in doubt, and gone with the next frame.
TEST_F(RollingMapTest, OneFarCellIsInDoubtUntilASecondFrameShowsIt) {
  configure();
  fill(kCellUnoccupied);
  block(50, 51, 40, 41, kCellObstacle);
  add();
  EXPECT_EQ(cell(50, 40), kCellUnknown);
  fill(kCellUnoccupied);
  for (int i = 0; i < 3; ++i)
    add();
  EXPECT_EQ(cell(50, 40), kCellUnoccupied);
  block(50, 51, 40, 41, kCellObstacle);
  add();
  add();
  EXPECT_EQ(cell(50, 40), kCellObstacle);
}

// Rule b.
TEST_F(RollingMapTest, OneNearCellIsBelievedAtOnceAndNearGrowsWithTheSpeed) {
  configure();
  fill(kCellUnoccupied);
  block(19, 20, 40, 41, kCellObstacle);  // 1.95 m
  block(25, 26, 40, 41, kCellObstacle);
  add();
  EXPECT_EQ(cell(19, 40), kCellObstacle);
  EXPECT_EQ(cell(25, 40), kCellUnknown);
  // 2 m/s: 0.5 m until the brakes act, 1 m of braking.
  fill(kCellUnoccupied);
  add();
  at.pose.east_m += 0.2;
  block(32, 33, 44, 45, kCellObstacle);
  add();
  EXPECT_EQ(cell(32, 44), kCellObstacle);
}

// Rule c: somebody walks across; a second later nothing is left of it.
TEST_F(RollingMapTest, WhatIsSeenFreeAgainIsForgottenSoon) {
  configure();
  for (int i = 0; i < 20; ++i) {
    fill(kCellUnoccupied);
    block(15, 18, 20 + i, 24 + i, kCellObstacle, 800);
    add();
    EXPECT_LE(obstacles(), 12 + 3 * 6);
  }
  fill(kCellUnoccupied);
  for (int i = 0; i < 7; ++i)
    add();
  EXPECT_EQ(obstacles(), 0);
  EXPECT_EQ(cell(16, 35), kCellUnoccupied);
}

// Rule d: a low box that has got into the blind zone, then beside the vehicle, then behind it and into view again.
TEST_F(RollingMapTest, WhatIsNotSeenStaysUntilItsTimeIsOver) {
  configure();
  fill(kCellUnoccupied);
  block(20, 22, 44, 46, kCellObstacle, 150);
  for (int i = 0; i < 2; ++i)
    add();
  ASSERT_EQ(obstacles(), 4);
  for (int i = 1; i <= 18; ++i) {
    fill(kCellUnoccupied);
    block(0, 16, 0, 80, kCellUnknown);  // blind
    // The box, as long as it is not in the blind zone.
    if (20 - i >= 16) block(20 - i, 22 - i, 44, 46, kCellObstacle, 150);
    at.pose.east_m += 0.1;
    add();
    ASSERT_EQ(obstacles_near(2.1 - 0.1 * i, -0.5, 1.5), 4) << i;
    ASSERT_EQ(obstacles(), 4) << i;
  }
  fill(kCellUnknown);
  // So near it stays for as long as the vehicle stands there, 1.2 m away for its time: three of keep_s for what was seen often.
  add(10 * params.keep_s);
  EXPECT_EQ(obstacles(), 4);
  at.pose.east_m -= 1.2;
  add(3 * params.keep_s - 1);
  EXPECT_GE(obstacles(), 4);  // what was free about it is forgotten, and it has its thickness
  add(1.6);
  EXPECT_EQ(obstacles(), 0);
  EXPECT_EQ(cell(14, 45), kCellUnknown);
}

TEST_F(RollingMapTest, WhatOneFrameShowedIsForgottenSooner) {
  configure();
  fill(kCellUnoccupied);
  block(14, 16, 40, 42, kCellObstacle);
  add();
  fill(kCellUnknown);
  add(params.keep_s - 1);
  EXPECT_EQ(obstacles(), 4);
  add(1.6);
  EXPECT_EQ(obstacles(), 0);
}

// Rules e and f: the floor below a bar that has left the image at the top does not clear it; from far away, where the camera sees
// so high, the same floor does.
TEST_F(RollingMapTest, FloorBelowABarDoesNotClearIt) {
  for (const int bar_mm : {1000, 700}) {
    at = {};
    configure();
    fill(kCellUnoccupied);
    block(30, 31, 36, 44, kCellObstacle, bar_mm);
    add();
    add();
    ASSERT_EQ(obstacles(), 8);
    fill(kCellUnoccupied);
    // 0.6 m + 0.95 m * tan 20 deg = 0.95 m is the highest that is seen of what is now 0.95 m ahead.
    at.pose.east_m += 2.1;
    for (int i = 0; i < 12; ++i)
      add();
    EXPECT_EQ(obstacles(), bar_mm == 1000 ? 8 : 0);
    // Backing away: 3.05 m ahead the camera sees 1.71 m high. The bar has been taken away.
    at.pose.east_m -= 2.1;
    for (int i = 0; i < 20; ++i)
      add();
    EXPECT_EQ(obstacles(), 0);
  }
}

// A camera that looks to the left, 0.5 m ahead of the turning centre, sees 1.6 m high 1 m to its left, and no higher ahead.
TEST_F(RollingMapTest, TheUpperEdgeOfATurnedCamera) {
  params.camera = {.height_m = 0.6, .forward_m = 0.5, .left_m = 0.2, .yaw = radians(90), .angle = radians(45)};
  params.near_m = 6;
  configure();
  fill(kCellUnoccupied);
  block(20, 21, 30, 31, kCellObstacle, 1000);  // 0.95 m to the left
  block(20, 21, 36, 37, kCellObstacle, 1000);  // 0.35 m
  add();
  ASSERT_EQ(obstacles(), 2);
  fill(kCellUnoccupied);
  for (int i = 0; i < 10; ++i)
    add();
  EXPECT_EQ(cell(20, 30), kCellUnoccupied);
  EXPECT_EQ(cell(20, 36), kCellObstacle);
}

TEST_F(RollingMapTest, NoObstacleIsBelowTheVehicle) {
  configure();
  block(0, 1, 39, 41, kCellObstacle);
  block(3, 4, 40, 41, kCellObstacle);
  add();
  EXPECT_NE(cell(0, 40), kCellObstacle);
  EXPECT_EQ(cell(3, 40), kCellObstacle);  // it may touch the bumper
}

// A drive of 100 m in a map of 16 m: what is ahead is right, and nothing of what was there a turn of the torus ago is left.
TEST_F(RollingMapTest, RollsOverItsBorder) {
  for (const double yaw_deg : {0.0, 37.0, 90.0, 180.0, -90.0, -135.0}) {
    at = {};
    at.pose.yaw = radians(yaw_deg);
    configure();
    for (int i = 0; i < 500; ++i) {
      fill(kCellUnknown);
      block(15, 40, 20, 60, kCellUnoccupied);
      if (i % 50 == 0) block(18, 19, 40, 41, kCellObstacle);
      add();
      if (i % 50 == 0) {
        ASSERT_EQ(obstacles_near(1.85, -0.05, 1.5), 1) << i;
      }
      ASSERT_LE(obstacles(), 1) << i;
      at.pose.east_m += 0.2 * std::cos(at.pose.yaw);
      at.pose.north_m += 0.2 * std::sin(at.pose.yaw);
    }
  }
}

TEST_F(RollingMapTest, AJumpFartherThanTheMapForgetsAll) {
  configure();
  fill(kCellUnoccupied);
  block(10, 12, 40, 42, kCellObstacle);
  add();
  ASSERT_EQ(obstacles(), 4);
  fill(kCellUnknown);
  at.pose.east_m += 500;
  add();
  EXPECT_EQ(obstacles(), 0);
  at.pose.east_m -= 500;
  add();
  EXPECT_EQ(obstacles(), 0);
  block(10, 12, 40, 42, kCellObstacle);
  add();
  map.reset();
  fill(kCellUnknown);
  add();
  EXPECT_EQ(obstacles(), 0);
}

// A pole of one cell: seen once, then the vehicle turns round and round and sees nothing any more. It is always shown when it is
// in the half-plane ahead, and where it is.
TEST_F(RollingMapTest, APoleIsNeverLostByTurning) {
  params.near_m = 3;
  for (const int col : {40, 33, 25}) {
    at = {};
    configure();
    fill(kCellUnoccupied);
    block(14, 15, col, col + 1, kCellObstacle);
    add(0);
    const double bearing = std::atan2(3.95 - 0.1 * col, 1.45);
    const double range = std::hypot(3.95 - 0.1 * col, 1.45);
    fill(kCellUnknown);
    for (int degree = 0; degree <= 720; ++degree) {
      at.pose.yaw = wrap_angle(radians(degree * 0.5));
      add(0.01);
      const double there = wrap_angle(bearing - at.pose.yaw);
      if (range * std::cos(there) < 0.15) continue;
      ASSERT_EQ(obstacles(), 1) << degree;
      ASSERT_EQ(obstacles_near(range * std::cos(there), range * std::sin(there), 1.5), 1) << degree;
    }
  }
}

// The same pole, but seen in every frame, with floor all around it.
TEST_F(RollingMapTest, APoleSeenWhileTurningIsAlwaysThere) {
  configure();
  for (int degree = 0; degree <= 720; ++degree) {
    at.pose.yaw = wrap_angle(radians(degree * 0.5));
    const double there = wrap_angle(radians(20) - at.pose.yaw);
    const double forward = 1.8 * std::cos(there);
    const double left = 1.8 * std::sin(there);
    fill(kCellUnknown);
    const bool ahead = std::abs(there) < radians(40);
    for (int r = 5; r < 60; ++r) {
      for (int c = 0; c < 80; ++c) {
        if (std::abs(std::atan2(39.5 - c, r + 0.5)) < radians(40)) block(r, r + 1, c, c + 1, kCellUnoccupied);
      }
    }
    if (ahead) {
      const int r = static_cast<int>(forward * 10);
      const int c = static_cast<int>(40 - left * 10);
      block(r, r + 1, c, c + 1, kCellObstacle);
    }
    add(0.02);
    if (forward < 0.2) continue;
    ASSERT_GE(obstacles_near(forward, left, 2.2), 1) << degree;
    ASSERT_LE(obstacles(), 5) << degree;
  }
}

// Every frame cell that is an obstacle near the vehicle is shown as one, whatever the heading and the place.
TEST_F(RollingMapTest, NoNearObstacleIsLostByResampling) {
  params.near_m = 10;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-3.1, 3.1);
  std::uniform_real_distribution<double> place(-30, 30);
  for (int i = 0; i < 300; ++i) {
    configure();
    at.pose = {place(random), place(random), angle(random)};
    fill(kCellUnoccupied);
    for (int k = 0; k < 30; ++k) {
      const int r = 6 + static_cast<int>(random() % 52);
      const int c = 2 + static_cast<int>(random() % 76);
      block(r, r + 1, c, c + 1, kCellObstacle);
    }
    add();
    for (int r = 0; r < 60; ++r) {
      for (int c = 0; c < 80; ++c) {
        if (type.view().at(c, r) == kCellObstacle) {
          ASSERT_GE(obstacles_near((r + 0.5) / 10, (39.5 - c) / 10, 1.5), 1) << i << " " << r << " " << c;
        }
        // Nor does it cover what is free: only cells beside an obstacle change.
        if (cell(r, c) != kCellUnoccupied) {
          bool beside = false;
          for (int y = std::max(0, r - 1); y <= std::min(59, r + 1); ++y) {
            for (int x = std::max(0, c - 1); x <= std::min(79, c + 1); ++x)
              beside = beside || type.view().at(x, y) == kCellObstacle;
          }
          const bool at_border = r < 1 || c < 1 || r > 58 || c > 78;
          ASSERT_TRUE(beside || at_border) << i << " " << r << " " << c;
        }
      }
    }
  }
}

TEST_F(RollingMapTest, BeyondItsEdgeTheFrameCountsAlone) {
  params.size_m = 5;
  configure();
  fill(kCellUnoccupied);
  block(40, 41, 10, 11, kCellObstacle);
  add();
  EXPECT_EQ(cell(40, 10), kCellObstacle);
  EXPECT_EQ(cell(40, 11), kCellUnoccupied);
}

TEST_F(RollingMapTest, AllocatesNothing) {
  configure();
  fill(kCellUnoccupied);
  add();
  const int before = test::allocations;
  at.pose.east_m += 3.3;
  const Status added = map.add(frame(), at);
  const Status viewed = map.view(type.view(), shown.view());
  EXPECT_EQ(test::allocations, before);
  EXPECT_EQ(added, Status::ok);
  EXPECT_EQ(viewed, Status::ok);
}

TEST_F(RollingMapTest, Refusals) {
  EXPECT_EQ(map.add(frame(), at), Status::bad_argument);
  EXPECT_EQ(map.view(type.view(), shown.view()), Status::bad_argument);
  EXPECT_EQ(map.configure(params, geometry, {}), Status::size_mismatch);
  configure();
  EXPECT_EQ(map.view(type.view(), shown.view()), Status::bad_argument);
  const RollingMapMemory memory = arrays.make(geometry, params.size_m);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refuses = [&](auto change) {
    RollingMapParams p = params;
    change(p);
    return map.configure(p, geometry, memory) == Status::bad_argument;
  };
  EXPECT_TRUE(refuses([](RollingMapParams& p) { p.size_m = 0; }));
  EXPECT_TRUE(refuses([](RollingMapParams& p) { p.size_m = 1e9; }));
  EXPECT_TRUE(refuses([&](RollingMapParams& p) { p.size_m = nan; }));
  EXPECT_TRUE(refuses([&](RollingMapParams& p) { p.keep_s = nan; }));
  EXPECT_TRUE(refuses([](RollingMapParams& p) { p.far_hits = 0; }));
  EXPECT_TRUE(refuses([](RollingMapParams& p) { p.far_hits = 13; }));
  EXPECT_TRUE(refuses([](RollingMapParams& p) { p.deceleration_mps2 = 0; }));
  EXPECT_TRUE(refuses([](RollingMapParams& p) { p.camera.angle = 1.6; }));
  configure();
  add();
  const auto refuses_pose = [&](const Pose& pose) {
    return map.add(frame(), {pose, at.time_ns}) == Status::bad_argument;
  };
  EXPECT_TRUE(refuses_pose({.east_m = nan}));
  EXPECT_TRUE(refuses_pose({.north_m = -1e9}));
  EXPECT_TRUE(refuses_pose({.yaw = nan}));
  NavGrid other = frame();
  other.geometry.rows = 59;
  EXPECT_EQ(map.add(other, at), Status::bad_argument);
  Image<std::uint8_t> small(79, 60, kCellUnknown);
  EXPECT_EQ(map.view(type.view(), small.view()), Status::size_mismatch);
}

}  // namespace
}  // namespace lakshya

// What a rolling map makes of the shape of things: trimmed faces, and the other half of what hangs.
#include <gtest/gtest.h>

#include "tests/support/rolling_map_world.h"

namespace lakshya {
namespace {

class RollingMapShapeTest : public test::RollingMapWorld {
 protected:
  void floor_below(int row_begin, int row_end, int col_begin, int col_end, std::uint32_t pixels) {
    for (int r = row_begin; r < row_end; ++r) {
      for (int c = col_begin; c < col_end; ++c)
        floor_count.view().at(c, r) = pixels;
    }
  }
  // A thing of one cell's depth, 2.5 m ahead, as one frame shows it; what then lies there and behind it.
  void see_thing(int height_mm, std::uint32_t floor_pixels) {
    configure();
    fill(kCellUnoccupied);
    block(25, 26, 38, 42, kCellObstacle, height_mm);
    floor_below(25, 26, 38, 42, floor_pixels);
    for (int k = 0; k < 3; ++k)
      add();
  }
};

TEST_F(RollingMapShapeTest, WhatHangsIsDeeperThanItsFace) {
  see_thing(900, 4);  // of 10 pixels of the lamp
  EXPECT_EQ(cell(25, 40), kCellObstacle);
  EXPECT_EQ(cell(26, 40), kCellObstacle);
  EXPECT_EQ(cell(27, 40), kCellObstacle);
  EXPECT_NE(cell(28, 40), kCellObstacle);
  EXPECT_NE(cell(24, 40), kCellObstacle);
}

TEST_F(RollingMapShapeTest, WhatStandsIsNot) {
  see_thing(900, 1);  // a person, between whose feet some floor is seen
  EXPECT_EQ(cell(25, 40), kCellObstacle);
  EXPECT_NE(cell(26, 40), kCellObstacle);
}

TEST_F(RollingMapShapeTest, WhatIsLowIsNot) {
  see_thing(500, 10);
  EXPECT_EQ(cell(25, 40), kCellObstacle);
  EXPECT_NE(cell(26, 40), kCellObstacle);
}

// The error of a depth puts a face into the next cell now and then.
TEST_F(RollingMapShapeTest, ATrimmedFaceLosesWhatIsNotThereThoughItsNeighbourIs) {
  for (const bool trim : {true, false}) {
    params.trim = trim;
    configure();
    fill(kCellUnknown);
    block(25, 26, 30, 50, kCellObstacle);
    block(24, 25, 40, 41, kCellObstacle);
    for (int k = 0; k < 3; ++k)
      add();
    EXPECT_EQ(cell(24, 40), kCellObstacle);
    block(24, 25, 40, 41, kCellUnknown);
    for (int k = 0; k < 5; ++k)
      add();
    EXPECT_EQ(cell(24, 40), trim ? kCellUnknown : kCellObstacle);
    EXPECT_EQ(cell(25, 40), kCellObstacle);
  }
}

TEST_F(RollingMapShapeTest, AThinThingThatShowsInOneOfTwoCellsInTurnIsInBoth) {
  params.trim = true;
  configure();
  for (int k = 0; k < 20; ++k) {
    fill(kCellUnknown);
    block(24 + k % 2, 25 + k % 2, 40, 41, kCellObstacle);
    add();
  }
  EXPECT_EQ(obstacles_near(2.5, -0.05, 1.1), 2);
}

TEST_F(RollingMapShapeTest, NearByAFootThatIsOutOfViewStaysThoughWhatIsBehindItShows) {
  params.trim = true;
  configure();
  fill(kCellUnknown);
  block(11, 13, 30, 50, kCellObstacle);
  for (int k = 0; k < 3; ++k)
    add();
  block(11, 12, 30, 50, kCellUnknown);
  for (int k = 0; k < 50; ++k)
    add();
  EXPECT_EQ(cell(11, 40), kCellObstacle);
}

}  // namespace
}  // namespace lakshya

#include "app/nav/nearest_obstacle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernels/base/units.h"
#include "tests/support/test_image.h"

namespace lakshya {
namespace {

// 8 rows and `cols` columns of 100 mm; the vehicle is below the middle of the first row.
struct World {
  explicit World(CellType fill = kCellUnoccupied, int cols = 6)
      : geometry{.rows = 8, .cols = cols, .cell_mm = 100}, type(cols, 8, 5, kCellObstacle) {
    for (int r = 0; r < 8; ++r) {
      for (int c = 0; c < cols; ++c)
        type.view().at(c, r) = fill;
    }
  }
  void set(int r, int c, CellType what = kCellObstacle) { type.view().at(c, r) = what; }
  NearestObstacle nearest() const { return nearest_obstacle(type.view(), geometry); }

  GridGeometry geometry;
  test::PaddedImage<std::uint8_t> type;  // its padding would be obstacles
};

TEST(NearestObstacle, WithoutAnyThereIsNone) {
  for (const CellType what : {kCellUnoccupied, kCellUnknown}) {
    EXPECT_EQ(World(what).nearest().cells, 0U);
    EXPECT_EQ(World(what).nearest().distance_m, -1);
  }
  EXPECT_EQ(nearest_obstacle({}, {}).cells, 0U);
  EXPECT_EQ(nearest_obstacle({}, {}).distance_m, -1);
}

TEST(NearestObstacle, IsMeasuredToTheMiddleOfItsCell) {
  World world;
  world.set(5, 1);  // 0.55 m ahead, 0.15 m to the left
  EXPECT_EQ(world.nearest().cells, 1U);
  EXPECT_NEAR(world.nearest().distance_m, std::hypot(0.55, 0.15), 1e-12);
  world.set(5, 1, kCellUnknown);
  world.set(2, 5);  // 0.25 m ahead, 0.25 m to the right
  EXPECT_NEAR(world.nearest().distance_m, std::hypot(0.25, 0.25), 1e-12);
}

TEST(NearestObstacle, AnOddMapHasAColumnStraightAhead) {
  World world(kCellUnoccupied, 7);
  world.set(3, 3);
  EXPECT_NEAR(world.nearest().distance_m, 0.35, 1e-12);
  world.set(0, 0);
  EXPECT_NEAR(world.nearest().distance_m, std::hypot(0.05, 0.3), 1e-12);
}

TEST(NearestObstacle, IsTheNearestByDistanceNotByRow) {
  World world;
  world.set(0, 0);  // 0.05 m ahead, 0.25 m left: 0.255 m
  world.set(1, 3);  // 0.15 m ahead, 0.05 m right: 0.158 m
  world.set(7, 2);
  EXPECT_EQ(world.nearest().cells, 3U);
  EXPECT_NEAR(world.nearest().distance_m, std::hypot(0.15, 0.05), 1e-12);
}

TEST(NearestObstacle, LeftAndRightAreAlike) {
  for (int r = 0; r < 8; ++r) {
    for (int c = 0; c < 6; ++c) {
      World left;
      left.set(r, c);
      World right;
      right.set(r, 5 - c);
      EXPECT_EQ(left.nearest().distance_m, right.nearest().distance_m) << r << ", " << c;
    }
  }
}

TEST(NearestObstacle, OfManyIsWhatASearchInMetresFinds) {
  std::mt19937 random(23);
  for (int trial = 0; trial < 200; ++trial) {
    World world(kCellUnknown, 5 + trial % 4);
    const int cols = world.geometry.cols;
    world.geometry.cell_mm = 50;
    double nearest = 1e9;
    std::uint32_t cells = 0;
    for (int i = 0; i < 1 + trial % 7; ++i) {
      const int r = static_cast<int>(random() % 8);
      const int c = static_cast<int>(random() % static_cast<unsigned>(cols));
      if (world.type.view().at(c, r) == kCellObstacle) continue;
      world.set(r, c);
      ++cells;
      nearest = std::min(nearest, std::hypot((r + 0.5) * 0.05, (cols / 2.0 - c - 0.5) * 0.05));
    }
    EXPECT_EQ(world.nearest().cells, cells);
    EXPECT_NEAR(world.nearest().distance_m, nearest, 1e-12);
  }
}

}  // namespace
}  // namespace lakshya

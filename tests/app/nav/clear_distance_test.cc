#include "app/nav/clear_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "app/core/image.h"
#include "app/nav/sectors.h"
#include "kernels/base/units.h"

namespace lakshya {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// 40 rows and columns of 0.1 m, 4 m ahead, 2 m to each side.
struct World {
  explicit World(CellType fill, int cols = 40) : geometry{.rows = 40, .cols = cols, .cell_mm = 100} {
    type = Image<std::uint8_t>(cols, 40, fill);
  }
  void rows(int begin, int end, CellType what) {
    for (int r = begin; r < end; ++r) {
      for (int c = 0; c < geometry.cols; ++c)
        set(r, c, what);
    }
  }
  void set(int r, int c, CellType what) { type.view().at(c, r) = what; }
  RayView look(double deg, double blind_m = 0.5) const {
    return look_along(type.view(), geometry, radians(deg), blind_m);
  }
  double corridor(double deg, double radius_m) const {
    return corridor_obstacle_m(type.view(), geometry, radians(deg), radius_m);
  }
  ClearDistance clear(double deg) const { return clear_distance(type.view(), geometry, radians(deg), 0.5, 0.3); }

  GridGeometry geometry;
  Image<std::uint8_t> type;
};

TEST(LookAlong, FreeToTheEndOfTheGrid) {
  const World world(kCellUnoccupied);
  EXPECT_TRUE(world.look(0).seen);
  EXPECT_NEAR(world.look(0).clear_m, 4.0, 1e-9);
  EXPECT_EQ(world.look(0).end, ClearEnd::unknown);
  EXPECT_NEAR(world.look(90).clear_m, 2.0, 1e-9);
  EXPECT_NEAR(world.look(-90).clear_m, 2.0, 1e-9);
  EXPECT_NEAR(world.look(45).clear_m, 2.0 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(world.look(-10).clear_m, 4.0 / std::cos(radians(10)), 1e-9);
}

TEST(LookAlong, BehindNothingIsSeen) {
  const World world(kCellUnoccupied);
  for (const double deg : {95.0, 180.0, -135.0}) {
    EXPECT_FALSE(world.look(deg).seen);
    EXPECT_EQ(world.look(deg).clear_m, 0);
  }
}

TEST(LookAlong, EndsWhereItEntersTheFirstCellThatIsNotFree) {
  World world(kCellUnoccupied);
  world.rows(30, 31, kCellObstacle);
  EXPECT_NEAR(world.look(0).clear_m, 3.0, 1e-9);
  EXPECT_EQ(world.look(0).end, ClearEnd::obstacle);
  for (int step = -100; step <= 100; ++step) {
    const double deg = 0.3 * step;
    const double met_m = 3.0 / std::cos(radians(deg));
    EXPECT_GE(world.look(deg).clear_m, met_m - 1e-9);
    EXPECT_LT(world.look(deg).clear_m, met_m + 0.05);
  }
  world.rows(20, 21, kCellUnknown);
  EXPECT_NEAR(world.look(0).clear_m, 2.0, 1e-9);
  EXPECT_EQ(world.look(0).end, ClearEnd::unknown);
}

TEST(LookAlong, UnknownCellsInTheBlindZoneArePassedOver) {
  World world(kCellUnoccupied);
  world.rows(0, 5, kCellUnknown);
  EXPECT_TRUE(world.look(0).seen);
  EXPECT_NEAR(world.look(0).clear_m, 4.0, 1e-9);
  world.rows(5, 6, kCellUnknown);  // the one cell more
  EXPECT_TRUE(world.look(0).seen);
  world.rows(6, 7, kCellUnknown);
  EXPECT_FALSE(world.look(0).seen);
  EXPECT_EQ(world.look(0).clear_m, 0);
  EXPECT_TRUE(world.look(0, 0.6).seen);
}

// A rolling map remembers cells in the blind zone, not all of them.
TEST(LookAlong, UnknownCellsBetweenKnownOnesOfTheBlindZoneArePassedOver) {
  World world(kCellUnoccupied);
  world.rows(0, 2, kCellUnknown);
  world.rows(3, 5, kCellUnknown);
  EXPECT_TRUE(world.look(0).seen);
  EXPECT_NEAR(world.look(0).clear_m, 4.0, 1e-9);
  world.rows(5, 7, kCellUnknown);  // what follows is no longer in the blind zone
  EXPECT_TRUE(world.look(0).seen);
  EXPECT_NEAR(world.look(0).clear_m, 0.3, 1e-9);
  EXPECT_EQ(world.look(0).end, ClearEnd::unknown);
  world.rows(4, 5, kCellObstacle);
  EXPECT_NEAR(world.look(0).clear_m, 0.4, 1e-9);
  EXPECT_EQ(world.look(0).end, ClearEnd::obstacle);
}

TEST(LookAlong, AnObstacleInTheBlindZoneEndsIt) {
  World world(kCellUnknown);
  world.rows(3, 4, kCellObstacle);
  EXPECT_TRUE(world.look(0).seen);
  EXPECT_NEAR(world.look(0).clear_m, 0.3, 1e-9);
  EXPECT_EQ(world.look(0).end, ClearEnd::obstacle);
}

TEST(LookAlong, AnObstacleBeyondTheBlindZoneBehindUnknownCellsIsNotSeen) {
  World world(kCellUnknown);
  world.rows(20, 21, kCellObstacle);
  EXPECT_FALSE(world.look(0).seen);
  EXPECT_EQ(world.look(0).clear_m, 0);
}

TEST(LookAlong, StraightAheadTheWorseOfTheTwoMiddleColumnsCounts) {
  for (const int column : {19, 20}) {
    World world(kCellUnoccupied);
    world.set(25, column, kCellUnknown);
    world.set(30, column, kCellObstacle);
    EXPECT_NEAR(world.look(0).clear_m, 2.5, 1e-9);
    EXPECT_EQ(world.look(0).end, ClearEnd::unknown);
    world.set(25, 39 - column, kCellObstacle);
    EXPECT_EQ(world.look(0).end, ClearEnd::obstacle);
  }
}

TEST(LookAlong, OddGridsHaveOneMiddleColumn) {
  World world(kCellUnoccupied, 41);
  world.set(30, 20, kCellObstacle);
  EXPECT_NEAR(world.look(0).clear_m, 3.0, 1e-9);
  EXPECT_NEAR(world.look(90).clear_m, 2.05, 1e-9);
}

TEST(LookAlong, MirroredMapsGiveTheSame) {
  std::mt19937 random(9);
  for (const int cols : {40, 41}) {
    World world(kCellUnoccupied, cols);
    World mirror = world;
    for (int r = 0; r < 40; ++r) {
      for (int c = 0; c < cols; ++c) {
        const auto drawn = random() % 100;
        const CellType what = drawn < 3 ? kCellObstacle : drawn < 6 ? kCellUnknown : kCellUnoccupied;
        world.set(r, c, what);
        mirror.set(r, cols - 1 - c, what);
      }
    }
    for (int step = -130; step <= 130; ++step) {
      const double deg = 0.69 * step;
      EXPECT_EQ(world.look(deg).seen, mirror.look(-deg).seen);
      EXPECT_NEAR(world.look(deg).clear_m, mirror.look(-deg).clear_m, 1e-9);
      EXPECT_NEAR(world.clear(deg).metres, mirror.clear(-deg).metres, 1e-9);
    }
  }
}

TEST(Corridor, TakesObstaclesAcrossTheVehiclesWidth) {
  World world(kCellUnoccupied);
  EXPECT_EQ(world.corridor(0, 0.3), kInfinity);
  world.set(30, 17, kCellObstacle);  // centre 0.25 m to the left
  EXPECT_NEAR(world.corridor(0, 0.3), 3.0, 1e-9);
  EXPECT_EQ(world.corridor(0, 0.2), kInfinity);
  world.rows(10, 20, kCellUnknown);
  EXPECT_NEAR(world.corridor(0, 0.3), 3.0, 1e-9);
}

TEST(Corridor, FollowsTheDirection) {
  World world(kCellUnoccupied);
  world.set(10, 9, kCellObstacle);  // 1.05 m ahead, 1.05 m left
  EXPECT_NEAR(world.corridor(45, 0.3), 1.05 * std::sqrt(2.0) - 0.05, 1e-9);
  EXPECT_EQ(world.corridor(-45, 0.3), kInfinity);
  EXPECT_EQ(world.corridor(0, 0.3), kInfinity);
  EXPECT_NEAR(world.corridor(90, 1.1), 1.0, 1e-9);
}

TEST(Corridor, ObstaclesBehindDoNotCount) {
  World world(kCellUnoccupied);
  world.set(0, 10, kCellObstacle);  // 0.05 m ahead, 0.95 m left
  EXPECT_EQ(world.corridor(-45, 5.0), kInfinity);
}

TEST(Corridor, AVehicleWithoutWidthStillMeetsTheCellsOnItsRay) {
  World world(kCellUnoccupied);
  world.set(30, 20, kCellObstacle);
  EXPECT_NEAR(world.corridor(0, 0.0), 3.0, 1e-9);
}

TEST(ClearDistance, IsTheNearerOfRayAndCorridor) {
  World world(kCellUnoccupied);
  EXPECT_NEAR(world.clear(0).metres, 4.0, 1e-9);
  EXPECT_EQ(world.clear(0).end, ClearEnd::unknown);
  world.set(30, 17, kCellObstacle);
  EXPECT_NEAR(world.clear(0).metres, 3.0, 1e-9);
  EXPECT_EQ(world.clear(0).end, ClearEnd::obstacle);
  world.rows(20, 21, kCellUnknown);
  EXPECT_NEAR(world.clear(0).metres, 2.0, 1e-9);
  EXPECT_EQ(world.clear(0).end, ClearEnd::unknown);
}

}  // namespace
}  // namespace lakshya

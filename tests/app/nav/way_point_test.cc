#include "app/nav/way_point.h"

#include <gtest/gtest.h>

#include <array>

#include "app/nav/sectors.h"

namespace lakshya {
namespace {

TEST(WayPoint, DirectionIsFromStraightAhead) {
  const Pose east{.east_m = 1, .north_m = 2, .yaw = 0};
  EXPECT_NEAR(view_way_point(east, {4, 2}).direction, 0, 1e-12);
  EXPECT_NEAR(view_way_point(east, {4, 6}).distance_m, 5, 1e-12);
  EXPECT_NEAR(view_way_point(east, {1, 5}).direction, radians(90), 1e-12);
  EXPECT_NEAR(view_way_point(east, {1, -5}).direction, radians(-90), 1e-12);

  const Pose north_west{.east_m = 0, .north_m = 0, .yaw = radians(135)};
  EXPECT_NEAR(view_way_point(north_west, {0, 1}).direction, radians(-45), 1e-12);
  EXPECT_NEAR(view_way_point(north_west, {-1, -1}).direction, radians(90), 1e-12);
  EXPECT_NEAR(view_way_point({0, 0, radians(720 + 10)}, {1, 0}).direction, radians(-10), 1e-12);
}

TEST(WayPoint, OnTheWayPointItself) {
  const WayPointView view = view_way_point({3, 4, 1}, {3, 4});
  EXPECT_EQ(view.direction, 0);
  EXPECT_EQ(view.distance_m, 0);
}

TEST(WayPoint, ReachedOnesArePassed) {
  const std::array<WayPoint, 4> list{{{0, 1}, {0, 2}, {5, 5}, {0, 0}}};
  EXPECT_EQ(next_way_point(list, 0, {0, 0, 0}, 0.5), 0U);
  EXPECT_EQ(next_way_point(list, 0, {0, 0, 0}, 1.0), 1U);
  EXPECT_EQ(next_way_point(list, 0, {0, 1.5, 0}, 0.5), 2U);
  EXPECT_EQ(next_way_point(list, 2, {0, 1, 0}, 0.5), 2U);
  EXPECT_EQ(next_way_point(list, 3, {0, 0, 0}, 0.5), 4U);
  EXPECT_EQ(next_way_point(list, 4, {0, 0, 0}, 0.5), 4U);
  EXPECT_EQ(next_way_point({}, 0, {0, 0, 0}, 0.5), 0U);
}

// Lengths of a degree on WGS 84 as tables give them (and Vincenty's formula confirms to the centimetre).
TEST(WayPoint, DegreesBecomeMetres) {
  EXPECT_NEAR(local_way_point({0, 10}, {0, 11}).east_m, 111319.49, 0.01);
  EXPECT_NEAR(local_way_point({-0.5, 0}, {0.5, 0}).north_m, 110574.3, 0.2);
  EXPECT_NEAR(local_way_point({44.5, 7}, {45.5, 7}).north_m, 111131.7, 0.2);
  EXPECT_NEAR(local_way_point({45, 7}, {45, 8}).east_m, 78846.8, 0.2);
  const WayPoint south_west = local_way_point({12.9716, 77.5946}, {12.9706, 77.5936});
  EXPECT_NEAR(south_west.north_m, -110.62, 0.02);
  EXPECT_NEAR(south_west.east_m, -108.49, 0.02);
}

TEST(WayPoint, TheDateLineIsNoWay) {
  EXPECT_NEAR(local_way_point({0, 179.9995}, {0, -179.9995}).east_m, 111.32, 0.01);
}

}  // namespace
}  // namespace lakshya

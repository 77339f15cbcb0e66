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

}  // namespace
}  // namespace lakshya

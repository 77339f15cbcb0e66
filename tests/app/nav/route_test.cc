// The way through the rolling map, on maps made by hand.
#include "app/nav/route.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/nav/sectors.h"
#include "kernels/base/units.h"
#include "tests/support/count_allocations.h"
#include "tests/support/route_world.h"

namespace lakshya {
namespace {

using RouteTest = test::RouteWorld;

TEST_F(RouteTest, GoesStraightInTheOpen) {
  see([](double, double) { return false; });
  const Route route = plan(5, 0);
  EXPECT_TRUE(route.found);
  EXPECT_TRUE(route.reaches_target);
  EXPECT_NEAR(route.direction, 0, radians(5));
  EXPECT_NEAR(route.cost_m, 5, 0.2);
  EXPECT_GT(route.clear_m, 4);
}

// The blind zone is passed over where floor is seen behind it: 1 m by default, and 0.3 m more.
TEST_F(RouteTest, WhereNoFloorIsSeenTheWayIsNotClear) {
  const auto nothing = [](double, double) { return false; };
  see(nothing, [](double x, double y) { return std::hypot(x, y) > 0.3 && std::hypot(x, y) < 1.2; });
  const Route passed = plan(5, 0);
  EXPECT_GT(passed.clear_m, 4);
  for (auto& e : arrays_.evidence)
    e = 0;
  see(nothing, [](double x, double y) { return std::hypot(x, y) > 0.3; });
  const Route stopped = plan(5, 0);
  EXPECT_LT(stopped.clear_m, 0.5);
  EXPECT_EQ(stopped.clear_end, ClearEnd::unknown);
}

// Before the vehicle nothing is known but what lies behind a wall that shows nothing to match: one cell of floor, and an obstacle.
TEST_F(RouteTest, WhatIsSeenBehindTheUnknownDoesNotOpenIt) {
  const auto behind = [](double x, double) { return x > 0.9 && x < 2; };
  const auto unknown = [](double x, double y) {
    return x > 0.3 && x < 0.9 && std::abs(y) < 2 && !(x > 0.5 && x < 0.6);
  };
  see(behind, unknown);
  const ClearDistance from = {plan(0.3, 0).clear_m, plan(0.3, 0).clear_end};
  EXPECT_LT(from.metres, 0.4);
  EXPECT_EQ(from.end, ClearEnd::unknown);
}

TEST_F(RouteTest, AStraightAimKeepsItsDistanceFromACorner) {
  see([](double x, double y) { return x > 1 && x < 2 && y < 0.2 && y > -6; });
  for (double along = 0; along < 1.2; along += 0.05) {
    const Route route = plan(2.5, -2, {along, 0.9, 0});
    ASSERT_TRUE(route.found);
    const double c = std::cos(route.direction);
    const double s = std::sin(route.direction);
    for (double way = 0; way <= route.straight_m; way += 0.02) {
      const double x = along + way * c;
      const double y = 0.9 + way * s;
      const double dx = std::max({1 - x, 0.0, x - 2});
      const double dy = std::max(0.0, y - 0.2);
      ASSERT_GT(std::hypot(dx, dy), 0.35 + 0.10) << along << ' ' << way;
    }
  }
}

TEST_F(RouteTest, TheDirectionIsTheVehiclesOwn) {
  see([](double, double) { return false; });
  EXPECT_NEAR(plan(0, 5).direction, radians(90), radians(5));
  EXPECT_NEAR(plan(0, 5, {0, 0, radians(90)}).direction, 0, radians(5));
  EXPECT_NEAR(plan(-5, 0, {0, 0, radians(90)}).direction, radians(90), radians(5));
}

TEST_F(RouteTest, GoesRoundAWallOnItsShorterSide) {
  see([](double x, double y) { return x > 1.9 && x < 2.1 && y > -3 && y < 1; });
  const Route route = plan(5, 0);
  EXPECT_TRUE(route.reaches_target);
  EXPECT_GT(route.direction, radians(15));
  EXPECT_GT(route.cost_m, 5);
}

TEST_F(RouteTest, LeadsThroughAGapThatHoldsTheVehicleAndNotThroughANarrowerOne) {
  // A wall with an opening of 1.0 m far from the straight line, and one of 0.6 m on it.
  see([](double x, double y) {
    const bool open = (y > 1.5 && y < 2.5) || (y > -0.3 && y < 0.3);
    return x > 1.9 && x < 2.1 && !open;
  });
  const Route route = plan(5, 0);
  EXPECT_TRUE(route.reaches_target);
  EXPECT_GT(route.direction, radians(20));
}

TEST_F(RouteTest, KeepsToTheMiddleOfAGap) {
  see([](double x, double y) { return x > 1.5 && x < 2.5 && std::abs(y) > 0.6; });
  double least = 1;
  Pose pose{0, 0.3, 0};
  for (int k = 0; k < 60; ++k) {
    const Route route = plan(5, 0.3, pose);
    ASSERT_TRUE(route.found);
    pose.yaw += route.direction;
    pose.east_m += 0.05 * std::cos(pose.yaw);
    pose.north_m += 0.05 * std::sin(pose.yaw);
    if (pose.east_m > 1.5 && pose.east_m < 2.5) least = std::min(least, 0.6 - std::abs(pose.north_m));
  }
  EXPECT_GT(pose.east_m, 2.5);
  EXPECT_GT(least, 0.45);
}

// Between a box and a wall that the camera looked at from near by, and which showed nothing.
TEST_F(RouteTest, KeepsOffAWallThatShowsNothing) {
  params_.view = radians(60);
  ASSERT_EQ(map_.configure(params_, geometry_, arrays_.make(geometry_, params_.size_m)), Status::ok);
  const auto box = [](double x, double y) { return x > 1.3 && x < 1.9 && y < -0.6 && y > -3; };
  const auto wall = [](double x, double y) { return x > 0.9 && x < 2.2 && y > 0.7 && y < 3; };
  for (int k = 0; k < RollingMap::kDoubts; ++k)
    see(box, wall);
  double least = 1;
  Pose pose{0, 0.5, 0};
  for (int k = 0; k < 60; ++k) {
    const Route route = plan(4, 0.6, pose);
    ASSERT_TRUE(route.found);
    pose.yaw += route.direction;
    pose.east_m += 0.05 * std::cos(pose.yaw);
    pose.north_m += 0.05 * std::sin(pose.yaw);
    if (pose.east_m > 0.9 && pose.east_m < 1.9) least = std::min(least, 0.7 - pose.north_m);
  }
  EXPECT_GT(pose.east_m, 2.2);
  EXPECT_GT(least, route_params_.radius_m);
}

TEST_F(RouteTest, ASpotThatShowsNothingIsNoWall) {
  params_.view = radians(60);
  ASSERT_EQ(map_.configure(params_, geometry_, arrays_.make(geometry_, params_.size_m)), Status::ok);
  const auto gap = [](double x, double y) { return x > 1.5 && x < 2 && std::abs(y) > 0.5; };
  const auto spot = [](double x, double y) { return x > 1.6 && x < 1.8 && y > 0 && y < 0.1; };
  for (int k = 0; k < RollingMap::kDoubts; ++k)
    see(gap, spot);
  const Route route = plan(4, 0);
  EXPECT_TRUE(route.reaches_target);
  EXPECT_LT(std::abs(route.direction), radians(20));
}

TEST_F(RouteTest, KeepsToTheWayThatItHasBegun) {
  // Two ways round a block that are as good, and a target that sways between them.
  see([](double x, double y) { return x > 1.5 && x < 2.5 && std::abs(y) < 1; });
  const double first = plan(5, 0.1).direction;
  for (int k = 0; k < 20; ++k) {
    const Route route = plan(5, k % 2 == 0 ? -0.2 : 0.2);
    EXPECT_GT(route.direction * first, 0) << k;
  }
}

TEST_F(RouteTest, WithoutAWayItGoesAsNearAsItCan) {
  see([](double x, double y) {
    return std::max(std::abs(x - 4), std::abs(y)) < 1 && std::max(std::abs(x - 4), std::abs(y)) > 0.7;
  });
  const Route route = plan(4, 0);
  EXPECT_TRUE(route.found);
  EXPECT_FALSE(route.reaches_target);
  EXPECT_NEAR(route.direction, 0, radians(10));
}

TEST_F(RouteTest, SaysHowFarItIsClear) {
  see([](double x, double) { return x > 3 && x < 3.2; });
  const Route route = plan(2, 0);
  // The centre may go up to radius + margin before the wall's first cell, whose middle is at 3.05 m.
  EXPECT_EQ(route.clear_end, ClearEnd::obstacle);
  EXPECT_NEAR(route.clear_m, 3.05 - route_params_.margin_m, 0.11);
}

TEST_F(RouteTest, AVehicleTooNearToAnObstacleFindsTheWayOut) {
  see([](double x, double y) { return x > 0.2 && x < 0.4 && std::abs(y) < 1; });
  const Route route = plan(-4, 0);
  EXPECT_TRUE(route.found);
  EXPECT_GT(std::abs(route.direction), radians(120));
}

TEST_F(RouteTest, RefusesWhatIsNoNumberAndWrongMemory) {
  see([](double, double) { return false; });
  Route route;
  EXPECT_EQ(planner_.plan(map_, {}, std::nan(""), 0, 0, route), Status::bad_argument);
  RouteMemory memory{bytes_[0], bytes_[1], bytes_[2], words_[0], words_[1], words_[2], bytes_[3]};
  memory.cost = memory.cost.first(10);
  EXPECT_EQ(planner_.configure(route_params_, 100, memory), Status::size_mismatch);
  RouteParams wrong;
  wrong.radius_m = std::nan("");
  EXPECT_EQ(planner_.configure(wrong, 100, {}), Status::bad_argument);
}

TEST_F(RouteTest, PlanningDoesNotAllocate) {
  see([](double x, double y) { return x > 1.9 && x < 2.1 && y > -3 && y < 1; });
  Route route;
  const int before = test::allocations;
  EXPECT_EQ(planner_.plan(map_, {}, 5, 0, 0, route), Status::ok);
  EXPECT_EQ(test::allocations, before);
}

}  // namespace
}  // namespace lakshya

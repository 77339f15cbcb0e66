// The way through the rolling map, on maps made by hand.
#include "app/nav/route.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "app/core/image.h"
#include "app/nav/sectors.h"
#include "kernels/base/units.h"
#include "tests/support/count_allocations.h"

namespace lakshya {
namespace {

// A rolling map that was filled through frames which look in all directions from the origin: what is not an obstacle is free.
class RouteTest : public ::testing::Test {
 protected:
  RouteTest() {
    params_.size_m = 30;
    params_.near_m = 20;
    params_.camera.angle = 1.5;
    const auto side = static_cast<std::size_t>(rolling_map_side(geometry_, params_.size_m));
    evidence_.assign(side * side, 0);
    height_.assign(side * side, 0);
    seen_.assign(side * side, 0);
    floor_.assign(side * side, 0);
    EXPECT_EQ(map_.configure(params_, geometry_, {evidence_, height_, seen_, floor_}), Status::ok);
    RouteMemory memory{bytes_[0], bytes_[1], bytes_[2], words_[0], words_[1], words_[2], bytes_[3]};
    EXPECT_EQ(planner_.configure(route_params_, geometry_.cell_mm, memory), Status::ok);
  }

  // An obstacle cell wherever `is_obstacle(east, north)` of its centre, and nothing known wherever `is_unknown`.
  template <class F>
  void see(F is_obstacle) {
    see(is_obstacle, [](double, double) { return false; });
  }
  template <class F, class G>
  void see(F is_obstacle, G is_unknown) {
    for (const double yaw : {0.0, std::numbers::pi / 2, std::numbers::pi, -std::numbers::pi / 2}) {
      const Pose pose{0, 0, yaw};
      for (int r = 0; r < geometry_.rows; ++r) {
        for (int c = 0; c < geometry_.cols; ++c) {
          const double forward = (r + 0.5) * 0.1;
          const double left = (geometry_.cols / 2.0 - c - 0.5) * 0.1;
          const double east = forward * std::cos(yaw) - left * std::sin(yaw);
          const double north = forward * std::sin(yaw) + left * std::cos(yaw);
          const bool obstacle = is_obstacle(east, north);
          type_.view().at(c, r) =
              obstacle ? kCellObstacle : (is_unknown(east, north) ? kCellUnknown : kCellUnoccupied);
          count_.view().at(c, r) = obstacle ? 10 : 0;
          height_sum_.view().at(c, r) = obstacle ? 3000 : 0;
        }
      }
      NavGrid grid;
      grid.geometry = geometry_;
      grid.type = type_.view();
      grid.count = count_.view();
      grid.height_sum = height_sum_.view();
      time_ += 100'000'000;
      ASSERT_EQ(map_.add(grid, {pose, time_}), Status::ok);
    }
  }

  Route plan(double east, double north, const Pose& pose = {}) {
    Route route;
    EXPECT_EQ(planner_.plan(map_, pose, east, north, 0, route), Status::ok);
    return route;
  }

  GridGeometry geometry_{.rows = 70, .cols = 140, .cell_mm = 100};
  RollingMapParams params_;
  RouteParams route_params_;
  std::vector<std::uint8_t> evidence_;
  std::vector<std::int16_t> height_;
  std::vector<std::uint32_t> seen_;
  std::vector<std::uint8_t> floor_;
  Image<std::uint8_t> type_{140, 70};
  Image<std::uint32_t> count_{140, 70};
  Image<std::int64_t> height_sum_{140, 70};
  std::vector<std::uint8_t> bytes_[4] = {
      std::vector<std::uint8_t>(kRouteCells), std::vector<std::uint8_t>(kRouteCells),
      std::vector<std::uint8_t>(kRouteCells), std::vector<std::uint8_t>(kRouteCells)};
  std::vector<std::int32_t> words_[3] = {std::vector<std::int32_t>(kRouteCells),
                                         std::vector<std::int32_t>(kRouteCells),
                                         std::vector<std::int32_t>(kRouteCells)};
  std::int64_t time_ = 0;
  RollingMap map_;
  RoutePlanner planner_;
};

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
  for (auto& e : evidence_)
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

// A room in two halves; the wall between them has two gaps, both narrower than the vehicle, at y = 0 the wider one.
bool divided_room(double x, double y) {
  const bool outside = std::abs(x) > 4 || std::abs(y) > 3;
  const bool gap = std::abs(y) < 0.3 || std::abs(y - 2) < 0.2;
  return outside || (x > 1.9 && x < 2.2 && !gap);
}

TEST_F(RouteTest, WithoutAWayItLooksAtTheWidestGap) {
  see(divided_room);
  const Route route = plan(3.5, 0);
  EXPECT_TRUE(route.found);
  EXPECT_TRUE(route.looks);
  EXPECT_FALSE(route.reaches_target);
  EXPECT_NEAR(route.direction, 0, radians(10));
  EXPECT_EQ(route.clear_m, 0);
  EXPECT_NEAR(plan(3.5, 0, {0, 0, radians(90)}).direction, radians(-90), radians(10));
}

TEST_F(RouteTest, ItLooksFromFartherThanItsBlindZone) {
  see(divided_room);
  const Route route = plan(3.5, 0, {1.2, 0, 0});
  EXPECT_TRUE(route.found);
  EXPECT_FALSE(route.looks);
  EXPECT_GT(std::abs(route.direction), radians(90));  // backwards
}

TEST_F(RouteTest, WhatStaysClosedIsLeftForTheNextPlace) {
  see(divided_room);
  int plans = 0;
  while (plans < 30 && plan(3.5, 0).direction < radians(20))
    ++plans;
  EXPECT_GE(plans, 5);
  EXPECT_LT(plans, 15);
  const Route next = plan(3.5, 0);
  EXPECT_NEAR(next.direction, std::atan2(2, 1.7), radians(15));
  for (int i = 0; i < 8; ++i)
    see([](double x, double y) { return divided_room(x, y) && !(std::abs(y) < 0.6 && std::abs(x) < 4); });
  EXPECT_TRUE(plan(3.5, 0).reaches_target);
}

// Somebody stands in the only door, where the floor was seen free before; beside him the wall has a hole that he would not fit through.
TEST_F(RouteTest, ItLooksFirstAtWhatHasComeToFreeGround) {
  const auto room = [](double x, double y) {
    const bool outside = std::abs(x) > 4 || std::abs(y) > 3;
    const bool gap = std::abs(y + 1.5) < 0.6 || std::abs(y - 0.5) < 0.3;
    return outside || (x > 1.9 && x < 2.2 && !gap);
  };
  for (int i = 0; i < 3; ++i)
    see(room);
  EXPECT_TRUE(plan(3.5, 0).reaches_target);
  see([&](double x, double y) { return room(x, y) || std::hypot(x - 2.0, y + 1.5) < 0.3; });
  const Route route = plan(3.5, 0);
  EXPECT_TRUE(route.looks);
  EXPECT_LT(route.direction, radians(-25));
  int looks = 0;  // it does not leave him for long, though there is another place to look at
  for (int i = 0; i < 100; ++i)
    looks += plan(3.5, 0).direction < radians(-25) ? 1 : 0;
  EXPECT_GT(looks, 40);
}

// Which gap is the cheapest changes as the map does; the vehicle does not turn to and fro.
TEST_F(RouteTest, ThePlaceThatItDoubtsStaysTheOne) {
  see(divided_room);
  EXPECT_NEAR(plan(3.5, 0).direction, 0, radians(10));
  for (int i = 0; i < 8; ++i)
    see([](double x, double y) {
      return std::abs(x) > 4 || std::abs(y) > 3 || (x > 1.9 && x < 2.2 && std::abs(y - 2) > 0.34);
    });
  EXPECT_NEAR(plan(3.5, 0).direction, 0, radians(10));
  int plans = 0;
  while (plans < 30 && plan(3.5, 0).direction < radians(20))
    ++plans;
  EXPECT_GE(plans, 4);
  EXPECT_LT(plans, 12);
}

// Round the corner of a long box: there is room on the other side.
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

TEST_F(RouteTest, LooksToBothSidesBeforeItSetsOff) {
  route_params_.first_look = radians(35);
  RouteMemory memory{bytes_[0], bytes_[1], bytes_[2], words_[0], words_[1], words_[2], bytes_[3]};
  ASSERT_EQ(planner_.configure(route_params_, geometry_.cell_mm, memory), Status::ok);
  see([](double, double) { return false; });
  Route route = plan(5, 1);
  EXPECT_TRUE(route.looks);
  EXPECT_EQ(route.clear_m, 0);
  // The target is to the left. It aims beyond where it turns back, so that it does not slow down on the way.
  EXPECT_LT(route.direction, radians(-45));
  EXPECT_NEAR(plan(5, 1, {0, 0, radians(-20)}).direction, route.direction + radians(20), 1e-9);
  EXPECT_LT(plan(5, 1, {0, 0, radians(-34)}).direction, radians(-10));
  plan(5, 1, {0, 0, radians(-36)});
  for (const double yaw : {-36, -15, 5, 25, 34})
    EXPECT_GT(plan(5, 1, {0, 0, radians(yaw)}).direction, radians(45 - yaw));
  plan(5, 1, {0, 0, radians(36)});
  route = plan(5, 1, {0, 0, radians(36)});
  EXPECT_FALSE(route.looks);
  EXPECT_TRUE(route.reaches_target);
  planner_.reset();
  EXPECT_TRUE(plan(5, 1).looks);
  EXPECT_LT(plan(-5, 0.1, {0, 0, radians(170)}).direction, radians(-45));  // its heading was found only now
  planner_.reset();
  EXPECT_TRUE(plan(5, 1).looks);
  int plans = 1;  // one that does not turn sets off all the same
  while (plans < 1000 && plan(5, 1).looks)
    ++plans;
  EXPECT_EQ(plans, 80);
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

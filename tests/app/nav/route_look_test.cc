// Where the route leads when none is open, and before the vehicle sets off.
#include <gtest/gtest.h>

#include <cmath>

#include "app/nav/route.h"
#include "app/nav/sectors.h"
#include "kernels/base/units.h"
#include "tests/support/route_world.h"

namespace lakshya {
namespace {

using RouteLookTest = test::RouteWorld;

// A room in two halves; the wall between them has two gaps, both narrower than the vehicle, at y = 0 the wider one.
bool divided_room(double x, double y) {
  const bool outside = std::abs(x) > 4 || std::abs(y) > 3;
  const bool gap = std::abs(y) < 0.3 || std::abs(y - 2) < 0.2;
  return outside || (x > 1.9 && x < 2.2 && !gap);
}

// Round the corner of a long box: there is room on the other side.

TEST_F(RouteLookTest, WithoutAWayItLooksAtTheWidestGap) {
  see(divided_room);
  const Route route = plan(3.5, 0);
  EXPECT_TRUE(route.found);
  EXPECT_TRUE(route.looks);
  EXPECT_FALSE(route.reaches_target);
  EXPECT_NEAR(route.direction, 0, radians(10));
  EXPECT_EQ(route.clear_m, 0);
  EXPECT_NEAR(plan(3.5, 0, {0, 0, radians(90)}).direction, radians(-90), radians(10));
}

TEST_F(RouteLookTest, ItLooksFromFartherThanItsBlindZone) {
  see(divided_room);
  const Route route = plan(3.5, 0, {1.2, 0, 0});
  EXPECT_TRUE(route.found);
  EXPECT_FALSE(route.looks);
  EXPECT_GT(std::abs(route.direction), radians(90));  // backwards
}

TEST_F(RouteLookTest, WhatStaysClosedIsLeftForTheNextPlace) {
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
TEST_F(RouteLookTest, ItLooksFirstAtWhatHasComeToFreeGround) {
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
TEST_F(RouteLookTest, ThePlaceThatItDoubtsStaysTheOne) {
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

TEST_F(RouteLookTest, LooksToBothSidesBeforeItSetsOff) {
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

// A wall with a gap that seems a little too narrow; the way round it is very long.
TEST_F(RouteLookTest, AGapThatMayBeOpenIsLookedAtBeforeAVeryLongWayIsTaken) {
  const auto wall = [](double x, double y) { return x > 1.4 && x < 1.6 && std::abs(y) > 0.3 && y > -6.5; };
  see(wall, [](double x, double) { return x > 1.6; });
  const Route first = plan(3, 0);
  EXPECT_TRUE(first.looks);
  EXPECT_NEAR(first.direction, 0, radians(15));
  int looks = 1;
  Route route = first;
  while (looks < 100 && route.looks) {
    route = plan(3, 0);
    looks += route.looks ? 1 : 0;
  }
  EXPECT_LT(looks, 12);
  // It stays closed: round the wall, and not back to it soon.
  for (int k = 0; k < 150; ++k) {
    route = plan(3, 0);
    ASSERT_FALSE(route.looks) << k;
    ASSERT_LT(route.direction, radians(-45)) << k;
  }
}

TEST_F(RouteLookTest, AShorterWayRoundIsTakenWithoutALook) {
  see([](double x, double y) { return x > 1.4 && x < 1.6 && std::abs(y) > 0.3 && y > -1.5; });
  const Route route = plan(3, 0);
  EXPECT_FALSE(route.looks);
  EXPECT_LT(route.direction, radians(-20));
}

}  // namespace
}  // namespace lakshya

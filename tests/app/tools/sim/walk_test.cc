#include "app/tools/sim/walk.h"

#include <gtest/gtest.h>

#include <numbers>

namespace lakshya::sim {
namespace {

constexpr double kPi = std::numbers::pi;

void expect_place(const Place& p, double x, double y, double yaw) {
  EXPECT_NEAR(p.x, x, 1e-12);
  EXPECT_NEAR(p.y, y, 1e-12);
  EXPECT_NEAR(p.yaw, yaw, 1e-12);
}

TEST(Walk, ThereAndBackAlongACorner) {
  const Walk walk{{{0, 0}, {2, 0}, {2, 1}}, 0.5, 0};
  expect_place(place_on_walk(walk, 0), 0, 0, 0);
  expect_place(place_on_walk(walk, 2), 1, 0, 0);
  expect_place(place_on_walk(walk, 5), 2, 0.5, kPi / 2);
  expect_place(place_on_walk(walk, 7), 2, 0.5, -kPi / 2);
  expect_place(place_on_walk(walk, 10), 1, 0, kPi);
  expect_place(place_on_walk(walk, 12), 0, 0, 0);
  expect_place(place_on_walk(walk, 14), 1, 0, 0);
}

TEST(Walk, StartLiesOnTheWay) {
  expect_place(place_on_walk({{{0, 0}, {4, 0}}, 1, 5}, 0), 3, 0, kPi);
  expect_place(place_on_walk({{{0, 0}, {4, 0}}, 1, 0}, -1), 1, 0, kPi);
}

TEST(Walk, NoWayIsStanding) {
  expect_place(place_on_walk({{{3, 4}, {3, 4}}, 1, 0}, 7), 3, 4, 0);
  expect_place(place_on_walk({{{3, 4}}, 1, 0}, 7), 3, 4, 0);
}

}  // namespace
}  // namespace lakshya::sim

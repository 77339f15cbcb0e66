#include "app/tools/sim/walk.h"

#include <gtest/gtest.h>

#include <cmath>
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

World street(double halts_m) {
  World world;
  Thing man;
  man.walk = Walk{{{0, 0}, {6, 0}}, 1, 0, halts_m};
  world.things = {Thing{}, man};
  return world;
}

// Where he is after so many seconds with a vehicle of 0.35 m standing at (3, y).
Place after(const World& world, double seconds, double y) {
  Walkers walkers(world);
  for (int k = 1; k <= std::lround(seconds * 50); ++k)
    walkers.step(k / 50.0, 3, y, 0.35);
  return place_on_walk(*world.things[1].walk, walkers.times().of(1));
}

TEST(Walkers, StandsBeforeTheVehicleAndTurnsRound) {
  const World world = street(0.6);
  expect_place(after(world, 1, 0), 1, 0, 0);
  // 3 m less two radii and 0.6 m; steps are 0.02 m.
  const Place stands = after(world, 3.5, 0);
  EXPECT_NEAR(stands.x, 1.75, 0.021);
  EXPECT_EQ(stands.yaw, 0);
  const Place leaves = after(world, 4.8, 0);
  EXPECT_NEAR(leaves.x, 1.75 - 1.05, 0.05);
  EXPECT_NEAR(std::abs(leaves.yaw), kPi, 1e-9);
}

TEST(Walkers, PassesWhatIsBesideHim) {
  expect_place(after(street(0.6), 5, 1.3), 5, 0, 0);
}

TEST(Walkers, BlindOnesWalkOn) {
  expect_place(after(street(0), 3, 0.2), 3, 0, 0);
}

TEST(Walkers, OneTimeForAllUnlessTheyHaveTheirOwn) {
  EXPECT_EQ(WalkTimes(3.5).of(7), 3.5);
  EXPECT_EQ(WalkTimes({1, 2}).of(1), 2);
}

}  // namespace
}  // namespace lakshya::sim

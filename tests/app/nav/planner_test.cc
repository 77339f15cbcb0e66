#include "app/nav/planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/count_allocations.h"
#include "tests/support/planner_trial.h"

namespace lakshya {
namespace {

using test::mirror_into;
using test::scatter;
using test::towards;
using test::Trial;

TEST(Planner, FreeWorldGoesToTheTarget) {
  Trial trial;
  for (int deg = -80; deg <= 80; ++deg) {
    const Plan plan = trial.fresh(towards(deg));
    EXPECT_FALSE(plan.blocked);
    EXPECT_NEAR(degrees(plan.direction), deg, 1e-9);
    ASSERT_EQ(plan.openings.count, 1);
    EXPECT_NEAR(degrees(plan.openings.items[0].right_edge()), -92.5, 1e-9);
    EXPECT_NEAR(degrees(plan.openings.items[0].left_edge()), 92.5, 1e-9);
  }
}

TEST(Planner, ATargetBehindIsTurnedTo) {
  Trial trial;
  EXPECT_NEAR(degrees(trial.fresh(towards(150)).direction), 90, 1e-9);
  EXPECT_NEAR(degrees(trial.fresh(towards(-150)).direction), -90, 1e-9);
  EXPECT_NEAR(degrees(trial.fresh(towards(180)).direction), 90, 1e-9);
  EXPECT_NEAR(trial.fresh(towards(150)).speed_mps, 0, 1e-9);
  EXPECT_GT(trial.fresh(towards(150)).turn_rate_rps, 0);
}

TEST(Planner, AWallAcrossBlocks) {
  Trial trial;
  trial.rows(3, 5, kCellObstacle);
  const Plan plan = trial.fresh(towards(10));
  EXPECT_TRUE(plan.blocked);
  EXPECT_EQ(plan.recovery, Side::left);
  EXPECT_EQ(plan.openings.count, 0);
  EXPECT_EQ(plan.speed_mps, 0);
  EXPECT_EQ(plan.turn_rate_rps, 0);
  EXPECT_EQ(plan.wheels.left_mps, 0);
}

TEST(Planner, BlockedItTurnsToTheMoreOpenSide) {
  Trial trial;
  trial.rows(3, 5, kCellObstacle);
  trial.block(5, 30, 0, 20, kCellObstacle);
  EXPECT_EQ(trial.fresh().recovery, Side::right);
  trial.block(5, 30, 40, 60, kCellObstacle);
  trial.block(5, 10, 20, 25, kCellUnoccupied);
  EXPECT_EQ(trial.fresh().recovery, Side::left);
}

TEST(Planner, AGapInTheWallIsTaken) {
  Trial trial;
  trial.rows(20, 22, kCellObstacle);
  trial.block(20, 22, 12, 28, kCellUnoccupied);  // 0.2 to 1.8 m left, 2.1 m ahead: middle 25.5 deg
  const Plan plan = trial.fresh();
  ASSERT_FALSE(plan.blocked);
  EXPECT_NEAR(degrees(plan.direction), 25, 5);
  EXPECT_GT(plan.clear_distance_m, 2.5);
}

TEST(Planner, OfTwoGapsTheCheaperOne) {
  Trial trial;
  trial.rows(20, 22, kCellObstacle);
  trial.block(20, 22, 8, 24, kCellUnoccupied);   // left, middle 33.7 deg
  trial.block(20, 22, 36, 52, kCellUnoccupied);  // right, its mirror image
  EXPECT_GT(trial.fresh(towards(5)).direction, 0.3);
  EXPECT_LT(trial.fresh(towards(-5)).direction, -0.3);
  EXPECT_GT(trial.fresh().direction, 0.3);  // tie: left
  PlanInput keep = towards(2);
  keep.previous = radians(-30);
  EXPECT_LT(trial.fresh(keep).direction, -0.3);
  PlanInput moving = towards(2);
  moving.heading = radians(-30);
  EXPECT_LT(trial.fresh(moving).direction, -0.3);
}

TEST(Planner, HandComputedSpeedAndWheels) {
  Trial trial;
  trial.rows(30, 31, kCellObstacle);
  trial.params.active_radius_m = 2;  // the wall does not enter the histogram
  const Plan plan = trial.fresh();
  EXPECT_EQ(plan.histogram, PolarHistogram{});
  EXPECT_NEAR(plan.clear_distance_m, 3.0, 1e-9);
  EXPECT_EQ(plan.clear_end, ClearEnd::obstacle);
  // 0.25 v + v^2 / 4 = 3 - 0.35 - 0.3 = 2.35: v = (-1 + sqrt(1 + 16 * 2.35)) / 2.
  EXPECT_NEAR(plan.speed_mps, (-1 + std::sqrt(38.6)) / 2, 1e-9);
  EXPECT_EQ(plan.wheels.left_mps, plan.wheels.right_mps);

  const Plan left = trial.fresh(towards(20));
  EXPECT_NEAR(left.turn_rate_rps, 1.5 * radians(20), 1e-9);
  EXPECT_NEAR(left.wheels.right_mps - left.wheels.left_mps, 0.5 * left.turn_rate_rps, 1e-9);
  EXPECT_NEAR((left.wheels.right_mps + left.wheels.left_mps) / 2, left.speed_mps, 1e-9);
  EXPECT_NEAR(trial.fresh(towards(80)).turn_rate_rps, radians(90), 1e-9);
}

TEST(Planner, UnseenSectorsAreNotSelectable) {
  Trial trial;
  trial.rows(0, 60, kCellUnknown);
  EXPECT_TRUE(trial.fresh().blocked);
  // A view of 2 x 45 deg whose first 0.4 m are hidden.
  for (int r = 4; r < 60; ++r)
    trial.block(r, r + 1, std::max(0, 29 - r), std::min(60, 31 + r), kCellUnoccupied);
  const Plan plan = trial.fresh(towards(80));
  ASSERT_EQ(plan.openings.count, 1);
  EXPECT_EQ(plan.openings.items[0].right, Border::view);
  EXPECT_NEAR(degrees(plan.direction), degrees(plan.openings.items[0].left_edge()) - 2.5, 1e-9);
  EXPECT_NEAR(degrees(plan.direction), 45, 2.6);
  EXPECT_FALSE(plan.seen[18]);
}

TEST(Planner, UnknownStopsOrSlows) {
  Trial trial;
  trial.rows(10, 60, kCellUnknown);
  EXPECT_NEAR(trial.fresh().speed_mps, (-1 + std::sqrt(6.6)) / 2, 1e-9);  // 1 m clear, 0.35 m to go
  trial.vehicle.stop_margin_m = 1.0;
  EXPECT_EQ(trial.fresh().speed_mps, 0);
  EXPECT_FALSE(trial.fresh().blocked);
  trial.params.unknown = "slow";
  EXPECT_NEAR(trial.fresh().speed_mps, 0.2, 1e-9);
  EXPECT_NEAR(trial.fresh().clear_distance_m, 1.0, 1e-9);
  trial.vehicle.max_speed_mps = 0.1;
  EXPECT_NEAR(trial.fresh().speed_mps, 0.1, 1e-9);
}

TEST(Planner, CreepingEndsBeforeAKnownObstacle) {
  Trial trial;
  trial.params.unknown = "slow";
  trial.params.active_radius_m = 0.6;
  trial.rows(10, 12, kCellUnknown);
  trial.rows(12, 60, kCellObstacle);
  trial.vehicle.stop_margin_m = 1.2;
  EXPECT_EQ(trial.fresh().speed_mps, 0);
  trial.vehicle.stop_margin_m = 0.65;
  EXPECT_NEAR(trial.fresh().speed_mps, 0.2, 1e-9);
}

TEST(Planner, HysteresisKeepsASectorUntilItIsClearlyFree) {
  Trial trial;
  const PolarParams polar{.active_radius_mm = 4000, .enlargement_mm = 450};
  ASSERT_EQ(build_polar_table(trial.geometry, polar, trial.table), Status::ok);
  const int weight = trial.table[30 * 60 + 30].weight;  // 3.05 m ahead, 0.05 m to the right
  trial.params.threshold_high = 2 * weight - 1;
  trial.params.threshold_low = weight;
  trial.block(30, 31, 30, 31, kCellObstacle);
  EXPECT_FALSE(trial.fresh().binary[0]);
  trial.block(30, 31, 29, 31, kCellObstacle);
  EXPECT_TRUE(trial.plan().binary[0]);
  trial.block(30, 31, 29, 30, kCellUnoccupied);
  EXPECT_TRUE(trial.plan().binary[0]);
  trial.block(30, 31, 30, 31, kCellUnoccupied);
  EXPECT_FALSE(trial.plan().binary[0]);
}

TEST(Planner, HysteresisTurnsWithTheWorld) {
  Trial trial;
  trial.params.threshold_low = 0;  // nothing blocked is ever freed
  trial.block(30, 31, 29, 31, kCellObstacle);
  const Plan before = trial.fresh();
  trial.block(30, 31, 29, 31, kCellUnoccupied);
  const Plan after = trial.plan({.heading_change = radians(15)});
  for (int k = 0; k < kPolarSectors; ++k)
    EXPECT_EQ(after.binary[sector_index(k)], before.binary[sector_index(k + 3)]);
}

TEST(Planner, TheTurningRadiusMasks) {
  Trial trial;
  trial.block(14, 16, 20, 23, kCellObstacle);  // 0.7 to 1 m left
  const Plan on_the_spot = trial.fresh(towards(80));
  EXPECT_GT(degrees(on_the_spot.direction), 60);
  trial.params.turning_radius_m = 1.5;
  const Plan wide = trial.fresh(towards(80));
  EXPECT_LT(degrees(wide.direction), 30);
  EXPECT_FALSE(wide.binary[18]);
  EXPECT_TRUE(wide.masked[18]);
}

TEST(Planner, MirroredWorldsGiveMirroredPlans) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(-1.5, 1.5);
  int chosen = 0;
  for (int i = 0; i < 300; ++i) {
    Trial world;
    world.params.turning_radius_m = i % 3 == 0 ? 0.8 : 0.0;
    world.params.unknown = i % 2 == 0 ? "stop" : "slow";
    scatter(random, world);
    Trial mirror = world;
    mirror_into(world, mirror);
    const PlanInput input{.target = angle(random), .heading = angle(random), .previous = angle(random)};
    const PlanInput mirrored{.target = -input.target, .heading = -input.heading, .previous = -*input.previous};
    const Plan a = world.fresh(input);
    const Plan b = mirror.fresh(mirrored);
    for (int k = 0; k < kPolarSectors; ++k) {
      ASSERT_EQ(a.histogram[sector_index(k)], b.histogram[sector_index(-k)]);
      ASSERT_EQ(a.selectable[sector_index(k)], b.selectable[sector_index(-k)]);
    }
    ASSERT_EQ(a.blocked, b.blocked);
    ASSERT_NEAR(a.direction, -b.direction, 1e-9) << i;
    ASSERT_NEAR(a.clear_distance_m, b.clear_distance_m, 1e-9);
    ASSERT_NEAR(a.wheels.left_mps, b.wheels.right_mps, 1e-9);
    chosen += a.blocked ? 0 : 1;
  }
  EXPECT_GT(chosen, 100);
  EXPECT_LT(chosen, 300);
}

TEST(Planner, AWiderVehicleIsBlockedWhereverANarrowOneIs) {
  std::mt19937 random(12);
  for (int i = 0; i < 100; ++i) {
    Trial narrow;
    narrow.params.turning_radius_m = i % 2;
    scatter(random, narrow);
    Trial wide = narrow;
    wide.vehicle.radius_m = narrow.vehicle.radius_m + 0.2;
    const Plan a = narrow.fresh();
    const Plan b = wide.fresh();
    ASSERT_LE(a.blocked, b.blocked);
    if (a.squeezes || b.squeezes) continue;  // other histograms
    for (std::size_t k = 0; k < kPolarSectors; ++k) {
      ASSERT_LE(a.binary[k], b.binary[k]);
      ASSERT_LE(a.masked[k], b.masked[k]);
      ASSERT_GE(a.selectable[k], b.selectable[k]);
    }
  }
}

TEST(Planner, PlanningDoesNotAllocate) {
  Trial trial;
  std::mt19937 random(13);
  scatter(random, trial);
  trial.params.turning_radius_m = 0.5;
  trial.params.unknown = "slow";
  trial.configure();
  Plan plan;
  const int before = test::allocations;
  const Status status = trial.planner.plan(trial.type.view(), towards(10), trial.state, plan);
  EXPECT_EQ(test::allocations, before);
  EXPECT_EQ(status, Status::ok);
}

TEST(Planner, Refusals) {
  Trial trial;
  const auto configure = [&] {
    return trial.planner.configure(trial.params, trial.vehicle, trial.geometry, trial.table);
  };
  Plan plan;
  EXPECT_EQ(trial.planner.plan(trial.type.view(), {}, trial.state, plan), Status::size_mismatch);  // not configured

  trial.params.name = "vfh**";
  EXPECT_EQ(configure(), Status::bad_argument);
  trial.params.name = "vfh+";
  trial.params.unknown = "ignore";
  EXPECT_EQ(configure(), Status::bad_argument);
  trial.params.unknown = "stop";
  for (const double radius_m : {0.0, -1.0, 1001.0, std::numeric_limits<double>::quiet_NaN()}) {
    trial.params.active_radius_m = radius_m;
    EXPECT_EQ(configure(), Status::bad_argument);
  }
  trial.params.active_radius_m = 4;
  trial.vehicle.radius_m = -1;
  EXPECT_EQ(configure(), Status::bad_argument);
  trial.vehicle.radius_m = 0.35;
  trial.table.pop_back();
  EXPECT_EQ(configure(), Status::size_mismatch);
  trial.table.emplace_back();
  ASSERT_EQ(configure(), Status::ok);

  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refuses = [&](const PlanInput& input) {
    return trial.planner.plan(trial.type.view(), input, trial.state, plan) == Status::bad_argument;
  };
  EXPECT_TRUE(refuses({.target = nan}));
  EXPECT_TRUE(refuses({.heading = std::numeric_limits<double>::infinity()}));
  EXPECT_TRUE(refuses({.previous = nan}));
  EXPECT_TRUE(refuses({.heading_change = nan}));
  const Image<std::uint8_t> small(59, 60, kCellUnoccupied);
  EXPECT_EQ(trial.planner.plan(small.view(), {}, trial.state, plan), Status::size_mismatch);
}

}  // namespace
}  // namespace lakshya

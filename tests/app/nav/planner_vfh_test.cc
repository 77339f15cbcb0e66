// The planner with the histogram of 1991; what it shares with VFH+ is in planner_test.cc.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "app/nav/planner.h"
#include "tests/support/count_allocations.h"
#include "tests/support/planner_trial.h"

namespace lakshya {
namespace {

using test::mirror_into;
using test::scatter;
using test::towards;

class Trial : public test::Trial {
 public:
  Trial() { params.name = "vfh"; }
};

TEST(PlannerVfh, FreeWorldGoesToTheTarget) {
  Trial trial;
  for (int deg = -80; deg <= 80; ++deg) {
    const Plan plan = trial.fresh(towards(deg));
    EXPECT_FALSE(plan.blocked);
    EXPECT_NEAR(degrees(plan.direction), deg, 1e-9);
  }
  EXPECT_NEAR(degrees(trial.fresh(towards(150)).direction), 90, 1e-9);
  EXPECT_NEAR(trial.fresh().speed_mps, (-1 + std::sqrt(1 + 16 * (6 - 0.65))) / 2, 1e-9);  // the governor's
}

// One cell 2.05 m ahead, 0.05 m to the left: 1.4 deg, 2050.6 mm of 4000: weight 487. Smoothed 487 (6 - |k|) / 11.
TEST(PlannerVfh, HandComputedHistogram) {
  Trial trial;
  trial.block(20, 21, 29, 30, kCellObstacle);
  const Plan plan = trial.fresh();
  EXPECT_EQ(plan.histogram[0], 266U);
  EXPECT_EQ(plan.histogram[1], 221U);
  EXPECT_EQ(plan.histogram[71], 221U);
  EXPECT_EQ(plan.histogram[5], 44U);
  EXPECT_EQ(plan.histogram[6], 0U);
  for (std::size_t k = 0; k < kPolarSectors; ++k)
    EXPECT_EQ(plan.binary[k], k == 0);  // above 250
  trial.params.vfh_threshold = 266;
  EXPECT_FALSE(trial.fresh().binary[0]);
  trial.params.vfh_smoothing = 0;
  EXPECT_EQ(trial.fresh().histogram[0], 487U);
  EXPECT_EQ(trial.fresh().histogram[1], 0U);
}

// That cell again: free from 5 to 90 deg (the border of the view), so s_max / 2 = 40 deg are kept from it.
TEST(PlannerVfh, KeepsHalfOfSMaxFromAnObstacle) {
  Trial trial;
  trial.block(20, 21, 29, 30, kCellObstacle);
  EXPECT_NEAR(degrees(trial.fresh(towards(3)).direction), 45, 1e-9);
  EXPECT_NEAR(degrees(trial.fresh(towards(50)).direction), 50, 1e-9);
  EXPECT_NEAR(degrees(trial.fresh(towards(-3)).direction), -45, 1e-9);
  trial.params.wide_opening_sectors = 10;
  EXPECT_NEAR(degrees(trial.fresh(towards(3)).direction), 30, 1e-9);
}

TEST(PlannerVfh, AGapIsTakenInItsMiddle) {
  Trial trial;
  trial.rows(12, 14, kCellObstacle);
  trial.block(12, 14, 6, 28, kCellUnoccupied);  // 0.2 to 2.4 m left, 1.3 m ahead: middle 35 deg
  const Plan plan = trial.fresh();
  ASSERT_FALSE(plan.blocked);
  const auto valleys = plan.openings.view();
  const auto gap = std::find_if(valleys.begin(), valleys.end(), [&](const Opening& valley) {
    return valley.right_edge() < plan.direction && plan.direction < valley.left_edge();
  });
  ASSERT_NE(gap, valleys.end());
  EXPECT_NEAR(plan.direction, (gap->left_edge() + gap->right_edge()) / 2, 1e-9);
  EXPECT_NEAR(degrees(plan.direction), 35, 6);
}

TEST(PlannerVfh, AWallAcrossBlocks) {
  Trial trial;
  trial.rows(3, 5, kCellObstacle);
  trial.block(5, 30, 0, 20, kCellObstacle);
  const Plan plan = trial.fresh(towards(10));
  EXPECT_TRUE(plan.blocked);
  EXPECT_EQ(plan.recovery, Side::right);
  EXPECT_EQ(plan.speed_mps, 0);
  EXPECT_EQ(plan.wheels.left_mps, 0);
}

// What is not seen cannot be chosen, and the clear distance ends at unknown cells, whatever the histogram says.
TEST(PlannerVfh, UnseenAndUnknownAreRespected) {
  Trial trial;
  trial.rows(0, 60, kCellUnknown);
  EXPECT_TRUE(trial.fresh().blocked);
  for (int r = 4; r < 60; ++r)
    trial.block(r, r + 1, std::max(0, 29 - r), std::min(60, 31 + r), kCellUnoccupied);
  EXPECT_NEAR(degrees(trial.fresh(towards(80)).direction), 45, 2.6);
  trial.rows(10, 60, kCellUnknown);
  EXPECT_NEAR(trial.fresh().speed_mps, (-1 + std::sqrt(6.6)) / 2, 1e-9);  // 1 m clear, 0.35 m to go
  trial.vehicle.stop_margin_m = 1.0;
  EXPECT_EQ(trial.fresh().speed_mps, 0);
  trial.params.unknown = "slow";
  EXPECT_NEAR(trial.fresh().speed_mps, 0.2, 1e-9);
}

// Boxes up to 1.2 m wide, seen over 90 degrees.
void put_boxes(std::mt19937& random, Trial& trial) {
  const auto draw = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
  trial.rows(0, 60, kCellUnoccupied);
  for (int box = 0; box < 5; ++box) {
    const int row = 8 + draw(45);
    const int col = draw(58);
    const int cols = 1 + draw(12);
    const int rows = 1 + draw(2);
    trial.block(row, row + rows, col, std::min(60, col + cols), kCellObstacle);
  }
  for (int r = 0; r < 22; ++r) {
    trial.block(r, r + 1, 0, 23 - r, kCellUnknown);
    trial.block(r, r + 1, 37 + r, 60, kCellUnknown);
  }
}

int shut_corridors(int threshold) {
  std::mt19937 random(5);
  Trial trial;
  trial.params.active_radius_m = 3;
  trial.params.vfh_threshold = threshold;
  int shut = 0;
  for (int world = 0; world < 400; ++world) {
    put_boxes(random, trial);
    const Plan plan = trial.fresh(towards(static_cast<double>(random() % 121) - 60));
    if (plan.blocked) continue;
    const double clear_m =
        corridor_obstacle_m(trial.type.view(), trial.geometry, plan.direction, trial.vehicle.radius_m);
    shut += clear_m < 0.6 * trial.params.active_radius_m ? 1 : 0;
  }
  return shut;
}

// Where the default threshold comes from (docs/contract.md): far below the one from which on the vehicle would scrape.
TEST(PlannerVfh, TheDefaultThresholdLeavesTheVehicleRoom) {
  const int threshold = PlannerParams().vfh_threshold;
  EXPECT_EQ(shut_corridors(threshold), 0);
  EXPECT_EQ(shut_corridors(2 * threshold), 3);
  EXPECT_EQ(shut_corridors(8 * threshold), 34);
}

TEST(PlannerVfh, DensityAheadSlowsDown) {
  Trial trial;
  trial.vehicle.max_speed_mps = 1;  // less than the governor allows
  trial.block(20, 21, 29, 30, kCellObstacle);
  trial.params.vfh_stop_density = 532;  // twice the density straight ahead
  const double cosine = std::cos(radians(50));
  EXPECT_NEAR(trial.fresh(towards(50)).speed_mps, 0.5 * cosine, 1e-9);
  PlanInput moving = towards(50);
  moving.heading = radians(50);  // nothing there
  EXPECT_NEAR(trial.fresh(moving).speed_mps, cosine, 1e-9);
  trial.params.vfh_stop_density = 266;
  const Plan turning = trial.fresh(towards(50));
  EXPECT_EQ(turning.speed_mps, 0);
  EXPECT_GT(turning.turn_rate_rps, 0);
}

TEST(PlannerVfh, FramesLeaveNothingToTheNext) {
  Trial trial;
  trial.block(20, 21, 29, 30, kCellObstacle);
  EXPECT_TRUE(trial.fresh().binary[0]);
  trial.block(20, 21, 29, 30, kCellUnoccupied);
  EXPECT_EQ(trial.plan({.heading_change = radians(30)}).binary, SectorMask{});
  EXPECT_EQ(trial.state.binary.blocked, SectorMask{});
}

TEST(PlannerVfh, MirroredWorldsGiveMirroredPlans) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> angle(-1.5, 1.5);
  int chosen = 0;
  for (int i = 0; i < 300; ++i) {
    Trial world;
    world.params.turning_radius_m = i % 3 == 0 ? 0.8 : 0.0;
    scatter(random, world);
    Trial mirror = world;
    mirror_into(world, mirror);
    const PlanInput input = {.target = angle(random), .heading = angle(random)};
    const Plan a = world.fresh(input);
    const Plan b = mirror.fresh({.target = -input.target, .heading = -input.heading});
    for (int k = 0; k < kPolarSectors; ++k)
      ASSERT_EQ(a.histogram[sector_index(k)], b.histogram[sector_index(-k)]);
    ASSERT_EQ(a.blocked, b.blocked);
    ASSERT_NEAR(a.direction, -b.direction, 1e-9) << i;
    ASSERT_NEAR(a.wheels.left_mps, b.wheels.right_mps, 1e-9);
    chosen += a.blocked ? 0 : 1;
  }
  EXPECT_GT(chosen, 100);
}

TEST(PlannerVfh, PlanningDoesNotAllocate) {
  Trial trial;
  std::mt19937 random(13);
  scatter(random, trial);
  trial.configure();
  Plan plan;
  const int before = test::allocations;
  const Status status = trial.planner.plan(trial.type.view(), towards(10), trial.state, plan);
  EXPECT_EQ(test::allocations, before);
  EXPECT_EQ(status, Status::ok);
}

TEST(PlannerVfh, RefusalsAndThresholds) {
  Trial trial;
  const auto configure = [&] {
    return trial.planner.configure(trial.params, trial.vehicle, trial.geometry, trial.table);
  };
  for (const int l : {-1, kMaxSmoothing + 1}) {
    trial.params.vfh_smoothing = l;
    EXPECT_EQ(configure(), Status::bad_argument);
  }
  trial.params.vfh_smoothing = kMaxSmoothing;
  trial.params.vfh_stop_density = 0;
  EXPECT_EQ(configure(), Status::bad_argument);
  trial.params.vfh_stop_density = 1;
  EXPECT_EQ(configure(), Status::ok);
  trial.params.vfh_threshold = 77;
  EXPECT_EQ(histogram_thresholds(trial.params).low, 77);
  EXPECT_EQ(histogram_thresholds(trial.params).high, 77);
  trial.params.name = "vfh+";
  EXPECT_EQ(histogram_thresholds(trial.params).high, trial.params.threshold_high);
}

}  // namespace
}  // namespace lakshya

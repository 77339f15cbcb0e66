// What the planner keeps from frame to frame, and VFH*.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>

#include "app/nav/planner.h"
#include "tests/support/count_allocations.h"
#include "tests/support/planner_trial.h"

namespace lakshya {
namespace {

using test::mirror_into;
using test::scatter;
using test::towards;
using test::Trial;

// Two gaps, mirror images of each other, in a wall 2 m ahead; borders of both come and go by a cell in every frame.
void draw_two_gaps(std::mt19937& random, Trial& trial) {
  trial.rows(0, 60, kCellUnoccupied);
  trial.rows(20, 22, kCellObstacle);
  const auto jitter = [&] { return static_cast<int>(random() % 3) - 1; };
  trial.block(20, 22, 8 + jitter(), 24 + jitter(), kCellUnoccupied);
  trial.block(20, 22, 36 + jitter(), 52 + jitter(), kCellUnoccupied);
}

TEST(PlannerMemory, OfTwoEqualGapsItKeepsTheSide) {
  for (const char* name : {"vfh+", "vfh*"}) {
    std::mt19937 random(3);
    Trial trial;
    trial.params.name = name;
    trial.configure();
    draw_two_gaps(random, trial);
    Plan plan = trial.plan();
    const double side = plan.direction;
    ASSERT_GT(std::abs(side), 0.3);
    for (int i = 0; i < 50; ++i) {
      draw_two_gaps(random, trial);
      PlanInput input;
      input.previous = plan.direction;
      plan = trial.plan(input);
      ASSERT_FALSE(plan.blocked);
      ASSERT_GT(plan.direction * side, 0) << name << " " << i;
    }
  }
}

// The chosen gap is shut for some frames: it waits, and goes on there when it opens again; the other side is taken only after that.
TEST(PlannerMemory, AShutGapIsWaitedForBeforeTheOtherSideIsTaken) {
  Trial trial;
  trial.configure();
  std::mt19937 random(3);
  const auto shut = [&](bool left) {
    trial.rows(0, 60, kCellUnoccupied);
    trial.rows(20, 22, kCellObstacle);
    if (!left) trial.block(20, 22, 8, 24, kCellUnoccupied);
    trial.block(20, 22, 36, 52, kCellUnoccupied);
  };
  shut(false);
  Plan plan = trial.plan(towards(5));
  ASSERT_GT(plan.direction, 0.3);
  const auto next = [&](bool left_is_shut) {
    shut(left_is_shut);
    PlanInput input = towards(5);
    input.previous = plan.direction;
    plan = trial.plan(input);
  };
  for (int i = 0; i < kPatience; ++i) {
    next(true);
    ASSERT_TRUE(plan.waits) << i;
    ASSERT_GT(plan.direction, 0.3);
    ASSERT_EQ(plan.speed_mps, 0);
  }
  next(false);
  EXPECT_FALSE(plan.waits);
  EXPECT_GT(plan.direction, 0.3);
  EXPECT_GT(plan.speed_mps, 0);
  for (int i = 0; i <= kPatience; ++i)
    next(true);
  EXPECT_FALSE(plan.waits);
  EXPECT_LT(plan.direction, -0.3);
}

TEST(PlannerMemory, RecoveryKeepsItsSideAndEndsAfterAFullTurn) {
  Trial trial;
  trial.configure();
  const auto hem_in = [&](bool left_looks_open) {
    trial.rows(0, 60, kCellUnoccupied);
    trial.rows(3, 5, kCellObstacle);
    if (left_looks_open) {
      trial.block(5, 30, 40, 60, kCellObstacle);
    } else {
      trial.block(5, 30, 0, 20, kCellObstacle);
    }
  };
  hem_in(true);
  const Side side = trial.plan().recovery;
  int frames = 1;
  Plan plan;
  for (double turned = 0; turned < 350; turned += 3, ++frames) {
    hem_in(frames % 2 == 0);
    plan = trial.plan({.heading_change = radians(3)});
    ASSERT_TRUE(plan.blocked);
    ASSERT_EQ(plan.recovery, side) << turned;
    ASSERT_FALSE(plan.hemmed_in) << turned;
  }
  for (int i = 0; i < 5; ++i)
    plan = trial.plan({.heading_change = radians(3)});
  EXPECT_TRUE(plan.hemmed_in);
  // A way that stays open for long lets all that be forgotten.
  trial.rows(0, 60, kCellUnoccupied);
  for (int i = 0; i < 3; ++i)
    EXPECT_FALSE(trial.plan().blocked);
  hem_in(true);
  EXPECT_TRUE(trial.plan().hemmed_in);
  trial.rows(0, 60, kCellUnoccupied);
  for (int i = 0; i <= Recovery::kRemembered; ++i)
    EXPECT_FALSE(trial.plan().blocked);
  hem_in(true);
  EXPECT_FALSE(trial.plan().hemmed_in);
}

// 1 m between two posts: too narrow with the safety distance, wide enough without it. First it stops.
TEST(PlannerMemory, ANarrowGapIsCreptThroughWhenNothingElseIsOpen) {
  Trial trial;
  trial.rows(8, 9, kCellObstacle);
  trial.block(8, 9, 25, 35, kCellUnoccupied);
  trial.block(0, 8, 0, 24, kCellObstacle);
  trial.block(0, 8, 36, 60, kCellObstacle);
  trial.vehicle.safety_distance_m = 0.2;
  ASSERT_TRUE(trial.fresh().blocked);
  const Plan plan = trial.plan();
  ASSERT_FALSE(plan.blocked);
  EXPECT_TRUE(plan.squeezes);
  EXPECT_NEAR(degrees(plan.direction), 0, 2.6);
  EXPECT_LE(plan.speed_mps, trial.params.unknown_speed_mps);
  trial.vehicle.radius_m = 0.5;
  trial.fresh();
  EXPECT_TRUE(trial.plan().blocked);
}

// What is beside the vehicle's way while it still turns limits its speed.
TEST(PlannerMemory, TurningAwayFromAnObstacleAheadIsDoneSlowly) {
  Trial trial;
  trial.block(9, 11, 28, 60, kCellObstacle);
  const Plan plan = trial.fresh(towards(60));
  ASSERT_GT(plan.direction, radians(30));
  EXPECT_GT(plan.clear_distance_m, 2);
  EXPECT_LT(plan.speed_mps, 0.7);
  trial.params.turning_radius_m = 0.3;
  EXPECT_GT(trial.fresh(towards(60)).speed_mps, plan.speed_mps);
}

// A pocket 2.4 m wide whose bottom, 3.3 m ahead, lies beyond the active radius.
void draw_pocket(Trial& trial) {
  trial.rows(0, 60, kCellUnoccupied);
  trial.block(13, 35, 17, 19, kCellObstacle);
  trial.block(13, 35, 41, 43, kCellObstacle);
  trial.block(33, 35, 17, 43, kCellObstacle);
}

TEST(VfhStar, DoesNotEnterADeadEndThatVfhPlusEnters) {
  Trial trial;
  draw_pocket(trial);
  trial.params.active_radius_m = 2;
  trial.params.name = "vfh+";
  EXPECT_LT(std::abs(degrees(trial.fresh().direction)), 15);
  trial.params.name = "vfh*";
  EXPECT_GT(std::abs(degrees(trial.fresh().direction)), 40);
  // With one step it is no wiser, and a target in the pocket is worth going in.
  trial.params.star_depth = 1;
  EXPECT_LT(std::abs(degrees(trial.fresh().direction)), 15);
  trial.params.star_depth = 5;
  PlanInput near = towards(0);
  near.target_distance_m = 2.0;
  EXPECT_LT(std::abs(degrees(trial.fresh(near).direction)), 15);
}

TEST(VfhStar, InFreeWorldsGoesToTheTarget) {
  Trial trial;
  trial.params.name = "vfh*";
  for (int deg = -80; deg <= 80; deg += 5)
    EXPECT_NEAR(degrees(trial.fresh(towards(deg)).direction), deg, 1e-9);
}

TEST(VfhStar, MirroredWorldsGiveMirroredPlans) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> angle(-1.5, 1.5);
  int chosen = 0;
  for (int i = 0; i < 100; ++i) {
    Trial world;
    world.params.name = "vfh*";
    scatter(random, world);
    Trial mirror = world;
    mirror_into(world, mirror);
    const PlanInput input{.target = angle(random), .heading = angle(random)};
    const PlanInput mirrored{.target = -input.target, .heading = -input.heading};
    const Plan a = world.fresh(input);
    const Plan b = mirror.fresh(mirrored);
    ASSERT_EQ(a.blocked, b.blocked);
    ASSERT_NEAR(a.direction, -b.direction, 1e-9) << i;
    chosen += a.blocked ? 0 : 1;
  }
  EXPECT_GT(chosen, 30);
}

// The histogram about another place is the one that a vehicle there would sum.
TEST(VfhStar, HistogramsAboutOtherPlaces) {
  Trial trial;
  trial.params.active_radius_m = 2;
  std::mt19937 random(8);
  for (int i = 0; i < 200; ++i) {
    const int r = static_cast<int>(random() % 60);
    const int c = static_cast<int>(random() % 60);
    trial.block(r, r + 1, c, c + 1, kCellObstacle);
  }
  trial.configure();
  StarCells cells;
  find_star_cells(trial.type.view(), trial.geometry, 10, cells);
  Trial there;
  there.params = trial.params;
  there.configure();
  for (const int rows : {0, 7, 20}) {
    for (const int left : {-6, 0, 5}) {
      there.rows(0, 60, kCellUnoccupied);
      for (int i = 0; i < cells.count; ++i) {
        const StarCells::Cell& cell = cells.items[static_cast<std::size_t>(i)];
        const int r = cell.row - rows;
        const int c = cell.col + left;
        if (r >= 0 && r < 60 && c >= 0 && c < 60) there.block(r, r + 1, c, c + 1, kCellObstacle);
      }
      StarCells ahead;
      find_star_cells(there.type.view(), there.geometry, 10, ahead);
      EXPECT_EQ(star_histogram(ahead, there.geometry, there.table, 0, 0), there.plan().histogram);
      // Those behind are the mirror image.
      const PolarHistogram all = star_histogram(cells, trial.geometry, trial.table, rows, left);
      const PolarHistogram front = star_histogram(ahead, there.geometry, there.table, 0, 0);
      std::uint64_t more = 0;
      for (std::size_t k = 0; k < kPolarSectors; ++k) {
        ASSERT_GE(all[k], front[k]);
        more += all[k] - front[k];
      }
      EXPECT_EQ(more == 0, rows == 0);
    }
  }
}

TEST(VfhStar, PlansWithoutAllocatingAndInTime) {
  Trial trial;
  trial.params.name = "vfh*";
  std::mt19937 random(13);
  scatter(random, trial);
  trial.configure();
  Plan plan;
  const int before = test::allocations;
  double least_us = 1e9;
  double most_us = 0;
  for (int i = 0; i < 50; ++i) {
    const PlanInput input = towards(-60 + 2.4 * i);
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(trial.planner.plan(trial.type.view(), input, trial.state, plan), Status::ok);
    const double took = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
    least_us = std::min(least_us, took);
    most_us = std::max(most_us, took);
  }
  EXPECT_EQ(test::allocations, before);
  std::printf("vfh*: %.0f to %.0f us for a plan\n", least_us, most_us);
}

}  // namespace
}  // namespace lakshya

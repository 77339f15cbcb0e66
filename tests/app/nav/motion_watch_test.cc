#include "app/nav/motion_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "app/core/image.h"
#include "kernels/base/units.h"
#include "tests/support/count_allocations.h"

namespace lakshya {
namespace {

constexpr std::int64_t kFrameNs = 100'000'000;

struct Disc {
  double east = 0;
  double north = 0;
  double radius = 0.25;
};

// Frames of 60 x 80 cells of 0.1 m from a camera at the turning centre that sees 40 degrees to either side and the floor from
// 0.8 m on; a disc's near face is an obstacle, what lies behind it is unknown.
class MotionWatchTest : public ::testing::Test {
 protected:
  MotionWatchTest() { EXPECT_EQ(watch.configure(params, geometry, {free_at, free_run, now}), Status::ok); }

  // How far a ray goes before it meets a disc; very far where there is none.
  static double free_way(const std::vector<Disc>& discs, const Pose& from, double dx, double dy) {
    double way = 100;
    for (const Disc& d : discs) {
      const double east = d.east - from.east_m;
      const double north = d.north - from.north_m;
      const double along = east * dx + north * dy;
      const double aside = east * dy - north * dx;
      if (along > 0 && std::abs(aside) <= d.radius)
        way = std::min(way, along - std::sqrt(d.radius * d.radius - aside * aside));
    }
    return way;
  }

  // `pose` is what the watch is told, `truth` where the vehicle is.
  void look(const std::vector<Disc>& discs, const Pose& truth, const Pose& pose) {
    for (int r = 0; r < geometry.rows; ++r) {
      for (int c = 0; c < geometry.cols; ++c) {
        const double forward = (r + 0.5) * 0.1;
        const double left = (geometry.cols / 2.0 - c - 0.5) * 0.1;
        set(r, c, kCellUnknown);
        const double range = std::hypot(forward, left);
        const double bearing = std::atan2(left, forward);
        if (std::abs(bearing) > params.view) continue;
        const double hidden = free_way(discs, truth, std::cos(truth.yaw + bearing), std::sin(truth.yaw + bearing));
        if (hidden < range - 0.1) continue;
        if (hidden < range + 0.05) {
          set(r, c, kCellObstacle);
        } else if (range > params.blind_m) {
          set(r, c, kCellUnoccupied);
        }
      }
    }
    time_ns += kFrameNs;
    NavGrid grid;
    grid.geometry = geometry;
    grid.count = count.view();
    grid.height_sum = height_sum.view();
    grid.type = type.view();
    ASSERT_EQ(watch.add(grid, {pose, time_ns}), Status::ok);
  }
  void look(const std::vector<Disc>& discs, const Pose& pose = {}) { look(discs, pose, pose); }

  void set(int r, int c, CellType what) {
    type.view().at(c, r) = what;
    count.view().at(c, r) = what == kCellObstacle ? 10 : 0;
    height_sum.view().at(c, r) = what == kCellObstacle ? 10 * height_mm : 0;
  }

  MotionWatchParams params{.view = 0.7, .blind_m = 0.8};
  GridGeometry geometry{.rows = 60, .cols = 80, .cell_mm = 100};
  int height_mm = 600;
  Image<std::uint8_t> type{80, 60, kCellUnknown};
  Image<std::uint32_t> count{80, 60, 0};
  Image<std::int64_t> height_sum{80, 60, 0};
  std::vector<std::uint32_t> free_at = std::vector<std::uint32_t>(kWatchCells);
  std::vector<std::uint8_t> free_run = std::vector<std::uint8_t>(kWatchCells);
  std::vector<std::uint8_t> now = std::vector<std::uint8_t>(kWatchCells);
  std::int64_t time_ns = 0;
  MotionWatch watch;
};

TEST_F(MotionWatchTest, FindsWhoWalksAcrossWithHisVelocity) {
  for (int k = 0; k < 8; ++k)
    look({});
  int frames = 0;
  double north = -0.8;
  for (; frames < 30 && watch.movers().empty(); ++frames, north += 0.08)
    look({{3, north}});
  EXPECT_LE(frames, 12);
  for (int k = 0; k < 6; ++k, north += 0.08)
    look({{3, north}});
  ASSERT_EQ(watch.movers().size(), 1U);
  const Mover m = watch.movers()[0];
  EXPECT_NEAR(m.east_m, 2.9, 0.15);
  EXPECT_NEAR(m.north_m, north - 0.08, 0.12);
  EXPECT_NEAR(m.east_mps, 0, 0.25);
  EXPECT_NEAR(m.north_mps, 0.8, 0.25);
  EXPECT_EQ(m.unseen_s, 0);
}

TEST_F(MotionWatchTest, FindsWhoComesTowardsTheMovingVehicle) {
  for (int k = 0; k < 8; ++k)
    look({});
  double vehicle = 0;
  double person = 4.5;
  int frames = 0;
  for (; frames < 25 && watch.movers().empty(); ++frames, person -= 0.07, vehicle += 0.05)
    look({{person, 0.3}}, {.east_m = vehicle});
  ASSERT_EQ(watch.movers().size(), 1U);
  EXPECT_GT(person - vehicle, 2.5);
  EXPECT_LT(watch.movers()[0].east_mps, -0.3);
}

// Boxes and a wall of discs, seen by a vehicle that drives and turns and whose pose drifts and trembles.
TEST_F(MotionWatchTest, WhatStandsIsNoMover) {
  std::mt19937 random(7);
  std::normal_distribution<double> tremble(0, 0.01);
  std::vector<Disc> discs{{3, 1.2, 0.3}, {4, -1, 0.2}, {5.5, 0.2, 0.15}, {2.5, -1.5, 0.4}};
  for (int k = 0; k < 60; ++k)
    discs.push_back({-1 + 0.15 * k, 2.5, 0.12});
  Pose truth;
  double drift = 0;
  for (int k = 0; k < 150; ++k) {
    truth.yaw = 0.4 * std::sin(k * 0.1);
    truth.east_m += 0.03 * std::cos(truth.yaw);
    truth.north_m += 0.03 * std::sin(truth.yaw);
    drift += 0.0005;
    const Pose told{truth.east_m + drift + tremble(random), truth.north_m - drift + tremble(random),
                    truth.yaw + tremble(random)};
    look(discs, truth, told);
    ASSERT_TRUE(watch.movers().empty())
        << "frame " << k << " at " << watch.movers()[0].east_m << " " << watch.movers()[0].north_m;
  }
}

// The error of a depth grows with its square: 0.27 m at 5 m with a short baseline.
TEST_F(MotionWatchTest, WhatTremblesByTheErrorOfItsDepthIsNoMover) {
  params.depth_sigma = 0.011;
  ASSERT_EQ(watch.configure(params, geometry, {free_at, free_run, now}), Status::ok);
  std::mt19937 random(11);
  std::normal_distribution<double> tremble(0, 0.27);
  double east = 5;
  for (int k = 0; k < 300; ++k) {
    east += 0.4 * (5 + tremble(random) - east);
    look({{east, 0.4}});
    ASSERT_TRUE(watch.movers().empty()) << k;
  }
}

TEST_F(MotionWatchTest, SingleFalseCellsAreNoMover) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> where(-1.5, 1.5);
  for (int k = 0; k < 200; ++k) {
    look({{3 + where(random), where(random), 0.06}, {3 + where(random), where(random), 0.06}});
    ASSERT_TRUE(watch.movers().empty()) << k;
  }
}

TEST_F(MotionWatchTest, LowThingsAreNoMover) {
  height_mm = 100;
  for (int k = 0; k < 8; ++k)
    look({});
  for (int k = 0; k < 20; ++k) {
    look({{3, -0.8 + 0.08 * k}});
    ASSERT_TRUE(watch.movers().empty()) << k;
  }
}

TEST_F(MotionWatchTest, WhoLeavesTheViewIsRemembered) {
  for (int k = 0; k < 8; ++k)
    look({});
  for (int k = 0; k < 36; ++k)
    look({{2.5, -0.6 + 0.1 * k}});
  ASSERT_EQ(watch.movers().size(), 1U);
  EXPECT_GT(watch.movers()[0].unseen_s, 0);
  EXPECT_GT(watch.movers()[0].north_mps, 0.6);
  const double unseen_s = watch.movers()[0].unseen_s;
  const double remembered_s = static_cast<double>(MotionWatch::kRememberedNs) * 1e-9;
  const int rest = static_cast<int>((remembered_s - unseen_s) * 10);
  for (int k = 0; k < rest - 1; ++k)
    look({});
  EXPECT_EQ(watch.movers().size(), 1U);
  for (int k = 0; k < 4; ++k)
    look({});
  EXPECT_TRUE(watch.movers().empty());
}

TEST_F(MotionWatchTest, WhoStandsStillIsNoMoverAnyMore) {
  for (int k = 0; k < 8; ++k)
    look({});
  for (int k = 0; k < 14; ++k)
    look({{3, -0.6 + 0.08 * k}});
  ASSERT_EQ(watch.movers().size(), 1U);
  int frames = 0;
  for (; frames < 60 && !watch.movers().empty(); ++frames)
    look({{3, 0.5}});
  EXPECT_LE(frames, 50);
}

TEST_F(MotionWatchTest, WhoTurnsRoundIsFollowed) {
  for (int k = 0; k < 8; ++k)
    look({});
  double north = -0.8;
  for (int k = 0; k < 18; ++k, north += 0.07)
    look({{3, north}});
  ASSERT_EQ(watch.movers().size(), 1U);
  for (int k = 0; k < 8; ++k, north -= 0.07)
    look({{3, north}});
  ASSERT_EQ(watch.movers().size(), 1U);
  EXPECT_LT(watch.movers()[0].north_mps, -0.3);
}

TEST_F(MotionWatchTest, BoundedInMemoryAndTime) {
  std::mt19937 random(5);
  for (int k = 0; k < 6; ++k)
    look({});
  const int before = test::allocations;
  NavGrid grid;
  grid.geometry = geometry;
  grid.count = count.view();
  grid.height_sum = height_sum.view();
  grid.type = type.view();
  for (int k = 0; k < 100; ++k) {
    for (int r = 0; r < geometry.rows; ++r) {
      for (int c = 0; c < geometry.cols; ++c)
        set(r, c, static_cast<CellType>(random() % (k % 10 < 5 ? 2U : 3U)));
    }
    time_ns += kFrameNs;
    ASSERT_EQ(watch.add(grid, {{.east_m = 0.05 * k, .yaw = 0.1 * k}, time_ns}), Status::ok);
    ASSERT_LE(watch.movers().size(), static_cast<std::size_t>(kMostMovers));
  }
  EXPECT_EQ(test::allocations, before);
}

TEST_F(MotionWatchTest, BadArguments) {
  MotionWatch other;
  NavGrid grid;
  grid.geometry = geometry;
  grid.count = count.view();
  grid.height_sum = height_sum.view();
  grid.type = type.view();
  EXPECT_EQ(other.add(grid, {}), Status::bad_argument);
  EXPECT_EQ(other.configure(params, {.rows = 0}, {free_at, free_run, now}), Status::bad_argument);
  EXPECT_EQ(other.configure({.view = 0}, geometry, {free_at, free_run, now}), Status::bad_argument);
  EXPECT_EQ(other.configure({.yaw = std::nan("")}, geometry, {free_at, free_run, now}), Status::bad_argument);
  EXPECT_EQ(other.configure(params, geometry, {free_at, free_run, {}}), Status::size_mismatch);
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(watch.add(grid, {{.east_m = inf}, 1}), Status::bad_argument);
  EXPECT_EQ(watch.add(grid, {{.yaw = std::nan("")}, 1}), Status::bad_argument);
  grid.geometry.rows = 50;
  EXPECT_EQ(watch.add(grid, {{}, 1}), Status::bad_argument);
}

}  // namespace
}  // namespace lakshya

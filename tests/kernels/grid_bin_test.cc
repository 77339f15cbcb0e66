#include "kernels/grid_bin/grid_bin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <thread>
#include <vector>

#include "kernels/base/units.h"
#include "tests/support/test_grid.h"

namespace lakshya {
namespace {

using test::TestGrid;

TEST(GridBin, CellsAreHalfOpenAsTheContractSays) {
  TestGrid g(200, 200);
  const std::vector<ObstaclePoint> points = {
      {0, 0, 500},         // row 0; left 0 is in (-100, 0]: column 100
      {99, 1, 300},        // row 0, left 1 in (0, 100]: column 99
      {100, 100, 200},     // row 1, column 99
      {1999, 10000, 100},  // row 19, column 0
      {19999, -9999, 40},  // last row, last column
  };
  ASSERT_EQ(bin_obstacles_ref(points, g.view()), Status::ok);
  EXPECT_EQ(g.view().count.at(100, 0), 1U);
  EXPECT_EQ(g.view().height_sum.at(100, 0), 500);
  EXPECT_EQ(g.view().count.at(99, 0), 1U);
  EXPECT_EQ(g.view().count.at(99, 1), 1U);
  EXPECT_EQ(g.view().count.at(0, 19), 1U);
  EXPECT_EQ(g.view().count.at(199, 199), 1U);
  EXPECT_EQ(g.total(g.view().count), 5U);
}

TEST(GridBin, AddsTheCountsOfAnotherMap) {
  TestGrid a(4, 6);
  TestGrid b(4, 6);
  TestGrid sum(4, 6);
  std::uint32_t n = 1;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 6; ++c, n += 5) {
      a.view().count.at(c, r) = n;
      b.view().count.at(c, r) = 2 * n;
      a.view().height_sum.at(c, r) = -std::int64_t{n} << 33;
      b.view().height_sum.at(c, r) = n;
      a.view().floor_count.at(c, r) = n + 1;
      b.view().floor_count.at(c, r) = n + 2;
      b.view().below_count.at(c, r) = n + 3;
    }
  }
  for (const Rows rows : {Rows{0, 1}, Rows{1, 4}}) {
    ASSERT_EQ(add_grid(a.view(), rows, sum.view()), Status::ok);
    ASSERT_EQ(add_grid(b.view(), rows, sum.view()), Status::ok);
  }
  n = 1;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 6; ++c, n += 5) {
      EXPECT_EQ(sum.view().count.at(c, r), 3 * n);
      EXPECT_EQ(sum.view().height_sum.at(c, r), n - (std::int64_t{n} << 33));
      EXPECT_EQ(sum.view().floor_count.at(c, r), 2 * n + 3);
      EXPECT_EQ(sum.view().below_count.at(c, r), n + 3);
      EXPECT_EQ(sum.view().type.at(c, r), kCellUnknown);
    }
  }
  TestGrid other(4, 8);
  EXPECT_EQ(add_grid(other.view(), {0, 4}, sum.view()), Status::bad_argument);
  EXPECT_EQ(add_grid(a.view(), {0, 5}, sum.view()), Status::bad_argument);
}

TEST(GridBin, NothingIsDroppedForBeingNear) {
  TestGrid g(10, 10);
  ASSERT_EQ(bin_obstacles_ref(std::vector<ObstaclePoint>{{-250, 0, 10}, {-1, 0, 10}}, g.view()), Status::ok);
  EXPECT_EQ(g.view().count.at(5, 0), 2U);
}

TEST(GridBin, GroundBehindTheFirstRowIsNotMovedIntoIt) {
  TestGrid g(20, 20);
  ASSERT_EQ(bin_ground_ref(std::vector<GroundStrip>{{-900, 50, -10, 50}, {-150, 50, 150, 50}}, g.view(),
                           g.view().floor_count),
            Status::ok);
  EXPECT_EQ(g.view().floor_count.at(9, 0), 1U);
  EXPECT_EQ(g.view().floor_count.at(9, 1), 1U);
  EXPECT_EQ(TestGrid::total(g.view().floor_count), 2U);
}

TEST(GridBin, PointsBesideAndBeyondTheMapAreDropped) {
  TestGrid g(10, 10);
  const std::vector<ObstaclePoint> outside = {{1000, 0, 1}, {500, 501, 1}, {500, -500, 1}, {2000000000, 0, 1}};
  ASSERT_EQ(bin_obstacles_ref(outside, g.view()), Status::ok);
  EXPECT_EQ(g.total(g.view().count), 0U);
  const std::vector<ObstaclePoint> inside = {{999, 500, 1}, {0, -499, 1}};
  ASSERT_EQ(bin_obstacles_ref(inside, g.view()), Status::ok);
  EXPECT_EQ(g.view().count.at(0, 9), 1U);
  EXPECT_EQ(g.view().count.at(9, 0), 1U);
}

TEST(GridBin, HeightsAddUpSigned) {
  TestGrid g(10, 10);
  const std::vector<ObstaclePoint> points = {{0, 0, 300}, {0, 0, -100}, {0, 0, 40}};
  ASSERT_EQ(bin_obstacles_ref(points, g.view()), Status::ok);
  EXPECT_EQ(g.view().count.at(5, 0), 3U);
  EXPECT_EQ(g.view().height_sum.at(5, 0), 240);
}

TEST(GridBin, AStripCountsOnceInEveryCellAlongIt) {
  TestGrid g(20, 20);
  // Straight ahead from row 3 to row 7.
  ASSERT_EQ(bin_ground_ref(std::vector<GroundStrip>{{350, 50, 750, 50}}, g.view(), g.view().floor_count),
            Status::ok);
  for (int r = 0; r < 20; ++r)
    EXPECT_EQ(g.view().floor_count.at(9, r), r >= 3 && r <= 7 ? 1U : 0U) << r;
  EXPECT_EQ(g.total(g.view().floor_count), 5U);
  EXPECT_EQ(g.total(g.view().count), 0U);
}

TEST(GridBin, AStripInsideOneCellCountsOnce) {
  TestGrid g(20, 20);
  ASSERT_EQ(bin_ground_ref(std::vector<GroundStrip>{{310, 20, 390, 80}}, g.view(), g.view().below_count),
            Status::ok);
  EXPECT_EQ(g.view().below_count.at(9, 3), 1U);
  EXPECT_EQ(g.total(g.view().below_count), 1U);
}

TEST(GridBin, AStripAcrossColumnsAndOverTheEdge) {
  TestGrid g(20, 20);
  // Sideways camera: from left 50 (column 9) to left 1250, beyond the edge at 1000 (column 0).
  ASSERT_EQ(bin_ground_ref(std::vector<GroundStrip>{{450, 50, 450, 1250}}, g.view(), g.view().floor_count),
            Status::ok);
  for (int c = 0; c < 20; ++c)
    EXPECT_EQ(g.view().floor_count.at(c, 4), c <= 9 ? 1U : 0U) << c;
}

std::vector<ObstaclePoint> random_points(std::size_t n) {
  std::mt19937 random(21);
  std::uniform_int_distribution<std::int32_t> forward(-300, 22000);
  std::uniform_int_distribution<std::int32_t> left(-11000, 11000);
  std::uniform_int_distribution<std::int32_t> height(-50, 1200);
  std::vector<ObstaclePoint> points(n);
  for (ObstaclePoint& p : points)
    p = {forward(random), left(random), height(random)};
  return points;
}

TEST(GridBinProperty, TheMapDoesNotDependOnTheOrderOfPoints) {
  std::vector<ObstaclePoint> points = random_points(20000);
  TestGrid a(200, 200);
  TestGrid b(200, 200);
  ASSERT_EQ(bin_obstacles_ref(points, a.view()), Status::ok);
  std::shuffle(points.begin(), points.end(), std::mt19937(22));
  ASSERT_EQ(bin_obstacles_ref(points, b.view()), Status::ok);
  EXPECT_TRUE(a == b);
}

TEST(GridBinProperty, AnyNumberOfThreadsGivesTheSameMap) {
  const std::vector<ObstaclePoint> points = random_points(20000);
  TestGrid one(200, 200);
  ASSERT_EQ(bin_obstacles_ref(points, one.view()), Status::ok);
  for (const std::size_t threads : {2U, 3U, 7U}) {
    TestGrid many(200, 200);
    std::vector<std::thread> pool;
    for (std::size_t t = 0; t < threads; ++t) {
      const std::size_t begin = points.size() * t / threads;
      const std::size_t end = points.size() * (t + 1) / threads;
      pool.emplace_back([&, begin, end] {
        EXPECT_EQ(bin_obstacles_ref(std::span(points).subspan(begin, end - begin), many.view()), Status::ok);
      });
    }
    for (std::thread& t : pool)
      t.join();
    EXPECT_TRUE(one == many) << threads;
  }
}

TEST(GridBin, ClearForgetsEverything) {
  TestGrid g(10, 10);
  ASSERT_EQ(bin_obstacles_ref(std::vector<ObstaclePoint>{{0, 0, 5}}, g.view()), Status::ok);
  g.view().type.at(5, 0) = kCellObstacle;
  ASSERT_EQ(clear_grid(g.view()), Status::ok);
  EXPECT_TRUE(g == TestGrid(10, 10));
}

TEST(GridBin, RefusesAGridThatDoesNotFitItself) {
  TestGrid g(10, 10);
  NavGrid wrong = g.view();
  wrong.geometry.cols = 8;
  EXPECT_EQ(clear_grid(wrong), Status::bad_argument);
  EXPECT_EQ(bin_obstacles_ref({}, wrong), Status::bad_argument);
  TestGrid other(9, 10);
  EXPECT_EQ(bin_ground_ref({}, g.view(), other.view().floor_count), Status::size_mismatch);
  TestGrid odd(10, 9);
  EXPECT_EQ(clear_grid(odd.view()), Status::bad_argument);
}

}  // namespace
}  // namespace lakshya

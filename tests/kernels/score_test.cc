#include "kernels/score/score.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "kernels/base/units.h"
#include "tests/support/each_isa.h"
#include "tests/support/test_grid.h"

namespace lakshya {
namespace {

using test::TestGrid;

struct Counts {
  std::uint32_t points;
  std::int64_t height_sum;
  std::uint32_t floor;
  std::uint32_t below;
};

// One cell with thresholds 10 points, 5 floor, 4 below, and h_min 70 mm.
int type_of(const Counts& c) {
  TestGrid g(1, 2);
  const NavGrid v = g.view();
  v.count.at(0, 0) = c.points;
  v.height_sum.at(0, 0) = c.height_sum;
  v.floor_count.at(0, 0) = c.floor;
  v.below_count.at(0, 0) = c.below;
  const std::vector<CellThresholds> thresholds(2, CellThresholds{10, 5, 4});
  EXPECT_EQ(score_ref(thresholds, 70, v), Status::ok);
  return v.type.at(0, 0);
}

TEST(Score, EnoughHighPointsAreAnObstacle) {
  EXPECT_EQ(type_of({50, 3501, 0, 0}), kCellObstacle);
  EXPECT_EQ(type_of({50, 3501, 50, 0}), kCellObstacle);  // floor around its foot does not free it
}

// The middle cell of 3 x 3 has 10 points, the least; `about` those of one of its corners, and there is floor to decide by.
int weak_type(std::uint32_t about, int corner_col, int corner_row, std::uint32_t floor) {
  TestGrid g(4, 4);
  const NavGrid v = g.view();
  v.count.at(1, 1) = 10;
  v.height_sum.at(1, 1) = 701;
  v.floor_count.at(1, 1) = floor;
  v.count.at(corner_col, corner_row) = about;
  const std::vector<CellThresholds> thresholds(16, CellThresholds{10, 5, 4});
  EXPECT_EQ(score_ref(thresholds, 70, v), Status::ok);
  return v.type.at(1, 1);
}

TEST(Score, AFewPointsNeedOthersBesideThem) {
  EXPECT_EQ(weak_type(40, 0, 0, 0), kCellObstacle);
  EXPECT_EQ(weak_type(40, 2, 2, 9), kCellObstacle);
  EXPECT_EQ(weak_type(39, 2, 2, 0), kCellUnknown);
  EXPECT_EQ(weak_type(39, 2, 2, 5), kCellUnoccupied);
  EXPECT_EQ(weak_type(500, 3, 1, 0), kCellUnknown);  // two cells away
}

TEST(Score, TooFewPointsAreNotAnObstacle) {
  EXPECT_EQ(type_of({9, 9000, 0, 0}), kCellUnknown);
  EXPECT_EQ(type_of({9, 9000, 5, 0}), kCellUnoccupied);
}

TEST(Score, LowPointsAreUnoccupied) {
  EXPECT_EQ(type_of({10, 700, 0, 0}), kCellUnoccupied);  // mean exactly h_min
  EXPECT_EQ(type_of({10, -300, 0, 0}), kCellUnoccupied);
}

TEST(Score, FloorEvidenceMakesUnoccupied) {
  EXPECT_EQ(type_of({0, 0, 5, 0}), kCellUnoccupied);
  EXPECT_EQ(type_of({0, 0, 4, 0}), kCellUnknown);
  EXPECT_EQ(type_of({0, 0, 0, 0}), kCellUnknown);
}

TEST(Score, LowPointsOnMuchFloorAreNotAnObstacle) {
  EXPECT_EQ(weak_type(40, 0, 0, 11), kCellUnoccupied);  // mean 70.1 mm, fewer points than floor
  EXPECT_EQ(weak_type(40, 0, 0, 10), kCellObstacle);
  EXPECT_EQ(type_of({50, 3501, 51, 0}), kCellObstacle);  // many enough to be sure
}

TEST(Score, ADropOffIsAnObstacleWhereItOutweighsTheFloor) {
  EXPECT_EQ(type_of({0, 0, 11, 12}), kCellObstacle);
  EXPECT_EQ(type_of({10, 100, 3, 12}), kCellObstacle);
  EXPECT_EQ(type_of({10, 701, 3, 12}), kCellObstacle);  // however few points stand there
  EXPECT_EQ(type_of({90, 900, 3, 12}), kCellObstacle);  // or many, but low
  EXPECT_EQ(type_of({0, 0, 2, 3}), kCellUnknown);
  EXPECT_EQ(type_of({0, 0, 50, 50}), kCellUnoccupied);
  EXPECT_EQ(type_of({0, 0, 50, 51}), kCellObstacle);
}

// Two cells side by side, as above.
int drop_type(const Counts& c, const Counts& beside) {
  TestGrid g(1, 2);
  const NavGrid v = g.view();
  for (int i = 0; i < 2; ++i) {
    v.floor_count.at(i, 0) = i == 0 ? c.floor : beside.floor;
    v.below_count.at(i, 0) = i == 0 ? c.below : beside.below;
  }
  const std::vector<CellThresholds> thresholds(2, CellThresholds{10, 5, 4});
  EXPECT_EQ(score_ref(thresholds, 70, v), Status::ok);
  return v.type.at(0, 0);
}

TEST(Score, ASmallDropOffNeedsOthersBesideIt) {
  EXPECT_EQ(drop_type({0, 0, 0, 4}, {0, 0, 0, 8}), kCellObstacle);
  EXPECT_EQ(drop_type({0, 0, 0, 4}, {0, 0, 0, 7}), kCellUnknown);
  EXPECT_EQ(drop_type({0, 0, 5, 12}, {0, 0, 6, 0}), kCellObstacle);
  EXPECT_EQ(drop_type({0, 0, 5, 12}, {0, 0, 7, 0}), kCellUnoccupied);  // more floor than that about it
}

// A wall 5 m away, smeared over 1.5 m of depth: 0.27 m is the error of its depth there, and things before and behind the densest row are
// none. A pole before it is one, however few its points.
TEST(Score, OfAStreakOnlyTheDenseCellsAreObstacles) {
  TestGrid g(60, 40);
  const NavGrid v = g.view();
  std::vector<CellThresholds> thresholds(60 * 40, CellThresholds{.points = 4, .per_row = 64, .streak = 5});
  for (int row = 35; row < 60; ++row) {
    for (int col = 10; col < 30; ++col) {
      const int off = row - 50;
      const auto n = static_cast<std::uint32_t>(200 * std::exp(-off * off / (2 * 2.7 * 2.7)));
      v.count.at(col, row) = n;
      v.height_sum.at(col, row) = std::int64_t{500} * n;
    }
  }
  v.count.at(20, 30) = 20;
  v.height_sum.at(20, 30) = 20 * 500;
  EXPECT_EQ(score_ref(thresholds, 70, v), Status::ok);
  EXPECT_EQ(v.type.at(20, 50), kCellObstacle);
  EXPECT_EQ(v.type.at(20, 48), kCellObstacle);  // 0.76 of the densest
  EXPECT_EQ(v.type.at(20, 45), kCellUnknown);   // 0.18 of it
  EXPECT_EQ(v.type.at(20, 55), kCellUnknown);
  EXPECT_EQ(v.type.at(20, 30), kCellObstacle);
  // Seen along the rows there is no streak.
  thresholds.assign(60 * 40, CellThresholds{.points = 4, .per_col = 64, .streak = 5});
  EXPECT_EQ(score_ref(thresholds, 70, v), Status::ok);
  EXPECT_EQ(v.type.at(20, 45), kCellObstacle);
}

ScoreGeometry level_camera() {
  ScoreGeometry g;
  g.focal_px = 400;
  g.baseline_m = 0.1;
  g.height_m = 0.5;
  g.disparity_sigma_px = 0.25;
  g.max_disparity_px = 80;  // nothing nearer than 0.5 m
  g.min_count = 4;
  g.density = 0.2;
  g.reference_height_m = 0.15;
  g.floor_density = 0.1;
  return g;
}

CellThresholds threshold(const ScoreGeometry& g, int row, int col) {
  const GridGeometry grid;
  std::vector<CellThresholds> table(std::size_t{200} * 200);
  EXPECT_EQ(build_score_table(grid, g, table), Status::ok);
  return table[static_cast<std::size_t>(row) * 200 + static_cast<std::size_t>(col)];
}

TEST(ScoreTable, TheLineOfSightLeadsAwayFromTheCamera) {
  // 4.95 m ahead: sigma_z = 0.153 m, 2 sigma_z = 3.06 cells.
  const CellThresholds ahead = threshold(level_camera(), 49, 99);
  EXPECT_EQ(ahead.per_row, 64);
  EXPECT_EQ(ahead.per_col, -1);
  EXPECT_EQ(ahead.streak, 3);
  // 4.95 m ahead and to the left, 7.0 m away: columns grow to the right.
  const CellThresholds aside = threshold(level_camera(), 49, 50);
  EXPECT_EQ(aside.per_row, 45);
  EXPECT_EQ(aside.per_col, -45);
  EXPECT_EQ(aside.streak, 6);
  EXPECT_EQ(threshold(level_camera(), 199, 99).streak, kLongestStreak);
}

TEST(ScoreTable, FollowsTheFormula) {
  // Row 19: z = 1.95 m; sigma_z = 0.02377 m, cell / (2.5 sigma_z) = 1.68 -> 1.
  // points: 0.2 * 160000 * 0.1 * 0.15 / 3.8025 = 126.2; floor: 0.1 * 160000 * 0.01 * 0.5 / 7.4149 = 10.79.
  const CellThresholds near = threshold(level_camera(), 19, 100);
  EXPECT_EQ(near.points, 127U);
  EXPECT_EQ(near.floor, 11U);
  EXPECT_EQ(near.below, 11U);
  // Row 59: z = 5.95 m; sigma_z = 0.2213, factor 0.1808; points 13.56 * 0.1808 = 2.45 -> n_abs; floor 0.38 -> 1.
  const CellThresholds far = threshold(level_camera(), 59, 100);
  EXPECT_EQ(far.points, 4U);
  EXPECT_EQ(far.floor, 1U);
  EXPECT_EQ(far.below, 8U);
}

TEST(ScoreTable, NothingIsExpectedNearerThanTheCameraSees) {
  const ScoreGeometry g = level_camera();
  EXPECT_EQ(threshold(g, 0, 100).points, threshold(g, 4, 100).points);
  EXPECT_GT(threshold(g, 4, 100).points, threshold(g, 6, 100).points);
}

TEST(ScoreTable, FallsWithDistanceAndIsTheSameAcrossALevelRow) {
  const ScoreGeometry g = level_camera();
  for (int row = 5; row < 199; row += 7) {
    ASSERT_GE(threshold(g, row, 30).points, threshold(g, row + 1, 30).points);
    ASSERT_EQ(threshold(g, row, 0).points, threshold(g, row, 199).points);
  }
}

TEST(ScoreTable, RefusesWrongArguments) {
  std::vector<CellThresholds> table(10);
  EXPECT_EQ(build_score_table({}, level_camera(), table), Status::size_mismatch);
  table.resize(std::size_t{200} * 200);
  ScoreGeometry g = level_camera();
  g.min_count = 0;
  EXPECT_EQ(build_score_table({}, g, table), Status::bad_argument);
  TestGrid grid(10, 10);
  EXPECT_EQ(score_ref(table, 70, grid.view()), Status::size_mismatch);
  table.resize(100);
  EXPECT_EQ(score_ref(table, -1, grid.view()), Status::bad_argument);
}

TEST(ScoreSimd, EqualsTheReference) {
  std::mt19937 random(9);
  test::for_each_isa([&](const char* isa) {
    int seen[3] = {};
    for (const int half_cols : test::awkward_widths()) {
      const int rows = 5;
      const int cols = 2 * std::max(half_cols, 1);
      TestGrid expected(rows, cols);
      const NavGrid grid = expected.view();
      std::vector<CellThresholds> thresholds(static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols));
      const bool large = half_cols % 2 == 0;  // counts that are negative as signed numbers
      const auto count = [&] { return static_cast<std::uint32_t>(large ? random() : random() % 12); };
      for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < cols; ++c) {
          grid.count.at(c, r) = count();
          grid.floor_count.at(c, r) = count();
          grid.below_count.at(c, r) = count();
          // On, beside and far from the mean height of 70 mm.
          grid.height_sum.at(c, r) = 70LL * grid.count.at(c, r) + static_cast<std::int64_t>(random() % 3) - 1;
          if (random() % 4 == 0) grid.height_sum.at(c, r) = static_cast<std::int32_t>(random()) * 4096LL;
        }
      }
      for (CellThresholds& t : thresholds)
        t = {count(), count(), count()};
      TestGrid found = expected;
      ASSERT_EQ(score_ref(thresholds, 70, expected.view()), Status::ok);
      ASSERT_EQ(score_simd(thresholds, 70, found.view()), Status::ok);
      ASSERT_TRUE(found == expected) << isa << " " << cols << " columns";
      for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < cols; ++c)
          ++seen[found.view().type.at(c, r)];
      }
    }
    for (const int n : seen)
      EXPECT_GT(n, 100);
  });
}

TEST(ScoreSimd, RefusesWhatTheReferenceRefuses) {
  TestGrid g(4, 4);
  const std::vector<CellThresholds> thresholds(16);
  EXPECT_EQ(score_simd(std::span(thresholds).first(15), 70, g.view()), Status::size_mismatch);
  EXPECT_EQ(score_simd(thresholds, -1, g.view()), Status::bad_argument);
}

}  // namespace
}  // namespace lakshya

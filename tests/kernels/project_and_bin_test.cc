// Pruning and binning together: the properties that hold for the pair of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "kernels/grid_bin/grid_bin.h"
#include "kernels/prune/prune.h"
#include "tests/support/test_grid.h"
#include "tests/support/test_image.h"

namespace lakshya {
namespace {

using test::PaddedImage;
using test::TestGrid;

constexpr int kWidth = 160;
constexpr int kHeight = 120;

class ProjectAndBin : public ::testing::TestWithParam<int> {
 protected:
  ProjectAndBin() : depth_(prune_table_entries(64)), height_(prune_table_entries(64)), disparity_(kWidth, kHeight) {
    std::mt19937 random(static_cast<unsigned>(GetParam()));
    const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    PruneGeometry g;
    g.focal_px = 110;
    g.baseline_m = 0.3;
    g.center_u = 79.5;
    g.center_v = 59.5;
    g.height_m = between(0.4, 1.5);
    g.pitch = between(-0.1, 0.3);
    g.roll = between(-0.1, 0.1);
    g.yaw = between(-0.3, 0.3);
    EXPECT_EQ(build_prune_model(g, depth_, height_, model_), Status::ok);
    test::fill_random(disparity_.view(), random, -6, 700);
  }

  // Rows pruned one after another, as the pipeline does it.
  void prune_then_bin(TestGrid& grid, const std::vector<int>& row_order) const {
    std::vector<ObstaclePoint> obstacles(kWidth);
    std::vector<GroundStrip> floor(kWidth);
    std::vector<GroundStrip> below(kWidth);
    PrunedRow row{.obstacles = obstacles, .floor = floor, .below = below};
    PixelCounts counts;
    for (const int v : row_order) {
      ASSERT_EQ(reproject_prune_row_ref(model_, v, {disparity_.view().row(v), kWidth}, row, counts, {}),
                Status::ok);
      ASSERT_EQ(bin_obstacles_ref(row.obstacles.first(row.obstacle_count), grid.view()), Status::ok);
      ASSERT_EQ(bin_ground_ref(row.floor.first(row.floor_count), grid.view(), grid.view().floor_count), Status::ok);
      ASSERT_EQ(bin_ground_ref(row.below.first(row.below_count), grid.view(), grid.view().below_count), Status::ok);
    }
  }

  std::vector<std::int32_t> depth_;
  std::vector<std::int32_t> height_;
  PruneModel model_;
  PaddedImage<std::int16_t> disparity_;
};

std::vector<int> all_rows() {
  std::vector<int> rows(kHeight);
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

// The other way round: every pixel with depth goes into its cell first, whatever it is; each cell then throws out
// what is no obstacle.
TEST_P(ProjectAndBin, PruningThenBinningEqualsBinningThenPruning) {
  TestGrid grid(200, 200);
  prune_then_bin(grid, all_rows());

  struct Pixel {
    int u, v;
    std::int16_t disparity;
  };
  std::map<std::pair<int, int>, std::vector<Pixel>> cells;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const std::int16_t d = disparity_.view().at(u, v);
      if (d <= 0) continue;
      const ObstaclePoint p = reproject_pixel(model_, u, v, d);
      const int row = p.forward_mm < 0 ? 0 : p.forward_mm / 100;
      const int right_of_edge = 10000 - p.left_mm;
      if (right_of_edge < 0) continue;
      cells[{row, right_of_edge / 100}].push_back({u, v, d});
    }
  }
  TestGrid other(200, 200);
  for (const auto& [cell, pixels] : cells) {
    if (cell.first >= 200 || cell.second >= 200) continue;
    for (const Pixel& p : pixels) {
      if (classify_pixel(model_, p.u, p.v, p.disparity) != PixelClass::obstacle) continue;
      ++other.view().count.at(cell.second, cell.first);
      other.view().height_sum.at(cell.second, cell.first) +=
          reproject_pixel(model_, p.u, p.v, p.disparity).height_mm;
    }
  }
  EXPECT_GT(TestGrid::total(grid.view().count), 500U);
  for (int r = 0; r < 200; ++r) {
    for (int c = 0; c < 200; ++c) {
      ASSERT_EQ(grid.view().count.at(c, r), other.view().count.at(c, r)) << r << "," << c;
      ASSERT_EQ(grid.view().height_sum.at(c, r), other.view().height_sum.at(c, r)) << r << "," << c;
    }
  }
}

TEST_P(ProjectAndBin, TheMapDoesNotDependOnTheOrderOfRows) {
  TestGrid forwards(200, 200);
  prune_then_bin(forwards, all_rows());
  std::vector<int> rows = all_rows();
  std::shuffle(rows.begin(), rows.end(), std::mt19937(31));
  TestGrid shuffled(200, 200);
  prune_then_bin(shuffled, rows);
  EXPECT_TRUE(forwards == shuffled);
}

INSTANTIATE_TEST_SUITE_P(RandomPoses, ProjectAndBin, ::testing::Range(1, 21));

}  // namespace
}  // namespace lakshya

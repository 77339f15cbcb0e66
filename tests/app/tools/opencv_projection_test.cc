// The yardstick must do the same work as the kernels that are measured with it: their maps agree but for what float
// and whole millimetres round differently.
#include "app/tools/opencv_projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "app/core/geometry.h"
#include "app/core/image.h"
#include "app/core/pipeline.h"
#include "app/tools/stereo_input.h"
#include "hal/clock/monotonic_clock.h"
#include "kernels/grid_bin/grid_bin.h"
#include "tests/support/data_path.h"
#include "tests/support/test_grid.h"
#include "tests/support/test_prune_model.h"

namespace lakshya {
namespace {

using test::TestGrid;

void bin_with_kernels(const PruneModel& model, ImageView<const std::int16_t> disparity, const NavGrid& grid) {
  const auto width = static_cast<std::size_t>(disparity.width);
  std::vector<ObstaclePoint> obstacles(width);
  std::vector<GroundStrip> floor(width);
  std::vector<GroundStrip> below(width);
  PrunedRow row{.obstacles = obstacles, .floor = floor, .below = below};
  PixelCounts counts;
  for (int v = 0; v < disparity.height; ++v) {
    ASSERT_EQ(reproject_prune_row_ref(model, v, {disparity.row(v), width}, row, counts, {}), Status::ok);
    ASSERT_EQ(bin_obstacles_ref(row.obstacles.first(row.obstacle_count), grid), Status::ok);
    ASSERT_EQ(bin_ground_ref(row.floor.first(row.floor_count), grid, grid.floor_count), Status::ok);
    ASSERT_EQ(bin_ground_ref(row.below.first(row.below_count), grid, grid.below_count), Status::ok);
  }
}

// Sum of |difference| of the counts, in percent of their sum.
double difference_percent(const ImageView<std::uint32_t>& a, const ImageView<std::uint32_t>& b) {
  std::int64_t different = 0;
  for (int r = 0; r < a.height; ++r) {
    for (int c = 0; c < a.width; ++c)
      different += std::abs(std::int64_t{a.at(c, r)} - std::int64_t{b.at(c, r)});
  }
  return 100.0 * static_cast<double>(different) /
         static_cast<double>(std::max<std::uint64_t>(TestGrid::total(a), 1));
}

// Both maps of one disparity image; returns how many cells have another type, in percent.
double compare_maps(const VehicleConfig& config, const RectifiedGeometry& camera, const PruneModel& model,
                    ImageView<const std::int16_t> disparity) {
  const GridGeometry g = grid_geometry(config.grid);
  TestGrid ours(g.rows, g.cols, g.cell_mm);
  TestGrid theirs(g.rows, g.cols, g.cell_mm);
  bin_with_kernels(model, disparity, ours.view());
  OpencvProjection projection = make_opencv_projection(prune_geometry(config, camera));
  project_and_bin_opencv(disparity, projection, model, theirs.view());

  EXPECT_GT(TestGrid::total(ours.view().count), 1000U);
  EXPECT_GT(TestGrid::total(ours.view().floor_count), 1000U);
  // A millimetre or a 65536th of a pixel decides only for the points next to a bound or to a cell's side.
  EXPECT_LT(difference_percent(ours.view().count, theirs.view().count), 2.0);
  // Ours rounds the disparities of a footprint's ends to the depth table's 1/16 px, far away that is a cell or more.
  EXPECT_LT(difference_percent(ours.view().floor_count, theirs.view().floor_count), 10.0);
  std::vector<CellThresholds> thresholds(static_cast<std::size_t>(g.rows) * static_cast<std::size_t>(g.cols));
  EXPECT_EQ(build_score_table(g, score_geometry(config, camera), thresholds), Status::ok);
  EXPECT_EQ(score_ref(thresholds, 70, ours.view()), Status::ok);
  EXPECT_EQ(score_ref(thresholds, 70, theirs.view()), Status::ok);
  int different = 0;
  for (int r = 0; r < g.rows; ++r) {
    for (int c = 0; c < g.cols; ++c)
      different += ours.view().type.at(c, r) != theirs.view().type.at(c, r) ? 1 : 0;
  }
  return 100.0 * different / (g.rows * g.cols);
}

RectifiedGeometry made_up_camera() {
  RectifiedGeometry c;
  c.width = 320;
  c.height = 240;
  c.focal_px = 210.3;
  c.baseline_m = 0.24;
  c.cx_left = c.cx_right = 161.7;
  c.cy = 118.2;
  return c;
}

TEST(OpencvProjection, AgreesWithTheKernelsOnAMadeUpScene) {
  VehicleConfig config;
  config.camera = {.height_m = 0.7, .pitch_deg = 6, .roll_deg = 3, .yaw_deg = -8, .forward_m = 0.2, .left_m = 0.1};
  const RectifiedGeometry camera = made_up_camera();
  const test::TestPruneModel mount(prune_geometry(config, camera));
  for (const int offset16 : {0, 9, -12}) {
    const PruneModel model = shift_floor(mount.prune, std::int64_t{offset16} << kDisparityToQ16);
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0, 6);
    Image<std::int16_t> disparity(camera.width, camera.height, std::int16_t{kNotUnique});
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const auto floor = static_cast<double>(model.floor.at(u, v) >> kDisparityToQ16);
        const double wall = 90 + (u / 40) * 30;  // 1/16 px, in steps
        const bool pit = u > 100 && u < 140 && v > 170 && v < 190;
        if (random() % 5 == 0) continue;
        disparity.view().at(u, v) =
            static_cast<std::int16_t>(std::max(pit ? floor / 2 : std::max(floor + noise(random), wall), 0.0));
      }
    }
    EXPECT_LT(compare_maps(config, camera, model, disparity.view()), 1.0) << offset16;
  }
}

TEST(OpencvProjection, AgreesWithTheKernelsOnARecordedPair) {
  const std::string sequence = test::data_path("kitti_odometry_06");
  if (sequence.empty()) GTEST_SKIP() << "LAKSHYA_DATA has no kitti_odometry_06";
  StereoInputOptions options;
  options.sequence = sequence;
  options.frame = 10;
  const StereoInput input = read_stereo_input(options, 1.0);
  VehicleConfig config;
  config.camera.height_m = 1.65;
  config.matcher.disparities = 128;
  const MonotonicClock clock;
  Pipeline pipeline(config, input.calibration, input.left.width(), input.left.height(), kSimdKernels, clock);
  FrameResult frame;
  ASSERT_EQ(pipeline.process(input.left.view(), input.right.view(), {}, frame), Status::ok);
  EXPECT_LT(compare_maps(config, pipeline.camera(), pipeline.prune_model(), frame.disparity), 1.0);
}

}  // namespace
}  // namespace lakshya

#include "app/tools/compare_setup.h"

#include <cmath>

#include "app/core/geometry.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

// Pipeline's constructor has accepted the same.
void require(Status status, const char* what) {
  if (status != Status::ok) throw InputError(what, std::string("cannot be set up: ") + to_string(status));
}

}  // namespace

CompareSetup::CompareSetup(const VehicleConfig& vehicle, const StereoCalibration& stereo,
                           ImageView<const std::uint8_t> left_raw, ImageView<const std::uint8_t> right_raw)
    : config(vehicle),
      calibration(stereo),
      left(left_raw),
      right(right_raw),
      width(left.width),
      height(left.height),
      camera(rectified_geometry(stereo, width, height)),
      remap(needs_remap(stereo)),
      min_height_mm(static_cast<std::int32_t>(std::lround(vehicle.score.min_height_m * 1000))) {
  const Pipeline pipeline(config, calibration, width, height, kReferenceKernels, clock);  // refuses what it refuses
  if (remap) {
    const Rectification r =
        calibration.rectification ? *calibration.rectification : rectify_stereo(calibration, width, height);
    maps_left = make_rectify_maps(calibration.left, r.R1, r.P1, width, height);
    maps_right = make_rectify_maps(calibration.right, r.R2, r.P2, width, height);
  }
  const GridGeometry grid = grid_geometry(config.grid);
  depth_table.resize(prune_table_entries(max_disparity_px(config.matcher)));
  height_table.resize(depth_table.size());
  thresholds.resize(static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.cols));
  polar_table.resize(polar_table_entries(grid));
  require(build_prune_model(prune_geometry(config, camera), depth_table, height_table, mount), "prune");
  require(build_score_table(grid, score_geometry(config, camera), thresholds), "score");
  PlannerParams params = config.planner;
  params.blind_zone_m = pipeline.blind_zone();
  require(planner.configure(params, config.vehicle, grid, polar_table), "planner");
}

MatcherConfig CompareSetup::matcher(const char* name) const {
  MatcherConfig c = config.matcher;
  c.name = name;
  return c;
}

}  // namespace lakshya

#include "app/core/geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/nav/route.h"

namespace lakshya {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// What a degree of pitch does to the floor's disparity: f B / H.
double pixels16_per_degree(const VehicleConfig& config, const RectifiedGeometry& camera) {
  return kDisparityScale * kDegree * camera.focal_px * camera.baseline_m / config.camera.height_m;
}

}  // namespace

double max_disparity_px(const MatcherConfig& matcher) {
  return matcher.min_disparity + matcher.disparities;
}

GridGeometry grid_geometry(const GridConfig& grid) {
  return {grid.rows, grid.cols, static_cast<std::int32_t>(std::lround(grid.cell_m * 1000))};
}

RollingMapParams rolling_map_params(const VehicleConfig& config, const RectifiedGeometry& camera) {
  const double above = std::atan((camera.cy - DepthView::kUnmatchedRows) / camera.focal_px);
  RollingMapParams p;
  p.size_m = config.map.size_m;
  p.keep_s = config.map.keep_s;
  p.blind_m = blind_zone_m(config, camera);
  p.near_m = config.map.near_m;
  p.far_hits = config.map.far_hits;
  p.latency_s = config.vehicle.latency_s;
  p.deceleration_mps2 = config.vehicle.deceleration_mps2;
  p.radius_m = config.vehicle.radius_m;
  p.trim = config.planner.name == "route";
  p.camera = {.height_m = config.camera.height_m,
              .forward_m = config.camera.forward_m,
              .left_m = config.camera.left_m,
              .yaw = config.camera.yaw_deg * kDegree,
              .angle = std::clamp(above - config.camera.pitch_deg * kDegree, -1.5, 1.5)};
  p.view = std::min(std::atan(camera.width / (2 * camera.focal_px)), 1.5);
  p.row_m = 1 / (camera.focal_px * config.camera.height_m);
  p.sight = {.focal_px = camera.focal_px,
             .baseline_m = camera.baseline_m,
             .center_u = camera.cx_left,
             .center_v = camera.cy,
             .height_m = config.camera.height_m,
             .pitch = config.camera.pitch_deg * kDegree,
             .roll = config.camera.roll_deg * kDegree,
             .yaw = p.camera.yaw,
             .forward_m = config.camera.forward_m,
             .left_m = config.camera.left_m,
             .depth_sigma = config.prune.disparity_sigma_px / (camera.focal_px * camera.baseline_m)};
  return p;
}

SlopeParams slope_params(const VehicleConfig& config) {
  return {.steepest_percent = static_cast<int>(std::lround(100 * std::tan(config.prune.slope_deg * kDegree))),
          .tolerance_mm = static_cast<int>(std::lround(1000 * config.prune.floor_tolerance_m))};
}

RouteParams route_params(const VehicleConfig& config, const RectifiedGeometry& camera) {
  RouteParams p;
  p.radius_m = config.vehicle.radius_m;
  p.margin_m = config.planner.route_margin_m;
  p.comfort_m = config.planner.route_comfort_m;
  p.reach_m = config.planner.route_reach_m;
  p.first_look = config.planner.route_first_look_deg * kDegree;
  p.blind_m = blind_zone_m(config, camera);
  p.view = std::atan(camera.width / (2 * camera.focal_px));
  return p;
}

PruneGeometry prune_geometry(const VehicleConfig& config, const RectifiedGeometry& camera) {
  PruneGeometry g;
  g.focal_px = camera.focal_px;
  g.baseline_m = camera.baseline_m;
  g.center_u = camera.cx_left;
  g.center_v = camera.cy;
  g.height_m = config.camera.height_m;
  g.pitch = config.camera.pitch_deg * kDegree;
  g.roll = config.camera.roll_deg * kDegree;
  g.yaw = config.camera.yaw_deg * kDegree;
  g.forward_m = config.camera.forward_m;
  g.left_m = config.camera.left_m;
  g.max_depth_m = config.prune.max_depth_m;
  g.clearance_m = config.prune.clearance_m;
  g.floor_tolerance_m = config.prune.floor_tolerance_m;
  g.disparity_sigma_px = config.prune.disparity_sigma_px;
  g.pitch_sigma = config.prune.pitch_sigma_deg * kDegree;
  g.sigma_factor = config.prune.sigma_factor;
  g.max_disparity_px = max_disparity_px(config.matcher);
  return g;
}

ScoreGeometry score_geometry(const VehicleConfig& config, const RectifiedGeometry& camera) {
  ScoreGeometry g;
  g.focal_px = camera.focal_px;
  g.baseline_m = camera.baseline_m;
  g.height_m = config.camera.height_m;
  g.pitch = config.camera.pitch_deg * kDegree;
  g.yaw = config.camera.yaw_deg * kDegree;
  g.forward_m = config.camera.forward_m;
  g.left_m = config.camera.left_m;
  g.disparity_sigma_px = config.prune.disparity_sigma_px;
  g.max_disparity_px = max_disparity_px(config.matcher);
  g.min_count = config.score.min_count;
  g.density = config.score.density;
  g.reference_height_m = config.score.reference_height_m;
  g.floor_density = config.score.floor_density;
  return g;
}

std::int32_t disparity_of_pitch16(const VehicleConfig& config, const RectifiedGeometry& camera, double pitch_deg) {
  const double per_degree16 = pixels16_per_degree(config, camera);
  return static_cast<std::int32_t>(std::min(std::ceil(pitch_deg * per_degree16), double{kGroundReach}));
}

double pitch_deg_of_disparity16(const VehicleConfig& config, const RectifiedGeometry& camera,
                                std::int32_t offset16) {
  return offset16 / pixels16_per_degree(config, camera);
}

double blind_zone_m(const VehicleConfig& config, const RectifiedGeometry& camera) {
  const double down =
      config.camera.pitch_deg * kDegree + std::atan((camera.height - 1 - camera.cy) / camera.focal_px);
  const double sideways = std::atan(0.5 * camera.width / camera.focal_px);
  const double floor = down > 0 ? config.camera.height_m / std::tan(down) : HUGE_VAL;
  const double seen = floor / std::cos(sideways) + config.camera.forward_m + 2 * config.grid.cell_m;
  // A camera that does not show the floor within its range must not make unknown cells passable all the way.
  if (seen > config.prune.max_depth_m) return config.planner.blind_zone_m;
  return std::max(config.planner.blind_zone_m, seen);
}

}  // namespace lakshya

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernels/base/integer.h"
#include "kernels/prune/prune.h"

namespace lakshya {
namespace {

constexpr double kQ16 = 65536.0;
constexpr double kQ32 = 4294967296.0;
constexpr double kLargest = std::numeric_limits<std::int32_t>::max();

Affine affine(double per_u, double per_v, double constant, double scale) {
  return {round_half_up(per_u * scale), round_half_up(per_v * scale), round_half_up(constant * scale)};
}

// d = scale * d_f + offset, in Q16 px.
Affine floor_bound(const PruneGeometry& g, double scale, double offset) {
  const double n_x = std::cos(g.pitch) * std::sin(g.roll);
  const double n_y = std::cos(g.pitch) * std::cos(g.roll);
  const double n_z = std::sin(g.pitch);
  const double k = scale * g.baseline_m / g.height_m;
  return affine(k * n_x, k * n_y, k * (n_z * g.focal_px - n_x * g.center_u - n_y * g.center_v) + offset, kQ16);
}

void set_ceiling(const PruneGeometry& g, PruneModel& model) {
  const double above = g.clearance_m - g.height_m;
  if (std::abs(above) < 0.0005) {
    model.ceiling_test = CeilingTest::at_camera;
  } else {
    model.ceiling_test = above > 0 ? CeilingTest::above_camera : CeilingTest::below_camera;
    model.ceiling = floor_bound(g, -g.height_m / above, 0.0);
    model.ceiling_scale = round_half_up(-g.height_m / above * kQ16);
  }
}

// Body coordinates per unit of depth: the camera's axes turned by roll, pitch and the mount's yaw.
void set_directions(const PruneGeometry& g, PruneModel& model) {
  const double sin_p = std::sin(g.pitch);
  const double cos_p = std::cos(g.pitch);
  const double sin_r = std::sin(g.roll);
  const double cos_r = std::cos(g.roll);
  // Each direction as coefficients of (X/Z, Y/Z, 1).
  const double ahead[3] = {-sin_p * sin_r, -sin_p * cos_r, cos_p};
  const double side[3] = {-cos_r, sin_r, 0.0};
  const auto turned = [&](double of_ahead, double of_side) {
    double c[3];
    for (int i = 0; i < 3; ++i)
      c[i] = of_ahead * ahead[i] + of_side * side[i];
    const double per_u = c[0] / g.focal_px;
    const double per_v = c[1] / g.focal_px;
    return affine(per_u, per_v, c[2] - per_u * g.center_u - per_v * g.center_v, kQ32);
  };
  model.forward = turned(std::cos(g.yaw), -std::sin(g.yaw));
  model.left = turned(std::sin(g.yaw), std::cos(g.yaw));
}

bool geometry_ok(const PruneGeometry& g) {
  constexpr double kSteepest = 80.0 * std::numbers::pi / 180.0;
  return g.focal_px > 0 && g.baseline_m > 0 && g.height_m > 0 && g.max_depth_m > 0 && g.clearance_m > 0 &&
         g.floor_tolerance_m >= 0 && g.height_m - g.floor_tolerance_m >= 0.001 && g.max_disparity_px > 0 &&
         g.max_disparity_px < 2048 && std::abs(g.pitch) < kSteepest && std::abs(g.roll) < kSteepest;
}

}  // namespace

std::size_t prune_table_entries(double max_disparity_px) {
  return static_cast<std::size_t>(std::ceil(max_disparity_px * kDisparityScale)) + 1;
}

Status build_prune_model(const PruneGeometry& g, std::span<std::int32_t> depth_table,
                         std::span<std::int32_t> height_table, PruneModel& model) {
  if (!geometry_ok(g)) return Status::bad_argument;
  const std::size_t entries = prune_table_entries(g.max_disparity_px);
  if (depth_table.size() < entries || height_table.size() < entries) return Status::scratch_too_small;

  const double focal_times_baseline = g.focal_px * g.baseline_m;
  const double sigma = std::hypot(g.disparity_sigma_px, focal_times_baseline * g.pitch_sigma / g.height_m);
  const double margin = g.sigma_factor * sigma;
  model.min_disparity = round_half_up(focal_times_baseline / g.max_depth_m * kQ16);
  model.max_floor_disparity = round_half_up(g.max_disparity_px * kQ16);
  model.floor = floor_bound(g, 1.0, 0.0);
  model.drop_relative = floor_bound(g, g.height_m / (g.height_m + g.floor_tolerance_m), 0.0);
  model.drop_absolute = floor_bound(g, 1.0, -margin);
  model.floor_relative = floor_bound(g, g.height_m / (g.height_m - g.floor_tolerance_m), 0.0);
  model.floor_absolute = floor_bound(g, 1.0, margin);
  model.drop_scale = round_half_up(g.height_m / (g.height_m + g.floor_tolerance_m) * kQ16);
  model.floor_scale = round_half_up(g.height_m / (g.height_m - g.floor_tolerance_m) * kQ16);
  set_ceiling(g, model);
  set_directions(g, model);
  model.forward_mm = static_cast<std::int32_t>(round_half_up(g.forward_m * 1000));
  model.left_mm = static_cast<std::int32_t>(round_half_up(g.left_m * 1000));
  model.height_mm = static_cast<std::int32_t>(round_half_up(g.height_m * 1000));

  depth_table[0] = 0;
  height_table[0] = 0;
  for (std::size_t d16 = 1; d16 < entries; ++d16) {
    const double disparity = static_cast<double>(d16) / kDisparityScale;
    const double depth = std::min(focal_times_baseline * 1000 / disparity, kLargest);
    depth_table[d16] = static_cast<std::int32_t>(std::floor(depth + 0.5));
    height_table[d16] =
        static_cast<std::int32_t>(round_half_up(g.height_m * 1000 / (disparity * kQ16) * (1 << 28)));
  }
  model.depth_mm = depth_table.first(entries);
  model.height_scale = height_table.first(entries);
  return Status::ok;
}

PruneModel shift_floor(const PruneModel& mount, std::int64_t offset) {
  const auto scaled = [offset](std::int64_t scale) { return (offset * scale + (1 << 15)) >> 16; };
  PruneModel m = mount;
  m.floor.constant += offset;
  m.drop_relative.constant += scaled(mount.drop_scale);
  m.drop_absolute.constant += offset;
  m.floor_relative.constant += scaled(mount.floor_scale);
  m.floor_absolute.constant += offset;
  m.ceiling.constant += scaled(mount.ceiling_scale);
  return m;
}

PruneModel widen_floor(const PruneModel& model, std::int64_t by) {
  PruneModel m = model;
  m.drop_absolute.constant -= by;
  m.floor_absolute.constant += by;
  return m;
}

}  // namespace lakshya

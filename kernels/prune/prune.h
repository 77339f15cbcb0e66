// Fused reproject-and-prune: one pass per image row decides from the disparity alone what a pixel is, and computes
// coordinates only for what goes into the map. docs/contract.md section 3.
//
// The floor's disparity is affine in the pixel, d_f(u,v) = (B/H) (n_x (u-c_u) + n_y (v-c_v) + n_z f), and a pixel's
// height above the floor is h = H (1 - d_f / d) (S. Kumar's eq. 4 without the division), so every test compares the
// disparity with an affine bound. In this order:
//   too far:   d < f B / z_max
//   nothing concluded (no_disparity): d_f beyond the search range, where the floor itself could not have been matched
//   drop-off:  d_f > 0, d < min(d_f H/(H+tau), d_f - k s)
//   floor:     d_f > 0, d <= max(d_f H/(H-tau), d_f + k s)
//   ceiling:   h > C
//   obstacle:  the rest
// with s = hypot(sigma_d, f B sigma_pitch / H). Bounds are Q16 px (int64 products of once-rounded coefficients).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/base/status.h"
#include "kernels/base/units.h"

namespace lakshya {

// What the model is made from. Angles in radians, lengths in metres, image quantities in pixels.
struct PruneGeometry {
  double focal_px = 0;
  double baseline_m = 0;
  double center_u = 0;
  double center_v = 0;
  double height_m = 0;   // left camera above the ground, > 0
  double pitch = 0;      // positive nose down
  double roll = 0;       // positive right side down
  double yaw = 0;        // positive to the left
  double forward_m = 0;  // left camera relative to the turning centre
  double left_m = 0;
  double max_depth_m = 20;
  double clearance_m = 1.2;          // C
  double floor_tolerance_m = 0.04;   // tau, 0 <= tau < height_m
  double disparity_sigma_px = 0.25;  // sigma_d
  double pitch_sigma = 0.0035;       // sigma_pitch
  double sigma_factor = 3;           // k
  double max_disparity_px = 64;      // largest disparity searched
};

// a(u,v) = u * per_u + v * per_v + constant
struct Affine {
  std::int64_t per_u = 0;
  std::int64_t per_v = 0;
  std::int64_t constant = 0;
  constexpr std::int64_t at(int u, int v) const { return u * per_u + v * per_v + constant; }
};

enum class CeilingTest : std::uint8_t { above_camera, at_camera, below_camera };  // C > H, C = H, C < H

// Everything rounded once, in integers; the tables belong to the caller.
struct PruneModel {
  std::int64_t min_disparity = 0;        // Q16 px: f B / z_max
  std::int64_t max_floor_disparity = 0;  // Q16 px: the largest disparity searched
  // What each scaled bound multiplies d_f with, Q16; for shift_floor.
  std::int64_t drop_scale = 0;
  std::int64_t floor_scale = 0;
  std::int64_t ceiling_scale = 0;
  Affine floor;                           // d_f, Q16 px
  Affine drop_relative, drop_absolute;    // d_f H/(H+tau), d_f - k s
  Affine floor_relative, floor_absolute;  // d_f H/(H-tau), d_f + k s
  CeilingTest ceiling_test = CeilingTest::above_camera;
  Affine ceiling;               // -d_f H/(C-H) or d_f H/(H-C), Q16 px
  Affine forward, left;         // coordinate per depth, Q32
  std::int32_t forward_mm = 0;  // mount
  std::int32_t left_mm = 0;
  std::int32_t height_mm = 0;
  std::span<const std::int32_t> depth_mm;      // depth by disparity in 1/16 px; entry 0 unused
  std::span<const std::int32_t> height_scale;  // H / d in mm per Q16 px, Q28; by disparity in 1/16 px
};

// Entries of each of the two tables for disparities up to max_disparity_px.
std::size_t prune_table_entries(double max_disparity_px);

// Rounds the geometry into a model and fills the two tables (prune_table_entries elements each), which must outlive
// it. bad_argument: a length or focal length not positive, tau not at least 1 mm below H, |pitch| or |roll| >= 80
// degrees, a disparity of 2048 px or more; scratch_too_small: a table is too short.
Status build_prune_model(const PruneGeometry& geometry, std::span<std::int32_t> depth_table,
                         std::span<std::int32_t> height_table, PruneModel& model);

// The same model with the floor's disparity larger by `offset` (Q16 px) everywhere, as a small change of pitch
// makes it (kernels/ground). Directions of reprojection stay the mount's.
PruneModel shift_floor(const PruneModel& mount, std::int64_t offset);

// The same model with `by` (Q16 px, >= 0) added to k s, on both sides of the floor: where its disparity scatters more than sigma_d says
// (kernels/ground).
PruneModel widen_floor(const PruneModel& model, std::int64_t by);

// Body frame, millimetres, origin below the turning centre.
struct ObstaclePoint {
  std::int32_t forward_mm = 0;
  std::int32_t left_mm = 0;
  std::int32_t height_mm = 0;
};

// The strip of ground that one pixel covers along its ray (one image row covers dz = z^2 / (f H)).
struct GroundStrip {
  std::int32_t near_forward_mm = 0;
  std::int32_t near_left_mm = 0;
  std::int32_t far_forward_mm = 0;
  std::int32_t far_left_mm = 0;
};

// What one row gives: arrays of the caller, each at least as long as the row.
struct PrunedRow {
  std::span<ObstaclePoint> obstacles;
  std::span<GroundStrip> floor;
  std::span<GroundStrip> below;
  std::size_t obstacle_count = 0;
  std::size_t floor_count = 0;
  std::size_t below_count = 0;
};

// Pixels by class, and those without disparity by reason (index -code - 1).
struct PixelCounts {
  std::uint32_t by_class[kPixelClasses] = {};
  std::uint32_t by_reason[kNoDisparityReasons] = {};
};

// disparity: row v of the image, 1/16 px or NoDisparity (an unknown negative code counts as kNotSearched; one beyond the
// tables as their last entry). Fills `out` from the start, adds to `counts`, and writes one PixelClass per pixel to
// `classes` unless that is empty. size_mismatch (classes), scratch_too_small (out).
Status reproject_prune_row_ref(const PruneModel& model, int v, std::span<const std::int16_t> disparity,
                               PrunedRow& out, PixelCounts& counts, std::span<PixelClass> classes);

// Class of one pixel with d16 >= 0, for tools and tests.
PixelClass classify_pixel(const PruneModel& model, int u, int v, std::int16_t disparity);
// Coordinates of one pixel with d16 > 0, for tools and tests.
ObstaclePoint reproject_pixel(const PruneModel& model, int u, int v, std::int16_t disparity);

}  // namespace lakshya

#include <algorithm>

#include "kernels/prune/prune.h"

namespace lakshya {
namespace {

std::size_t table_index(const PruneModel& m, std::int64_t d16) {
  const auto last = static_cast<std::int64_t>(m.depth_mm.size()) - 1;
  return static_cast<std::size_t>(std::clamp<std::int64_t>(d16, 1, last));
}

std::int32_t depth_at_q16(const PruneModel& m, std::int64_t disparity_q16) {
  return m.depth_mm[table_index(m, (disparity_q16 + (1 << (kDisparityToQ16 - 1))) >> kDisparityToQ16)];
}

// depth * (coordinate per depth, Q32), by way of Q16 so that the product fits 64 bits.
std::int32_t along(const Affine& direction, int u, int v, std::int64_t depth_mm) {
  const std::int64_t per_depth_q16 = (direction.at(u, v) + (1 << 15)) >> 16;
  return static_cast<std::int32_t>((depth_mm * per_depth_q16 + (1 << 15)) >> 16);
}

bool above_clearance(const PruneModel& m, int u, int v, std::int64_t d, std::int64_t floor) {
  switch (m.ceiling_test) {
    case CeilingTest::above_camera:
      return floor < 0 && d < m.ceiling.at(u, v);
    case CeilingTest::at_camera:
      return floor < 0;
    case CeilingTest::below_camera:
      return d > m.ceiling.at(u, v);
  }
  return false;
}

// Where the upper and lower edge of the pixel meet the floor plane: depths from the floor's own disparity half a
// row up and down, no farther than the map looks. A surface seen nearer than the plane hides the plane behind it.
GroundStrip ground_strip(const PruneModel& m, int u, int v, std::int16_t disparity) {
  const std::int64_t here = std::max(m.floor.at(u, v), std::int64_t{disparity} << kDisparityToQ16);
  const std::int64_t half_row = m.floor.per_v / 2;
  const std::int32_t near_mm = depth_at_q16(m, here + half_row);
  const std::int32_t far_mm = depth_at_q16(m, std::max(here - half_row, m.min_disparity));
  return {along(m.forward, u, v, near_mm) + m.forward_mm, along(m.left, u, v, near_mm) + m.left_mm,
          along(m.forward, u, v, far_mm) + m.forward_mm, along(m.left, u, v, far_mm) + m.left_mm};
}

}  // namespace

PixelClass classify_pixel(const PruneModel& m, int u, int v, std::int16_t disparity) {
  const std::int64_t d = std::int64_t{disparity} << kDisparityToQ16;
  if (d < m.min_disparity || d == 0) return PixelClass::too_far;
  const std::int64_t floor = m.floor.at(u, v);
  if (floor > m.max_floor_disparity) return PixelClass::no_disparity;
  if (floor > 0) {
    if (d < std::min(m.drop_relative.at(u, v), m.drop_absolute.at(u, v))) return PixelClass::drop_off;
    if (d <= std::max(m.floor_relative.at(u, v), m.floor_absolute.at(u, v))) return PixelClass::floor;
  }
  return above_clearance(m, u, v, d, floor) ? PixelClass::ceiling : PixelClass::obstacle;
}

ObstaclePoint reproject_pixel(const PruneModel& m, int u, int v, std::int16_t disparity) {
  const std::size_t index = table_index(m, disparity);
  const std::int64_t depth = m.depth_mm[index];
  const std::int64_t below_camera = m.floor.at(u, v) * m.height_scale[index];  // H d_f / d, Q28 mm
  return {along(m.forward, u, v, depth) + m.forward_mm, along(m.left, u, v, depth) + m.left_mm,
          m.height_mm - static_cast<std::int32_t>((below_camera + (1 << 27)) >> 28)};
}

Status reproject_prune_row_ref(const PruneModel& model, int v, std::span<const std::int16_t> disparity,
                               PrunedRow& out, PixelCounts& counts, std::span<PixelClass> classes) {
  const std::size_t width = disparity.size();
  if (!classes.empty() && classes.size() != width) return Status::size_mismatch;
  if (out.obstacles.size() < width || out.floor.size() < width || out.below.size() < width) {
    return Status::scratch_too_small;
  }
  out.obstacle_count = out.floor_count = out.below_count = 0;
  for (std::size_t i = 0; i < width; ++i) {
    const int u = static_cast<int>(i);
    const std::int16_t d = disparity[i];
    const PixelClass pixel = d < 0 ? PixelClass::no_disparity : classify_pixel(model, u, v, d);
    ++counts.by_class[static_cast<int>(pixel)];
    if (d < 0) ++counts.by_reason[d >= -kNoDisparityReasons ? -d - 1 : 0];
    if (!classes.empty()) classes[i] = pixel;
    if (pixel == PixelClass::obstacle) {
      out.obstacles[out.obstacle_count++] = reproject_pixel(model, u, v, d);
    } else if (pixel == PixelClass::floor) {
      out.floor[out.floor_count++] = ground_strip(model, u, v, d);
    } else if (pixel == PixelClass::drop_off) {
      out.below[out.below_count++] = ground_strip(model, u, v, d);
    }
  }
  return Status::ok;
}

}  // namespace lakshya

// Lengths in cells, and the frames and poses that the maps fixed to the world take: what rolling_map*.cc, motion_watch*.cc and route*.cc
// share.
#pragma once

#include <cmath>
#include <cstdint>

#include "app/nav/rolling_map.h"
#include "kernels/base/nav_grid.h"

namespace lakshya {

inline std::int64_t cell_of(double cells) {
  return static_cast<std::int64_t>(std::floor(cells));
}

// A length in cells and 2^-32 of one, so that a step along a row is one addition.
inline constexpr int kFraction = 32;
inline std::int64_t fixed(double cells) {
  return std::llround(cells * 0x1p32);
}
inline double cells_of(std::int64_t length) {
  return static_cast<double>(length) * 0x1p-32;
}

// Not beyond 10^8 cells.
inline bool is_finite(const MapPose& at, double cell_m) {
  const double far_m = 1e8 * cell_m;
  return std::isfinite(at.pose.yaw) && std::abs(at.pose.east_m) < far_m && std::abs(at.pose.north_m) < far_m;
}

// Has the planes that these maps read, of the geometry.
inline bool frame_fits(const NavGrid& frame, const GridGeometry& geometry) {
  return frame.geometry == geometry && frame.type.height == geometry.rows && frame.type.width == geometry.cols &&
         same_size(frame.count, frame.type) && same_size(frame.height_sum, frame.type);
}

}  // namespace lakshya

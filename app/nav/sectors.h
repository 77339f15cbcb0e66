// Sector and angle arithmetic of the polar histogram: docs/contract.md section 5. Angles in radians,
// counter-clockwise from straight ahead; everything is odd about straight ahead, so mirrored worlds give
// mirrored numbers.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "kernels/polar_histogram/polar_histogram.h"

namespace lakshya {

inline constexpr double kSectorAngle = 2 * std::numbers::pi / kPolarSectors;
inline constexpr int kSectorBehind = kPolarSectors / 2;

// One flag per sector.
using SectorMask = std::array<bool, kPolarSectors>;

constexpr double radians(double degrees) {
  return degrees * (std::numbers::pi / 180);
}
constexpr double degrees(double radians) {
  return radians * (180 / std::numbers::pi);
}

// The same angle in [-pi, pi].
inline double wrap_angle(double angle) {
  return std::remainder(angle, 2 * std::numbers::pi);
}

// Smallest difference between two directions, 0 to pi.
inline double angle_between(double a, double b) {
  return std::abs(wrap_angle(a - b));
}

// The same sector in 0 to kPolarSectors - 1.
constexpr int wrap_sector(int sector) {
  const int k = sector % kPolarSectors;
  return k < 0 ? k + kPolarSectors : k;
}

constexpr std::size_t sector_index(int sector) {
  return static_cast<std::size_t>(wrap_sector(sector));
}

// Direction of a sector's centre, in (-pi, pi].
constexpr double sector_centre(int sector) {
  const int k = wrap_sector(sector);
  return (k > kSectorBehind ? k - kPolarSectors : k) * kSectorAngle;
}

// The sector that holds a direction (finite); one exactly between two sectors goes to the outer one.
inline int sector_of(double direction) {
  return wrap_sector(static_cast<int>(std::lround(wrap_angle(direction) / kSectorAngle)));
}

}  // namespace lakshya

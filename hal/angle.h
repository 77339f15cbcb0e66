// Angles, rad.
#pragma once

#include <cmath>
#include <numbers>

namespace lakshya {

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// Into (-pi, pi].
inline double wrapped_angle(double rad) {
  const double near = std::remainder(rad, 2 * std::numbers::pi);
  return near <= -std::numbers::pi ? std::numbers::pi : near;
}

}  // namespace lakshya

// What every drive checks before it moves: the same words and the same limits.
#pragma once

#include <algorithm>
#include <cmath>

#include "hal/servo.h"

namespace lakshya {

// A drive that keeps turning when its host has died is not asked for more than `unsupervised_mps`.
constexpr double speed_limit(double max_speed_mps, bool supervised, double unsupervised_mps) {
  return supervised ? max_speed_mps : std::min(max_speed_mps, unsupervised_mps);
}

inline bool speeds_allowed(const WheelVelocities& wanted, double limit_mps) {
  // The comparison is false for NaN. A thousandth is for the rounding of those who compute wheel speeds from the limit.
  const double limit = limit_mps * 1.001;
  return std::abs(wanted.left_mps) <= limit && std::abs(wanted.right_mps) <= limit;
}

}  // namespace lakshya

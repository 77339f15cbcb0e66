// What every drive checks before it moves: the same limits in the same words.
#pragma once

#include <algorithm>
#include <cmath>

#include "hal/problem.h"
#include "hal/servo.h"

namespace lakshya {

// A drive that keeps turning when its host has died is not asked for more than `unsupervised_mps`.
constexpr double speed_limit(double max_speed_mps, bool supervised, double unsupervised_mps) {
  return supervised ? max_speed_mps : std::min(max_speed_mps, unsupervised_mps);
}

// Whether both speeds are numbers not above servo.max_speed_mps(); says in `problem` why not.
inline bool speeds_allowed(const WheelVelocities& wanted, const Servo& servo, Problem& problem) {
  // The comparison is false for NaN. A thousandth is for the rounding of those who compute wheel speeds from the limit.
  const double limit = servo.max_speed_mps() * 1.001;
  if (std::abs(wanted.left_mps) <= limit && std::abs(wanted.right_mps) <= limit) return true;
  problem.set("%g, %g m/s: faster than %g m/s%s; stopped", wanted.left_mps, wanted.right_mps, servo.max_speed_mps(),
              servo.is_supervised() ? "" : ", the limit for drives that nothing stops");
  return false;
}

}  // namespace lakshya

#include "app/nav/steering.h"

#include <algorithm>
#include <cmath>

namespace lakshya {
namespace {

double approach(double from, double to, double step) {
  return from + std::clamp(to - from, -step, step);
}

double limited(double wanted, double now, const WheelLimits& limits, double dt_s) {
  const bool changes_sense = wanted * now < 0;
  const double brake_to = changes_sense ? 0.0 : wanted;
  if (std::abs(brake_to) >= std::abs(now)) return approach(now, wanted, limits.acceleration_mps2 * dt_s);
  const double braked = approach(now, brake_to, limits.deceleration_mps2 * dt_s);
  if (!changes_sense || braked != 0) return braked;
  const double rest_s = dt_s - std::abs(now) / limits.deceleration_mps2;
  return approach(0, wanted, limits.acceleration_mps2 * std::max(0.0, rest_s));
}

}  // namespace

double turn_rate(double direction, double gain_per_s, double max_rate_rps) {
  return std::clamp(gain_per_s * direction, -max_rate_rps, max_rate_rps);
}

double speed_towards(double direction, double speed_mps) {
  return speed_mps * std::max(0.0, std::cos(direction));
}

WheelSpeeds wheel_speeds(double speed_mps, double turn_rate_rps, double track_m) {
  const double difference = turn_rate_rps * track_m / 2;
  return {speed_mps - difference, speed_mps + difference};
}

WheelSpeeds limit_acceleration(const WheelSpeeds& wanted, const WheelSpeeds& now, const WheelLimits& limits,
                               double dt_s) {
  return {limited(wanted.left_mps, now.left_mps, limits, dt_s),
          limited(wanted.right_mps, now.right_mps, limits, dt_s)};
}

}  // namespace lakshya

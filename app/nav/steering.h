// From a direction to two wheel speeds: docs/contract.md section 5. Differential drive; SI units, radians,
// counter-clockwise (to the left) positive.
#pragma once

namespace lakshya {

// omega = clamp(gain * direction, -max_rate, max_rate), rad/s; max_rate >= 0.
double turn_rate(double direction, double gain_per_s, double max_rate_rps);

// speed * max(0, cos(direction)): no way is lost while the vehicle turns on the spot.
double speed_towards(double direction, double speed_mps);

struct WheelSpeeds {
  double left_mps = 0;
  double right_mps = 0;
};

// left = v - omega track / 2, right = v + omega track / 2.
WheelSpeeds wheel_speeds(double speed_mps, double turn_rate_rps, double track_m);

struct WheelLimits {
  double acceleration_mps2 = 1;  // while a wheel gets faster, either way round, >= 0
  double deceleration_mps2 = 2;  // while it gets slower: the braking that the speed governor counts on, >= 0
};

// The speeds that each wheel can have after dt_s (>= 0) on its way from `now` to `wanted`. A wheel that changes
// its sense brakes to zero first.
WheelSpeeds limit_acceleration(const WheelSpeeds& wanted, const WheelSpeeds& now, const WheelLimits& limits,
                               double dt_s);

}  // namespace lakshya

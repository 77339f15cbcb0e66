#include "hal/compass/attitude.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lakshya {

HeadingSample seen_from_vehicle(const HeadingSample& device, double mounting) {
  HeadingSample vehicle = device;
  const double c = std::cos(mounting);
  const double s = std::sin(mounting);
  if (std::isnan(device.pitch) || std::isnan(device.roll)) {
    vehicle.pitch = vehicle.roll = std::numeric_limits<double>::quiet_NaN();
    vehicle.yaw = wrapped_angle(device.yaw - mounting);
    return vehicle;
  }
  // The vehicle's forward axis is (c, -s, 0) in the device's axes (forward, left, up); here it is, levelled.
  const double forward = std::cos(device.pitch) * c + std::sin(device.pitch) * s * std::sin(device.roll);
  const double left = -s * std::cos(device.roll);
  vehicle.yaw = wrapped_angle(device.yaw + std::atan2(left, forward));
  // The up direction in the device's axes, turned into the vehicle's.
  const double up_x = std::sin(device.pitch);
  const double up_y = std::cos(device.pitch) * std::sin(device.roll);
  const double up_z = std::cos(device.pitch) * std::cos(device.roll);
  vehicle.pitch = std::asin(std::clamp(c * up_x - s * up_y, -1.0, 1.0));
  vehicle.roll = std::atan2(s * up_x + c * up_y, up_z);
  return vehicle;
}

HeadingSample attitude_of(const Vector3& field, const Vector3& up, double& horizontal) {
  const double length = std::sqrt(dot(up, up));
  const Vector3 u = {up[0] / length, up[1] / length, up[2] / length};
  const double rising = dot(field, u);
  const Vector3 level = field - Vector3{rising * u[0], rising * u[1], rising * u[2]};
  horizontal = std::sqrt(dot(level, level));
  // Forward, levelled, and what is a quarter turn to its left; both as long as forward is level.
  const double to_forward = field[0] - u[0] * rising;
  const double to_left = field[1] * u[2] - field[2] * u[1];
  const double heading = std::atan2(to_left, to_forward);  // north to the left: the nose points east of it
  return {.yaw = wrapped_angle(std::numbers::pi / 2 - heading),
          .pitch = std::asin(std::clamp(u[0], -1.0, 1.0)),
          .roll = std::atan2(u[1], u[2])};
}

}  // namespace lakshya

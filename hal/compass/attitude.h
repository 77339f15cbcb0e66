// Angles of a compass that is not mounted straight.
#pragma once

#include <numbers>

#include "hal/compass.h"

namespace lakshya {

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// Into (-pi, pi].
double wrapped_angle(double rad);

// The vehicle's angles from those of a device whose forward axis points `mounting` rad to the left of the vehicle's (about the
// up axis they share; seen from above, counter-clockwise positive). Yaw, pitch and roll are turned one after the other, in this
// order, as everywhere (docs/contract.md, section 1). Where pitch or roll is NaN the device is taken to be level and both stay
// NaN. The time is kept.
HeadingSample seen_from_vehicle(const HeadingSample& device, double mounting);

}  // namespace lakshya

// Angles from what a compass measures, and of one that is not mounted straight.
#pragma once

#include "hal/angle.h"
#include "hal/compass.h"
#include "hal/compass/matrix3.h"

namespace lakshya {

// The vehicle's angles from those of a device whose forward axis points `mounting` rad to the left of the vehicle's (about the
// up axis they share; seen from above, counter-clockwise positive). Yaw, pitch and roll are turned one after the other, in this
// order, as everywhere (docs/contract.md, section 1). Where pitch or roll is NaN the device is taken to be level and both stay
// NaN. The time is kept.
HeadingSample seen_from_vehicle(const HeadingSample& device, double mounting);

// From the magnetic field and the up direction, each in a unit of its own, in body axes (forward, left, up): pitch, roll, and the
// yaw from magnetic north (yaw 0 is a quarter turn clockwise from it). `horizontal` gets the field's part that is level, in its
// unit: without one there is no yaw. `up` must not be zero. The time is 0.
HeadingSample attitude_of(const Vector3& field, const Vector3& up, double& horizontal);

}  // namespace lakshya

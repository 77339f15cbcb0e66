// `lakshya compass --calibrate`: what the vehicle's iron does to its magnetometer, from a turn on the spot.
#pragma once

#include <span>
#include <string>

#include "hal/compass/magnetometer_fit.h"

namespace CLI {
class App;
}

namespace lakshya {

void add_compass_command(CLI::App& app);

// The group `iio` of vehicle.yaml that holds the fit.
std::string calibration_yaml(const MagnetometerFit& fit);

// "180 of 360 degrees": the directions in which the samples lie, seen from the middle of what was seen.
int directions_seen_deg(std::span<const Vector3> samples);

}  // namespace lakshya

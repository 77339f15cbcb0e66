// Where the simulated cameras are when the vehicle is somewhere: docs/contract.md section 1.
#pragma once

#include <Eigen/Core>

#include "app/core/calibration.h"
#include "app/core/vehicle_config.h"
#include "app/tools/sim/ray_table.h"
#include "app/tools/sim/vehicle.h"

namespace lakshya::sim {

// Body frame (x forward, y left, z up) to world.
Eigen::Matrix3d world_from_body(const VehicleState& vehicle);

// The rectified left camera: its mount is what the configuration means.
CameraPose rectified_camera(const VehicleState& vehicle, const CameraConfig& mount);

// The two cameras as they are, before rectification.
struct EyePoses {
  CameraPose left;
  CameraPose right;
};
EyePoses eyes(const CameraPose& rectified, const StereoCalibration& calibration, const Eigen::Matrix3d& R1);

}  // namespace lakshya::sim

// The simulated stereo rig: a calibration like that of a real one, and where its eyes are.
#pragma once

#include <Eigen/Core>

#include "app/core/calibration.h"
#include "app/tools/sim/ray_table.h"

namespace lakshya::sim {

struct SimRig {
  int width = 640;  // px
  int height = 480;
  double hfov_deg = 80;      // of the undistorted image, 20..140
  double baseline_m = 0.12;  // > 0
  bool distorted = true;     // false: an ideal, rectified pair
};

// Distorted: barrel distortion of a cheap lens, principal points, focal lengths and directions that differ between the eyes by as
// much as they do in real rigs. Throws InputError for values outside their ranges.
StereoCalibration rig_calibration(const SimRig& rig);

// Rotation of a camera whose vehicle has `yaw`, mounted with `pitch` (nose down) and `roll` (right side down); radians,
// docs/contract.md section 1.
Eigen::Matrix3d camera_rotation(double yaw, double pitch, double roll);

// The right eye of a rig whose left eye has the pose given.
CameraPose right_pose(const StereoCalibration& calibration, const CameraPose& left);

}  // namespace lakshya::sim

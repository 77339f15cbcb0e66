#include "app/tools/sim/camera_pose.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace lakshya::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

// Rows: forward, left and up as seen from the camera.
Eigen::Matrix3d body_from_camera(const CameraConfig& mount) {
  const double sp = std::sin(mount.pitch_deg * kRadians);
  const double cp = std::cos(mount.pitch_deg * kRadians);
  const double sr = std::sin(mount.roll_deg * kRadians);
  const double cr = std::cos(mount.roll_deg * kRadians);
  Eigen::Matrix3d m;
  m << -sp * sr, -sp * cr, cp,  //
      -cr, sr, 0,               //
      -cp * sr, -cp * cr, -sp;
  return Eigen::AngleAxisd(mount.yaw_deg * kRadians, Eigen::Vector3d::UnitZ()).toRotationMatrix() * m;
}

}  // namespace

Eigen::Matrix3d world_from_body(const VehicleState& vehicle) {
  return (Eigen::AngleAxisd(vehicle.yaw, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(-vehicle.pitch, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(vehicle.roll, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

CameraPose rectified_camera(const VehicleState& vehicle, const CameraConfig& mount) {
  const Eigen::Matrix3d body = world_from_body(vehicle);
  const Eigen::Vector3d at(mount.forward_m, mount.left_m, mount.height_m);
  return {body * body_from_camera(mount), Eigen::Vector3d(vehicle.x, vehicle.y, vehicle.z) + body * at};
}

EyePoses eyes(const CameraPose& rectified, const StereoCalibration& calibration, const Eigen::Matrix3d& R1) {
  const Eigen::Matrix3d left = rectified.world_from_camera * R1;
  const Eigen::Matrix3d right_in_left = calibration.R.transpose();
  return {{left, rectified.position},
          {left * right_in_left, rectified.position - left * right_in_left * calibration.T}};
}

}  // namespace lakshya::sim

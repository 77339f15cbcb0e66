#include "app/tools/sim/rig.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "app/core/input_error.h"

namespace lakshya::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

}  // namespace

StereoCalibration rig_calibration(const SimRig& rig) {
  if (!(rig.hfov_deg >= 20 && rig.hfov_deg <= 140))
    throw InputError("simulated rig", "hfov_deg is outside 20..140");
  if (!(rig.baseline_m > 0)) throw InputError("simulated rig", "baseline_m must be greater than 0");
  StereoCalibration c;
  c.source = "simulated rig";
  c.width = rig.width;
  c.height = rig.height;
  const double f = rig.width / (2 * std::tan(rig.hfov_deg / 2 * kRadians));
  c.left.fx = c.left.fy = f;
  c.left.cx = (rig.width - 1) / 2.0;
  c.left.cy = (rig.height - 1) / 2.0;
  c.right = c.left;
  c.T = {-rig.baseline_m, 0, 0};
  c.images_rectified = !rig.distorted;
  if (!rig.distorted) return c;

  c.left.distortion = {-0.12, 0.02, 0.0004, -0.0003};
  c.right.distortion = {-0.118, 0.019, -0.0003, 0.0005};
  c.left.fy *= 1.0006;
  c.right.fx *= 1.003;
  c.right.fy *= 1.0035;
  c.left.cx += 0.008 * rig.width;
  c.left.cy -= 0.006 * rig.height;
  c.right.cx -= 0.005 * rig.width;
  c.right.cy += 0.009 * rig.height;
  c.R = (Eigen::AngleAxisd(0.12 * kRadians, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(-0.14 * kRadians, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(0.08 * kRadians, Eigen::Vector3d::UnitZ()))
            .toRotationMatrix();
  c.T = rig.baseline_m * Eigen::Vector3d(-1, 0.004, -0.006).normalized();
  return c;
}

Eigen::Matrix3d camera_rotation(double yaw, double pitch, double roll) {
  const double sp = std::sin(pitch);
  const double cp = std::cos(pitch);
  const double sr = std::sin(roll);
  const double cr = std::cos(roll);
  Eigen::Matrix3d body_from_camera;
  body_from_camera << -sp * sr, -sp * cr, cp,  //
      -cr, sr, 0,                              //
      -cp * sr, -cp * cr, -sp;
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix() * body_from_camera;
}

CameraPose right_pose(const StereoCalibration& calibration, const CameraPose& left) {
  const Eigen::Matrix3d left_from_right = calibration.R.transpose();
  return {left.world_from_camera * left_from_right,
          left.position - left.world_from_camera * (left_from_right * calibration.T)};
}

}  // namespace lakshya::sim

// Where the cameras are: docs/contract.md section 1.
#include "app/tools/sim/camera_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/core/rectification.h"
#include "app/tools/sim/rig.h"

namespace lakshya::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

CameraConfig mount() {
  CameraConfig m;
  m.height_m = 0.6;
  m.forward_m = 0.2;
  m.left_m = 0.06;
  return m;
}

TEST(CameraPose, LevelCameraLooksWhereTheVehiclePoints) {
  VehicleState vehicle;
  vehicle.x = 1;
  vehicle.y = 2;
  vehicle.z = 0.5;
  vehicle.yaw = 90 * kDegree;
  const CameraPose pose = rectified_camera(vehicle, mount());
  EXPECT_TRUE(pose.world_from_camera.col(2).isApprox(Eigen::Vector3d(0, 1, 0), 1e-9));   // forward: north
  EXPECT_TRUE(pose.world_from_camera.col(0).isApprox(Eigen::Vector3d(1, 0, 0), 1e-9));   // right: east
  EXPECT_TRUE(pose.world_from_camera.col(1).isApprox(Eigen::Vector3d(0, 0, -1), 1e-9));  // down
  EXPECT_TRUE(pose.position.isApprox(Eigen::Vector3d(1 - 0.06, 2 + 0.2, 1.1), 1e-9));
}

TEST(CameraPose, SignsOfTheMountAreTheContracts) {
  CameraConfig m = mount();
  m.pitch_deg = 10;  // nose down
  EXPECT_NEAR(rectified_camera({}, m).world_from_camera.col(2).z(), -std::sin(10 * kDegree), 1e-12);
  m = mount();
  m.roll_deg = 10;  // right side down
  EXPECT_NEAR(rectified_camera({}, m).world_from_camera.col(0).z(), -std::sin(10 * kDegree), 1e-12);
  m = mount();
  m.yaw_deg = 10;  // to the left
  EXPECT_NEAR(rectified_camera({}, m).world_from_camera.col(2).y(), std::sin(10 * kDegree), 1e-12);
}

TEST(CameraPose, AVehicleNoseUpLooksUp) {
  VehicleState vehicle;
  vehicle.pitch = 8 * kDegree;
  EXPECT_NEAR(rectified_camera(vehicle, mount()).world_from_camera.col(2).z(), std::sin(8 * kDegree), 1e-12);
  vehicle = {};
  vehicle.roll = 8 * kDegree;  // right side down
  EXPECT_NEAR(rectified_camera(vehicle, mount()).world_from_camera.col(0).z(), -std::sin(8 * kDegree), 1e-12);
}

TEST(CameraPose, RectifyingTheEyesGivesTheRectifiedCamera) {
  const StereoCalibration calibration = rig_calibration({.width = 320, .height = 240});
  const Rectification r = rectify_stereo(calibration, 320, 240);
  const CameraPose rectified = rectified_camera({}, mount());
  const EyePoses both = eyes(rectified, calibration, r.R1);
  // x_rectified = R x_camera for either eye, and the right one is a baseline to the right of the left one.
  EXPECT_TRUE((both.left.world_from_camera * r.R1.transpose()).isApprox(rectified.world_from_camera, 1e-9));
  EXPECT_TRUE((both.right.world_from_camera * r.R2.transpose()).isApprox(rectified.world_from_camera, 1e-9));
  const Eigen::Vector3d between =
      rectified.world_from_camera.transpose() * (both.right.position - both.left.position);
  EXPECT_TRUE(between.isApprox(Eigen::Vector3d(0.12, 0, 0), 1e-6)) << between.transpose();
}

}  // namespace
}  // namespace lakshya::sim

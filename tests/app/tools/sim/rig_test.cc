#include "app/tools/sim/rig.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/core/input_error.h"
#include "app/core/rectification.h"

namespace lakshya::sim {
namespace {

TEST(Rig, IdealPairNeedsNoRemap) {
  SimRig rig;
  rig.distorted = false;
  const StereoCalibration c = rig_calibration(rig);
  EXPECT_FALSE(needs_remap(c));
  const RectifiedGeometry g = rectified_geometry(c, rig.width, rig.height);
  EXPECT_NEAR(g.baseline_m, 0.12, 1e-12);
  EXPECT_NEAR(g.focal_px, 320 / std::tan(40 * 3.14159265358979 / 180), 1e-6);
}

TEST(Rig, DistortedPairCanBeRectified) {
  const SimRig rig;
  const StereoCalibration c = rig_calibration(rig);
  EXPECT_TRUE(needs_remap(c));
  const RectifiedGeometry g = rectified_geometry(c, rig.width, rig.height);
  EXPECT_NEAR(g.baseline_m, rig.baseline_m, 1e-9);
  EXPECT_GT(g.focal_px, 300);
  EXPECT_LT(g.focal_px, 500);
}

// docs/contract.md section 1: forward, left and up of the camera's frame.
TEST(Rig, CameraIsMountedAsTheContractSays) {
  const Eigen::Matrix3d level = camera_rotation(0, 0, 0);
  EXPECT_TRUE((level * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(1, 0, 0)));
  EXPECT_TRUE((level * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0, -1, 0)));
  EXPECT_TRUE((level * Eigen::Vector3d(0, 1, 0)).isApprox(Eigen::Vector3d(0, 0, -1)));
  EXPECT_LT((camera_rotation(0, 0.1, 0) * Eigen::Vector3d(0, 0, 1)).z(), 0);  // nose down
  EXPECT_LT((camera_rotation(0, 0, 0.1) * Eigen::Vector3d(1, 0, 0)).z(), 0);  // right side down
  EXPECT_GT((camera_rotation(0.1, 0, 0) * Eigen::Vector3d(0, 0, 1)).y(), 0);  // to the left
}

TEST(Rig, RightEyeSeesWhatTheCalibrationSays) {
  const StereoCalibration c = rig_calibration(SimRig{});
  const CameraPose left{camera_rotation(0.7, 0.2, 0.05), {1, 2, 0.5}};
  const CameraPose right = right_pose(c, left);
  const Eigen::Vector3d in_left(0.3, -0.2, 2);
  const Eigen::Vector3d world = left.world_from_camera * in_left + left.position;
  const Eigen::Vector3d in_right = right.world_from_camera.transpose() * (world - right.position);
  EXPECT_TRUE(in_right.isApprox(c.R * in_left + c.T, 1e-12));
}

TEST(Rig, RefusesWhatIsNoRig) {
  SimRig rig;
  rig.hfov_deg = 180;
  EXPECT_THROW(rig_calibration(rig), InputError);
  rig = {};
  rig.baseline_m = 0;
  EXPECT_THROW(rig_calibration(rig), InputError);
}

}  // namespace
}  // namespace lakshya::sim

// EuRoC's sensor.yaml pairs: two poses become R and T; the models that are not supported are refused.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "app/core/calibration_file.h"
#include "app/core/rectification.h"
#include "tests/support/calibration_texts.h"
#include "tests/support/data_path.h"
#include "tests/support/image_checks.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

using test::euroc_sensor;
using test::with;

class CalibrationEuroc : public ::testing::Test {
 protected:
  StereoCalibration read(const std::string& left, const std::string& right) const {
    return read_calibration({{folder_.write("left", left), folder_.write("right", right)}, 1.0, {}});
  }
  // The reason; the refusal must name the file.
  std::string refused(const std::string& left, const std::string& right, const std::string& file) const {
    return refusal(folder_.path(file), [&](const std::string&) { read(left, right); });
  }

  TempFolder folder_;
  std::string left_ = euroc_sensor("0.06");
  std::string right_ = euroc_sensor("-0.05", "82");
};

TEST_F(CalibrationEuroc, PosesBecomeRotationAndTranslation) {
  const StereoCalibration c = read(left_, right_);
  EXPECT_EQ(c.width, 160);
  EXPECT_EQ(c.height, 120);
  EXPECT_EQ(c.left.fx, 100.5);
  EXPECT_EQ(c.left.fy, 100.25);
  EXPECT_EQ(c.left.cx, 80);
  EXPECT_EQ(c.right.cx, 82);
  EXPECT_EQ(c.left.distortion[0], -0.28);
  EXPECT_EQ(c.left.distortion[3], 1.76e-05);
  EXPECT_EQ(c.left.distortion[4], 0);
  EXPECT_TRUE(c.R.isIdentity(1e-12));
  EXPECT_TRUE(c.T.isApprox(Eigen::Vector3d(-0.11, 0, 0), 1e-12)) << c.T;
  EXPECT_FALSE(c.images_rectified);
  EXPECT_FALSE(c.rectification.has_value());
}

// The right camera turned by the 3-4-5 angle about its y axis, to the left: what lies ahead of the left camera at
// (0, 0, 1) moves to the right.
TEST_F(CalibrationEuroc, RotationMapsLeftToRight) {
  const std::string turned = with(right_, "[0.0, 0.0, 1.0, 0.02,\n         -1.0, 0.0, 0.0, -0.05",
                                  "[0.6, 0.0, 0.8, 0.02,\n         -0.8, 0.0, 0.6, -0.05");
  const StereoCalibration c = read(left_, turned);
  EXPECT_TRUE((c.R * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(0.6, 0, 0.8), 1e-12)) << c.R;
  EXPECT_TRUE(c.T.isApprox(Eigen::Vector3d(-0.8 * 0.11, 0, 0.6 * 0.11), 1e-12)) << c.T;
}

TEST_F(CalibrationEuroc, OneFileAloneIsRefused) {
  const std::string path = folder_.write("left", left_);
  EXPECT_CONTAINS(refusal(path, [](const std::string& p) { read_calibration(p); }),
                  "EuRoC sensor.yaml; the other camera's is needed");
}

TEST_F(CalibrationEuroc, PairsThatAreNone) {
  EXPECT_CONTAINS(refused(right_, left_, "right"), "T_BS: T_x is not negative: left and right are swapped");
  EXPECT_CONTAINS(refused(left_, left_, "right"), "T_BS: baseline 0 m is outside 0.001..10 m (give the left and");
  EXPECT_CONTAINS(refused(left_, euroc_sensor("-50"), "right"), "T_BS: baseline 50.06 m is outside");
  EXPECT_CONTAINS(refused(left_, with(right_, "1.0, 0.02", "1.0, 0.2"), "right"),
                  "T_BS: the right camera is mainly above, below, before or behind");
  EXPECT_CONTAINS(refused(left_, with(right_, "[160, 120]", "[160, 100]"), "right"),
                  "resolution: 160x100 is not the left camera's 160x120");
  EXPECT_CONTAINS(refused(left_, test::ros_camera_info("right", "-10.8"), "right"), "format: not that of");
  EXPECT_CONTAINS(refused(left_, "hello\n", "right"), "format: not a calibration that is known");
  EXPECT_CONTAINS(refused(test::kitti_calib(), right_, "left"), "format: holds both cameras by itself");
}

TEST_F(CalibrationEuroc, Refusals) {
  const auto expect = [this](const std::string& from, const std::string& to, const std::string& reason) {
    const std::string why = refused(with(left_, from, to), right_, "left");
    EXPECT_CONTAINS(why, reason);
    EXPECT_EQ(why.back(), ')');
    EXPECT_CONTAINS(refused(left_, with(right_, from == ", 80" ? ", 82" : from, to), "right"), reason);
  };
  for (const std::string key :
       {"resolution", "camera_model", "intrinsics", "distortion_model", "distortion_coefficients"}) {
    expect("\n" + key + ":", "\nx" + key + ":", key + ": missing (a EuRoC sensor.yaml has T_BS");
  }
  expect("pinhole", "omni", "camera_model: 'omni' is not supported (calibrate with pinhole)");
  expect("radial-tangential", "equidistant", "distortion_model: 'equidistant' is not supported");
  expect("radial-tangential", "[a]", "distortion_model: holds a list or a map where a word belongs");
  expect("0.07, ", "", "distortion_coefficients: 3 coefficients where 4 or 5 belong");
  expect("0.07, ", ".nan, ", "distortion_coefficients: '.nan' is not a number");
  expect("100.5, ", "", "intrinsics: 1x3 numbers where 1x4 belong");
  expect("100.5, ", "-100.5, ", "intrinsics: focal length -100.5 is not positive");
  expect("100.5, ", "inf, ", "intrinsics: 'inf' is not a finite number");
  expect(", 80", ", 800", "intrinsics: principal point at 800 px");
  expect("[160, 120]", "[160]", "resolution: 1x1 numbers where 1x2 belong");
  expect("[160, 120]", "[0, 120]", "resolution: 0 is not an integer in 1..16384");
  expect("0.0, -1.0, 0.0, 0.01", "0.0, 1.0, 0.0, 0.01", "T_BS: not a rotation");
  expect("0.0, -1.0, 0.0, 0.01", "0.0, -1.0, 0.01, 0.01", "T_BS: not a rotation");
  expect("0.0, 0.0, 0.0, 1.0]", "0.0, 0.0, 0.0, 2.0]", "T_BS: its last row is not 0 0 0 1");
  expect("0.0, 0.0, 0.0, 1.0]", "0.0, 0.0, 1.0]", "T_BS: data has not rows x cols numbers");
  expect("rows: 4", "rows: 3", "T_BS: data has not rows x cols numbers");
  expect("resolution: [160, 120]", "resolution: [160, 120", "YAML: line");
  expect("rate_hz: 20", "resolution: 20", "YAML: 'resolution' is given twice");
}

TEST_F(CalibrationEuroc, SurvivesTruncationAndDamage) {
  for (std::size_t length = 1; length < left_.size() - 10; ++length) {
    EXPECT_NE(refused(left_.substr(0, length), right_, "left"), "") << length;
  }
  std::mt19937 random(3);
  for (int i = 0; i < 1000; ++i) {
    std::string damaged = right_;
    for (unsigned flips = 1 + static_cast<unsigned>(random() % 3); flips > 0; --flips)
      damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
    refused(left_, damaged, "right");
  }
}

TEST(CalibrationEurocData, RectifiesAsOpencvDoes) {
  const std::string folder = test::data_path("euroc_v1_01_part_a");
  if (folder.empty()) GTEST_SKIP() << "no euroc_v1_01_part_a under LAKSHYA_DATA";
  const StereoCalibration c = read_calibration(folder);
  EXPECT_NEAR(c.T.x(), -0.11007, 1e-5);
  const RectifiedGeometry g = rectified_geometry(c, 752, 480);  // folder's README: cv::stereoRectify, alpha 0
  EXPECT_NEAR(g.baseline_m, 0.11008, 5e-6);
  EXPECT_NEAR(g.focal_px, 436.235, 5e-4);
  EXPECT_NEAR(g.cx_left, 364.441, 5e-4);
  EXPECT_NEAR(g.cy, 256.952, 5e-4);
}

}  // namespace
}  // namespace lakshya

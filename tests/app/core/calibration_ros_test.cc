// ROS camera_info pairs: rectification as the files give it, R and T that follow from it, and all refusals.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "app/core/calibration_file.h"
#include "app/core/rectification.h"
#include "tests/support/calibration_texts.h"
#include "tests/support/image_checks.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

using test::ros_camera_info;
using test::with;

class CalibrationRos : public ::testing::Test {
 protected:
  StereoCalibration read(const std::string& left, const std::string& right) const {
    return read_calibration({{folder_.write("left", left), folder_.write("right", right)}, 1.0, {}});
  }
  std::string refused(const std::string& left, const std::string& right, const std::string& file) const {
    return refusal(folder_.path(file), [&](const std::string&) { read(left, right); });
  }

  TempFolder folder_;
  std::string left_ = ros_camera_info("left", "0");
  std::string right_ = ros_camera_info("right", "-10.8");
};

TEST_F(CalibrationRos, PlumbBob) {
  const StereoCalibration c = read(left_, right_);
  EXPECT_EQ(c.width, 160);
  EXPECT_EQ(c.height, 120);
  EXPECT_EQ(c.left.fx, 100);
  EXPECT_EQ(c.left.fy, 101);
  EXPECT_EQ(c.right.cx, 81);
  EXPECT_EQ(c.right.distortion[4], 0.5);
  EXPECT_FALSE(c.images_rectified);
  ASSERT_TRUE(c.rectification.has_value());
  EXPECT_EQ(c.rectification->R1(0, 2), -0.6);
  EXPECT_EQ(c.rectification->P2(0, 3), -10.8);
  const RectifiedGeometry g = rectified_geometry(c, 160, 120);
  EXPECT_EQ(g.focal_px, 90);
  EXPECT_EQ(g.cx_left, 80);
  EXPECT_EQ(g.cy, 60);
  EXPECT_NEAR(g.baseline_m, 0.12, 1e-15);
}

TEST_F(CalibrationRos, PoseFollowsFromTheRectification) {
  const StereoCalibration c = read(left_, right_);
  EXPECT_TRUE(c.R.isIdentity(1e-12));
  EXPECT_TRUE(c.T.isApprox(Eigen::Vector3d(-0.096, 0, 0.072), 1e-12)) << c.T;

  const std::string straight = with(right_, "[0.8, 0, -0.6, 0, 1, 0, 0.6, 0, 0.8]", "[1, 0, 0, 0, 1, 0, 0, 0, 1]");
  const StereoCalibration t = read(left_, straight);
  EXPECT_TRUE(t.R.isApprox(t.rectification->R1, 1e-12));
  EXPECT_TRUE(t.T.isApprox(Eigen::Vector3d(-0.12, 0, 0), 1e-12)) << t.T;
}

TEST_F(CalibrationRos, RationalPolynomialAndUnequalPrincipalPoints) {
  const std::string rational = with(with(with(right_, "plumb_bob", "rational_polynomial"), "cols: 5", "cols: 8"),
                                    "0.4, 0.5]", "0.4, 0.5, 0.6, 0.7, 0.8]");
  const StereoCalibration c = read(left_, with(rational, "[90, 0, 80,", "[90, 0, 82.5,"));
  EXPECT_EQ(c.right.distortion[7], 0.8);
  EXPECT_EQ(rectified_geometry(c, 160, 120).doffs(), 2.5);
}

TEST_F(CalibrationRos, OneFileAloneIsRefused) {
  const std::string path = folder_.write("left", left_);
  EXPECT_CONTAINS(refusal(path, [](const std::string& p) { read_calibration(p); }),
                  "ROS camera_info; the other camera's is needed");
}

TEST_F(CalibrationRos, PairsThatAreNone) {
  EXPECT_CONTAINS(refused(right_, left_, "left"),
                  "projection_matrix: its last column is not zero: left and right are");
  EXPECT_CONTAINS(refused(left_, ros_camera_info("right", "10.8"), "right"),
                  "projection_matrix: baseline -0.12 m is negative: left and right are swapped");
  EXPECT_CONTAINS(refused(left_, left_, "right"), "projection_matrix: baseline 0 m is outside 0.001..10 m");
  EXPECT_CONTAINS(refused(left_, ros_camera_info("right", "-1080"), "right"), "baseline 12 m is outside");
  EXPECT_CONTAINS(refused(left_, with(right_, "image_width: 160", "image_width: 161"), "right"),
                  "image_width: 161x120 is not the left camera's 160x120");
  EXPECT_CONTAINS(refused(left_, with(right_, "0, 90, 60", "0, 90, 61"), "right"),
                  "projection_matrix: cy 61 is not the left camera's 60");
  EXPECT_CONTAINS(refused(left_, with(right_, "[90, 0, 80, -10.8, 0, 90,", "[91, 0, 80, -10.8, 0, 91,"), "right"),
                  "projection_matrix: focal length 91 is not the left camera's 90");
}

TEST_F(CalibrationRos, Refusals) {
  const auto expect = [this](const std::string& from, const std::string& to, const std::string& reason) {
    const std::string why = refused(with(left_, from, to), right_, "left");
    EXPECT_CONTAINS(why, reason);
    EXPECT_EQ(why.back(), ')');
    EXPECT_CONTAINS(refused(left_, with(right_, from, to), "right"), reason);
  };
  for (const std::string key : {"image_height", "camera_matrix", "distortion_model", "distortion_coefficients",
                                "rectification_matrix", "projection_matrix"}) {
    expect("\n" + key + ":", "\nx" + key + ":", key + ": missing (a ROS camera_info file has image_width");
  }
  expect("image_width: 160", "image_width: 0", "image_width: 0 is not an integer in 1..16384");
  expect("image_width: 160", "image_width: [160]", "image_width: holds a list");
  expect("plumb_bob", "equidistant", "distortion_model: 'equidistant' is not supported");
  expect("plumb_bob", "rational_polynomial", "distortion_coefficients: 5 coefficients where 8, 12 or 14 belong");
  expect("0.4, 0.5]", "0.4]", "distortion_coefficients: data has not rows x cols numbers");
  expect("[100, 0,", "[100, 2,", "camera_matrix: not a camera matrix without skew");
  expect("[100, 0,", "[-100, 0,", "camera_matrix: focal length -100 is not positive");
  expect("[100, 0,", "[nan, 0,", "camera_matrix: 'nan' is not a finite number");
  expect("-0.6,", "0.6,", "rectification_matrix: not a rotation");
  expect("[90, 0, 80,", "[91, 0, 80,", "projection_matrix: focal lengths 91 and 90 differ");
  expect("[90, 0, 80,", "[90, 0, 800,", "projection_matrix: principal point at 800 px");
  expect("0, 90, 60, 0", "0, 90, 60, -5", "projection_matrix: a vertical stereo rig");
  expect("60, 0, 0, 0, 1, 0]", "60, 0, 0, 0, 2, 0]", "projection_matrix: not a rectified projection");
  expect("cols: 4", "cols: 3", "projection_matrix: data has not rows x cols numbers");
}

TEST_F(CalibrationRos, SurvivesTruncationAndDamage) {
  for (std::size_t length = 1; length < left_.size() - 1; ++length) {
    EXPECT_NE(refused(left_.substr(0, length), right_, "left"), "") << length;
  }
  std::mt19937 random(4);
  for (int i = 0; i < 1000; ++i) {
    std::string damaged = right_;
    for (unsigned flips = 1 + static_cast<unsigned>(random() % 3); flips > 0; --flips)
      damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
    refused(left_, damaged, "right");
  }
}

}  // namespace
}  // namespace lakshya

// KITTI's projections: names or none, grey and colour pair, and everything that is refused.
#include <gtest/gtest.h>

#include <string>

#include "app/core/calibration_file.h"
#include "app/core/rectification.h"
#include "tests/support/calibration_texts.h"
#include "tests/support/data_path.h"
#include "tests/support/image_checks.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

using test::kitti_calib;
using test::with;

const std::string kCamToCam =
    "calib_time: 09-Jan-2012 13:57:47\n"
    "corner_dist: 9.950000e-02\n"
    "S_00: 1.392000e+03 5.120000e+02\n"
    "K_00: 9.842439e+02 0 6.9e+02 0 9.808141e+02 2.331966e+02 0 0 1\n"
    "D_00: -3.728755e-01 2.037299e-01 2.219027e-03 1.383707e-03 -7.233722e-02\n"
    "S_rect_00: 1.242000e+03 3.750000e+02\n"
    "R_rect_00: 1 0 0 0 1 0 0 0 1\n"
    "P_rect_00: 7.215377e+02 0 6.095593e+02 0 0 7.215377e+02 1.728540e+02 0 0 0 1 0\n"
    "S_rect_01: 1.242000e+03 3.750000e+02\n"
    "P_rect_01: 7.215377e+02 0 6.095593e+02 -3.875744e+02 0 7.215377e+02 1.728540e+02 0 0 0 1 0\n";

class CalibrationKitti : public ::testing::Test {
 protected:
  StereoCalibration read(const std::string& text, CameraNumbers cameras = {}) const {
    return read_calibration({{folder_.write("calib.txt", text)}, 1.0, cameras});
  }
  std::string refused(const std::string& text, CameraNumbers cameras = {}) const {
    return refusal(folder_.path("calib.txt"), [&](const std::string&) { read(text, cameras); });
  }

  TempFolder folder_;
};

TEST_F(CalibrationKitti, GreyPair) {
  const StereoCalibration c = read(kitti_calib());
  EXPECT_TRUE(c.images_rectified);
  EXPECT_EQ(c.width, 0);
  const RectifiedGeometry g = rectified_geometry(c, 1226, 370);
  EXPECT_EQ(g.focal_px, 700);
  EXPECT_EQ(g.cx_left, 600);
  EXPECT_EQ(g.cy, 180);
  EXPECT_EQ(g.doffs(), 0);
  EXPECT_EQ(g.baseline_m, 0.5);
}

TEST_F(CalibrationKitti, ColourPairIsTheDifferenceOfTwoTranslations) {
  const StereoCalibration c = read(kitti_calib(), {2, 3});
  EXPECT_NEAR(c.T.x(), -0.535, 1e-12);
  EXPECT_EQ(c.T.y(), 0);
  EXPECT_NEAR(read(kitti_calib(), {0, 3}).T.x(), -0.4725, 1e-12);
}

TEST_F(CalibrationKitti, LinesWithoutNames) {
  const std::string two = "700 0 600 0 0 700 180 0 0 0 1 0\n\r\n7e+02 0 600 -350 0 +700 180 0 0 0 1 0 \r\n";
  EXPECT_EQ(read(two).T.x(), -0.5);
  EXPECT_CONTAINS(refused(two, {2, 3}), "P2: missing");
  EXPECT_CONTAINS(refused(two + two + two), "P4: more than 4 lines of numbers: a list of poses?");
  EXPECT_CONTAINS(refused("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 1\n"),
                  "P0: focal length 1 px is outside");
  EXPECT_CONTAINS(refused("1 2 3\n"), "P0: 3 numbers where 12 belong");
}

TEST_F(CalibrationKitti, CamToCamStatesTheSize) {
  const StereoCalibration c = read(kCamToCam);
  EXPECT_EQ(c.width, 1242);
  EXPECT_EQ(c.height, 375);
  EXPECT_EQ(c.left.cx, 609.5593);
  EXPECT_NEAR(-c.T.x(), 387.5744 / 721.5377, 1e-12);
  EXPECT_CONTAINS(refused(kCamToCam, {2, 3}), "P2: missing (a KITTI calibration has a line of 12 numbers");
  EXPECT_CONTAINS(refused(with(kCamToCam, "S_rect_01: 1.242000e+03", "S_rect_01: 1.241000e+03")),
                  "S_rect_01: 1241x375 is not the left camera's 1242x375");
  EXPECT_CONTAINS(refused(with(kCamToCam, "S_rect_00: 1.242000e+03", "S_rect_00: 0")),
                  "S_rect_00: 0 is not an integer in 1..16384");
  EXPECT_CONTAINS(refused(with(kCamToCam, "S_rect_00: 1.242000e+03", "S_rect_00:")),
                  "S_rect_00: 1 numbers where 2 belong");
  EXPECT_CONTAINS(refused(with(kCamToCam, "P_rect_00: 7.215377e+02 0 6.095593e+02", "P_rect_00: 721.5377 0 -4000")),
                  "P_rect_00: principal point at -4000 px is more than 3 image sizes");
}

TEST_F(CalibrationKitti, SwappedCamerasAreNamed) {
  for (const CameraNumbers swapped : {CameraNumbers{1, 0}, CameraNumbers{3, 2}}) {
    EXPECT_CONTAINS(refused(kitti_calib(), swapped), "left and right are swapped");
  }
  EXPECT_CONTAINS(refused(kitti_calib(), {1, 1}), "P1: baseline 0 m is outside 0.001..10 m");
}

TEST_F(CalibrationKitti, Refusals) {
  const auto expect = [this](const std::string& from, const std::string& to, const std::string& reason) {
    const std::string why = refused(with(kitti_calib(), from, to));
    EXPECT_CONTAINS(why, reason);
    EXPECT_EQ(why.back(), ')');
  };
  expect("P1:", "Q1:", "P1: missing (a KITTI calibration has");
  expect("P0:", "Q0:", "P0: missing");
  expect("P2:", "P1:", "'P1': given twice");
  expect("P1: 7.0e+02", "P1:", "P1: 11 numbers where 12 belong");
  expect("P1: 7.0e+02", "P1: 1 7.0e+02", "P1: 13 numbers where 12 belong");
  expect("P1: 7.0e+02", "P1: nan", "P1: 'nan' is not a finite number");
  expect("P1: 7.0e+02", "P1: 7.0f+02", "P1: '7.0f+02' is not a number");
  expect("P1: 7.0e+02", "P1: 1e400", "P1: '1e400' is out of range");
  expect("P1: 7.0e+02", "P1: 7.1e+02", "P1: focal lengths 710 and 700 differ");
  expect("P1: 7.0e+02 0 6.0e+02 -3.5e+02 0 7.0e+02", "P1: 7.1e+02 0 6.0e+02 -3.5e+02 0 7.1e+02",
         "P1: focal length 710 is not the left camera's 700");
  expect("P1: 7.0e+02 0 6.0e+02 -3.5e+02 0 7.0e+02", "P1: -7.0e+02 0 6.0e+02 -3.5e+02 0 -7.0e+02",
         "P1: focal length -700 is not positive");
  expect("-3.5e+02 0 7.0e+02 1.8e+02", "-3.5e+02 0 7.0e+02 1.9e+02", "P1: cy 190 is not the left camera's 180");
  expect("-3.5e+02 0", "-3.5e+02 0.1", "P1: not a rectified projection");
  expect("-3.5e+02", "3.5e+02", "P1: T_x is not negative: left and right are swapped");
  expect("-3.5e+02", "-350000", "P1: baseline 500 m is outside 0.001..10 m");
  expect("-3.5e+02 0 7.0e+02 1.8e+02 0", "-3.5e+02 0 7.0e+02 1.8e+02 14", "offset by 0.02 m in height");
  expect("-3.5e+02 0 7.0e+02 1.8e+02 0", "0 0 7.0e+02 1.8e+02 -350", "only a horizontal stereo rig");
}

TEST_F(CalibrationKitti, EveryCutIsRefusedOrWhole) {
  const std::string text = with(kitti_calib(), "P1: 7.0e+02 0 6.0e+02 -3.5e+02 0 7.0e+02 1.8e+02 0 0 0 1 0",
                                "P1: 7.0e+02 0 6.0e+02 -3.5e+02 0 7.0e+02 1.8e+02 0 0 0 1 0.0");
  const std::size_t end_of_p1 = text.find("\nP2:");
  for (std::size_t length = 1; length < end_of_p1 - 2; ++length) {
    EXPECT_NE(refused(text.substr(0, length)), "") << length;
  }
  EXPECT_EQ(refused(text.substr(0, end_of_p1)), "");
}

TEST(CalibrationKittiData, Odometry06) {
  const std::string path = test::data_path("kitti_odometry_06/calib.txt");
  if (path.empty()) GTEST_SKIP() << "no kitti_odometry_06 under LAKSHYA_DATA";
  const RectifiedGeometry g = rectified_geometry(read_calibration(path), 1226, 370);
  EXPECT_EQ(g.focal_px, 707.0912);
  EXPECT_EQ(g.cx_left, 601.8873);
  EXPECT_EQ(g.cy, 183.1104);
  EXPECT_EQ(g.doffs(), 0);
  EXPECT_NEAR(g.baseline_m, 0.53715, 1e-5);
  const std::string poses = test::data_path("kitti_odometry_06/poses.txt");
  EXPECT_CONTAINS(refusal(poses, [](const std::string& p) { read_calibration(p); }), "a list of poses?");
}

}  // namespace
}  // namespace lakshya

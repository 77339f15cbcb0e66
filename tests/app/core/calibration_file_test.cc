// Calibration files: what each format means, and that everything else is refused with file, key and reason.
#include "app/core/calibration_file.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "app/core/calibration.h"
#include "app/core/input_error.h"
#include "tests/support/calibration_texts.h"
#include "tests/support/data_path.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

// As cv::FileStorage of OpenCV 4.6 writes it, line breaks included.
const std::string kOpencv = R"(%YAML:1.0
---
K1: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 4.5865400000000000e+02, 0., 3.6721499999999997e+02, 0.,
       4.5729599999999999e+02, 2.4837500000000000e+02, 0., 0., 1. ]
D1: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -2.8340810999999999e-01, 7.3959070000000002e-02,
       1.9358999999999999e-04, 1.7618711400000001e-05, 0. ]
K2: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 4.5758699999999999e+02, 0., 3.7999900000000002e+02, 0.,
       4.5613400000000001e+02, 2.5523800000000000e+02, 0., 0., 1. ]
D2: !!opencv-matrix
   rows: 4
   cols: 1
   dt: d
   data: [ -2.8368365000000001e-01, 7.4512839999999997e-02,
       -1.0473000000000000e-04, -3.5559070000000001e-05 ]
R: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 1., 0., 0., 0., 1., 0., 0., 0., 1. ]
T: !!opencv-matrix
   rows: 3
   cols: 1
   dt: d
   data: [ -1.1000000000000000e-01, 4.0000000000000002e-04,
       -8.0000000000000004e-04 ]
image_size: [ 752, 480 ]
)";

// Written by hand: baseline 110 mm along x.
const std::string kByHand = R"(# my rig
K1: [[500, 0, 320], [0, 500, 240], [0, 0, 1]]
K2:
  - [500, 0, 330]
  - [0, 500, 240]
  - [0, 0, 1]
R: [1, 0, 0, 0, 1, 0, 0, 0, 1]
T: [-110, 0, 0]
)";

const std::string kHandRectification = R"(R1: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
R2: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
P1: [[400, 0, 320, 0], [0, 400, 240, 0], [0, 0, 1, 0]]
P2: [[400, 0, 350, -44000], [0, 400, 240, 0], [0, 0, 1, 0]]
)";

// -1/Tx with Tx = -110, (cx1 - cx2)/Tx = 30/110.
const std::string kHandQ = "Q: [1, 0, 0, -320, 0, 1, 0, -240, 0, 0, 0, 400, 0, 0, 0.00909091, 0.27272727]\n";

const std::string kMiddlebury =
    "cam0=[999.421 0 294.182; 0 999.421 252.932; 0 0 1]\n"
    "cam1=[999.421 0 326.96; 0 999.421 252.932; 0 0 1]\n"
    "doffs=32.778\n"
    "baseline=193.001\n"
    "width=741\n"
    "height=497\n"
    "ndisp=70\n"
    "isint=0\n"
    "dyavg=0.23\n";

constexpr double kMillimetres = 0.001;

using test::with;

class CalibrationFile : public ::testing::Test {
 protected:
  using Fragments = std::vector<std::string>;

  StereoCalibration read(const std::string& text, double unit_m = 1.0) {
    return read_calibration(folder_.write("calib", text), unit_m);
  }

  // Every refusal names the file, has all fragments and ends with "(what to do)".
  void expect_refused(const std::string& text, const Fragments& fragments, double unit_m = 1.0) {
    SCOPED_TRACE(text.substr(0, 2000));
    try {
      read(text, unit_m);
      ADD_FAILURE() << "accepted, expected a refusal with " << fragments.front();
    } catch (const InputError& e) {
      const std::string message = e.what();
      EXPECT_EQ(message.find(folder_.path("calib") + ": "), 0U) << message;
      for (const std::string& fragment : fragments)
        EXPECT_NE(message.find(fragment), std::string::npos) << message;
      EXPECT_EQ(message.back(), ')') << message;
    }
  }

  void expect_hand_refused(const std::string& from, const std::string& to, const Fragments& fragments) {
    expect_refused(with(kByHand + kHandRectification + kHandQ, from, to), fragments, kMillimetres);
  }

  void expect_middlebury_refused(const std::string& from, const std::string& to, const Fragments& fragments) {
    expect_refused(with(kMiddlebury, from, to), fragments);
  }

  void read_or_refuse(const std::string& text) {
    try {
      const StereoCalibration c = read(text, kMillimetres);
      EXPECT_LT(c.T.x(), 0);
      EXPECT_GT(c.left.fx, 0);
    } catch (const InputError&) {
      ++refusals_;
    }
  }

  TempFolder folder_;
  int refusals_ = 0;
};

TEST_F(CalibrationFile, OpencvYaml) {
  const StereoCalibration c = read(kOpencv);
  EXPECT_EQ(c.source, folder_.path("calib"));
  EXPECT_EQ(c.width, 752);
  EXPECT_EQ(c.height, 480);
  EXPECT_EQ(c.left.fx, 458.654);
  EXPECT_EQ(c.left.fy, 457.296);
  EXPECT_EQ(c.left.cx, 367.215);
  EXPECT_EQ(c.left.cy, 248.375);
  EXPECT_EQ(c.left.distortion[0], -0.28340811);
  EXPECT_EQ(c.left.distortion[3], 1.76187114e-05);
  EXPECT_EQ(c.right.fx, 457.587);
  EXPECT_EQ(c.right.distortion[1], 0.07451284);
  EXPECT_EQ(c.right.distortion[4], 0);
  EXPECT_TRUE(c.R.isIdentity(0));
  EXPECT_EQ(c.T, Eigen::Vector3d(-0.11, 0.0004, -0.0008));
  EXPECT_FALSE(c.images_rectified);
  EXPECT_FALSE(c.rectification.has_value());
}

TEST_F(CalibrationFile, OpencvYamlByHand) {
  const StereoCalibration c = read(kByHand, kMillimetres);
  EXPECT_EQ(c.width, 0);
  EXPECT_EQ(c.left.fx, 500);
  EXPECT_EQ(c.right.cx, 330);
  EXPECT_EQ(c.left.distortion[0], 0);
  EXPECT_EQ(c.T, Eigen::Vector3d(-0.11, 0, 0));
}

TEST_F(CalibrationFile, OpencvNamesAndSpellings) {
  std::string sample = with(with(kOpencv, "K1:", "M1:"), "K2:", "M2:");
  EXPECT_EQ(read(sample).right.fx, 457.587);
  sample = with(sample, "---\n", "");  // as older versions wrote it
  EXPECT_EQ(read(sample).left.fx, 458.654);
  std::string crlf;
  for (const char c : kOpencv)
    crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read(crlf).T.x(), -0.11);
  EXPECT_EQ(read("\xEF\xBB\xBF" + kOpencv).T.x(), -0.11);
  EXPECT_EQ(read(with(kOpencv, "image_size: [ 752, 480 ]", "rms: 0.2\nfiles: [a, [b]]")).width, 0);
  EXPECT_EQ(read(with(kByHand, "[-110, 0, 0]", "[[-110], [0], [0]]"), kMillimetres).T.x(), -0.11);
  EXPECT_EQ(read(with(kByHand, "[-110, 0, 0]", "\n  - -110\n  - +0.\n  - 0e0"), kMillimetres).T.x(), -0.11);
}

TEST_F(CalibrationFile, OpencvImageSizes) {
  for (const char* size :
       {"image_width: 640\nimage_height: 480\n", "width: 640\nheight: 480\n", "size: [640, 480]\n",
        "image_size: [ 640, 480 ]\n", "imageSize: [640, 480]\nwidth: 640\nheight: 480\n"}) {
    const StereoCalibration c = read(kByHand + size, kMillimetres);
    EXPECT_EQ(c.width, 640);
    EXPECT_EQ(c.height, 480);
  }
  const auto refused = [this](const std::string& size, const Fragments& fragments) {
    expect_refused(kByHand + size, fragments, kMillimetres);
  };
  refused("width: 640\n", {"height: missing"});
  refused("image_height: 640\n", {"image_width: missing"});
  refused("size: [640, 480]\nimage_size: [640, 400]\n", {"image_size: 640x400 contradicts 640x480"});
  refused("size: [640]\n", {"size: 1x1 numbers where 1x2 belong"});
  refused("size: 0.025\n", {"size: not a matrix"});
  refused("size: [0, 480]\n", {"size: 0 is not an integer in 1..16384"});
  refused("size: [-640, 480]\n", {"size: -640"});
  refused("size: [640.5, 480]\n", {"size: 640.5"});
  refused("width: 16385\nheight: 480\n", {"width: 16385"});
  refused("width: [640]\nheight: 480\n", {"width: ", "list"});
}

TEST_F(CalibrationFile, OpencvDistortionModels) {
  const std::vector<std::pair<int, std::string>> models{
      {0, "[]"},
      {4, "[.1, .2, .3, .4]"},
      {5, "[[.1], [.2], [.3], [.4], [.5]]"},
      {8, "[[.1, .2, .3, .4, .5, .6, .7, .8]]"},
      {12, "[.1, .2, .3, .4, .5, .6, .7, .8, .9, 1.0, 1.1, 1.2]"},
      {12, "[.1, .2, .3, .4, .5, .6, .7, .8, .9, 1.0, 1.1, 1.2, 0, 0]"},
      {0, "!!opencv-matrix\n   rows: 0\n   cols: 0\n   dt: u\n   data: []"}};
  for (const auto& [count, list] : models) {
    const StereoCalibration c = read(std::string(kByHand).append("D1: ").append(list).append("\n"), kMillimetres);
    for (int i = 0; i < 12; ++i) {
      EXPECT_DOUBLE_EQ(c.left.distortion[static_cast<std::size_t>(i)], i < count ? 0.1 * (i + 1) : 0.0);
    }
    EXPECT_EQ(c.right.distortion[0], 0);
  }
  const auto refused = [this](const std::string& d, const Fragments& fragments) {
    expect_refused(kByHand + "D2: " + d + "\n", fragments, kMillimetres);
  };
  refused("[1, 2, 3]", {"D2: 3 coefficients", "0, 4, 5, 8, 12 or 14"});
  refused("[[1, 2], [3, 4]]", {"D2: 2x2 numbers where one row belongs"});
  refused("[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0.01, 0]", {"D2: ", "tilt"});
  refused("[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0.01]", {"D2: ", "tilt"});
  refused("[1, 2, 3, .nan]", {"D2: '.nan' is not a number"});
  refused("[1, 2, 3, nan]", {"D2: 'nan' is not a finite number"});
  refused("[1, 2, 3, -inf]", {"D2: '-inf' is not a finite number"});
  refused("[1, 2, 3, 1e999]", {"D2: '1e999' is out of range"});
  refused("0", {"D2: not a matrix"});
}

TEST_F(CalibrationFile, OpencvRectification) {
  const StereoCalibration c = read(kByHand + kHandRectification + kHandQ, kMillimetres);
  ASSERT_TRUE(c.rectification.has_value());
  EXPECT_TRUE(c.rectification->R1.isIdentity(0));
  EXPECT_EQ(c.rectification->P1(0, 0), 400);
  EXPECT_EQ(c.rectification->P2(0, 2), 350);
  EXPECT_NEAR(c.rectification->P2(0, 3), -44, 1e-12);  // f B in px m
  EXPECT_TRUE(read(kByHand + kHandRectification, kMillimetres).rectification.has_value());
}

TEST_F(CalibrationFile, OpencvRectificationRefusals) {
  for (const char* name : {"R1", "R2", "P1", "P2"}) {
    const std::string key = std::string(name) + ":";
    expect_hand_refused(key, "X" + key, {key + " missing (give all of R1 R2 P1 P2 or none)"});
  }
  expect_hand_refused("R1: [[1, 0, 0]", "R1: [[1, 0.1, 0]", {"R1: not a rotation"});
  expect_hand_refused("R2: [[1, 0, 0]", "R2: [[-1, 0, 0]", {"R2: not a rotation"});
  expect_hand_refused("R2: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]", "R2: [[1, 0, 0], [0, 0.8, 0.6], [0, -0.6, 0.8]]",
                      {"R1: R2 R is not R1"});
  expect_hand_refused("P1: [[400", "P1: [[401", {"P1: focal lengths 401 and 400 differ"});
  expect_hand_refused("P2: [[400, 0, 350, -44000], [0, 400", "P2: [[401, 0, 350, -44110], [0, 401",
                      {"P2: focal length 401 is not the left camera's 400"});
  expect_hand_refused("-44000], [0, 400, 240", "-44000], [0, 400, 241",
                      {"P2: cy 241 is not the left camera's 240"});
  expect_hand_refused("P1: [[400, 0, 320, 0]", "P1: [[400, 0, 320, 1]", {"P1: ", "last column"});
  expect_hand_refused("P2: [[400, 0,", "P2: [[400, 1,", {"P2: not a rectified projection"});
  expect_hand_refused("-44000], [0, 400, 240, 0]", "0], [0, 400, 240, -44000]", {"P2: a vertical stereo rig"});
  expect_hand_refused("P1: [[400, 0, 320, 0], [0, 400", "P1: [[4, 0, 320, 0], [0, 4", {"P1: focal length 4 px"});
  expect_hand_refused("P1: [[400, 0, 320, 0]", "P1: [[400, 0, 320]", {"P1: its rows differ in length"});
  expect_hand_refused("P1: [[400, 0, 320, 0], [0, 400, 240, 0], [0, 0, 1, 0]]", "P1: [[400, 0], [0, 400]]",
                      {"P1: 2x2 numbers where 3x4 belong"});
  const auto baseline_refused = [this](const std::string& column, const Fragments& fragments) {
    expect_refused(kByHand + with(kHandRectification, "-44000", column), fragments, kMillimetres);
  };
  baseline_refused("-22000", {"P2: baseline 0.055 m contradicts", "0.11"});
  baseline_refused("44000", {"P2: baseline -0.11 m contradicts"});
}

TEST_F(CalibrationFile, OpencvQMustAgree) {
  const std::string without_q = kByHand + kHandRectification;
  for (const char* entry : {"-320", "-240", "400,", "0.0090", "0.2727"}) {
    const std::string q = with(kHandQ, entry, std::string(entry).insert(entry[0] == '-' ? 1 : 0, "1"));
    expect_refused(without_q + q, {"Q: contradicts P1 and P2"}, kMillimetres);
  }
  expect_refused(without_q + "Q: [1, 2]\n", {"Q: 1x2 numbers"}, kMillimetres);
  EXPECT_FALSE(read(kByHand + kHandQ, kMillimetres).rectification.has_value());
}

TEST_F(CalibrationFile, OpencvMissingKeys) {
  for (const std::string key : {"K1", "K2", "R", "T"}) {
    expect_refused(with(kOpencv, "\n" + key + ":", "\nX" + key + ":"), {key + ": missing", "intrinsics.yml"});
  }
}

TEST_F(CalibrationFile, OpencvMatrixRefusals) {
  const auto refused = [this](const std::string& from, const std::string& to, const Fragments& fragments) {
    expect_refused(with(kOpencv, from, to), fragments);
  };
  refused("rows: 3", "rows: 4", {"K1: data has not rows x cols numbers"});
  refused("rows: 3", "rows: 2000000000", {"K1: rows 2000000000 is not an integer in 0..64"});
  refused("rows: 3", "rows: -3", {"K1: rows -3"});
  refused("rows: 3", "rows: x", {"K1: 'x' is not a number"});
  refused("   rows: 3\n", "", {"K1: rows is missing"});
  refused("   cols: 3\n", "", {"K1: cols is missing"});
  refused("   cols: 3\n", "   cols: 3\n   cols: 3\n", {"K1: 'cols' is given twice"});
  refused("data:", "daten:", {"K1: data is missing"});
  refused("dt: d", "dt: \"3d\"", {"K1: element type '3d'"});
  refused("dt: d", "dt: [d]", {"K1: element type"});
  refused("0., 3.67", "[0.], 3.67", {"K1: ", "number"});
  refused("0., 3.67", "zero, 3.67", {"K1: 'zero' is not a number"});
  refused("0., 3.67", "0x10, 3.67", {"K1: '0x10' is not a number"});
  refused("0., 3.67", "+-1, 3.67", {"K1: '+-1' is not a number"});
  refused("rows: 3\n   cols: 1", "rows: 1\n   cols: 4", {"T: data has not rows x cols"});
  refused("R: !!opencv-matrix\n   rows: 3\n   cols: 3", "R: !!opencv-matrix\n   rows: 1\n   cols: 9",
          {"R: 1x9 numbers where 3x3 belong"});
  refused("image_size", "K1: 3\nimage_size", {"YAML: 'K1' is given twice"});
  refused("image_size", "M1: 3\nimage_size", {"M1: given besides K1"});
  refused("image_size", "[a, b]: 3\nimage_size", {"YAML: a key is not a name"});
  refused("image_size: [ 752, 480 ]", "image_size: [ 752, 480", {"YAML: line"});
  expect_refused("%YAML:1.0\n---\n- 1\n- 2\n", {"YAML: not a list of KEY: VALUE"});
  expect_refused("%YAML:1.0\n---\n", {"YAML: not a list of KEY: VALUE"});
}

TEST_F(CalibrationFile, OpencvAbsurdListsAreRefusedCheaply) {
  std::string ones = "[1";
  for (int i = 0; i < 20000; ++i)
    ones += ",1";
  ones += "]";
  expect_refused("K1: " + ones + "\n", {"K1: more than 64 entries"});
  std::string repeated = "row: &r " + ones + "\nK1: [*r";
  for (int i = 0; i < 60; ++i)
    repeated += ",*r";
  expect_refused(repeated + "]\n", {"K1: more than 64 entries"});
  expect_refused("K1: &self [*self, *self]\n", {"K1: "});
  expect_refused("%YAML:1.0\n" + std::string(100000, '['), {"YAML: line"});
  expect_refused("%YAML:1.0\n" + std::string(100000, '{'), {"YAML: line"});
}

TEST_F(CalibrationFile, OpencvCameraRefusals) {
  expect_hand_refused("K1: [[500", "K1: [[-500", {"K1: focal length -500 is not positive"});
  expect_hand_refused("K1: [[500", "K1: [[0", {"K1: focal length 0 is not positive"});
  expect_hand_refused("K1: [[500", "K1: [[9.9", {"K1: focal length 9.9 px is outside 10..100000"});
  expect_hand_refused("K1: [[500, 0, 320], [0, 500", "K1: [[500, 0, 320], [0, 100001",
                      {"K1: focal length 100001 px is outside"});
  expect_hand_refused("K1: [[500, 0,", "K1: [[500, 2,", {"K1: not a camera matrix without skew"});
  expect_hand_refused("[0, 0, 1]]\nK2", "[0, 0, 2]]\nK2", {"K1: not a camera matrix"});
  expect_refused(with(kOpencv, "3.6721499999999997e+02", "2633."), {"K1: principal point at 2633 px", "752"});
  expect_refused(with(kOpencv, "2.5523800000000000e+02", "-1201."), {"K2: principal point at -1201 px", "480"});
  EXPECT_EQ(read(with(kOpencv, "2.5523800000000000e+02", "-1200.")).right.cy, -1200);
}

TEST_F(CalibrationFile, OpencvPoseRefusals) {
  expect_hand_refused("R: [1", "R: [1.001", {"R: not a rotation", "off by 0.002"});
  expect_hand_refused("R: [1", "R: [-1", {"R: not a rotation", "determinant -1"});
  const auto refused = [this](const char* t, const Fragments& fragments) {
    expect_refused(with(kByHand, "[-110, 0, 0]", t), fragments, kMillimetres);
  };
  refused("[-10001, 0, 0]", {"T: baseline 10.001 m is outside 0.001..10 m", "camera.calibration_unit_m: 0.001"});
  refused("[-0.9, 0, 0]", {"T: baseline 0.0009 m is outside"});
  refused("[0, 0, 0]", {"T: baseline 0 m is outside"});
  refused("[-110, 111, 0]", {"T: ", "only a horizontal stereo rig"});
  refused("[-110, 0, -111]", {"T: ", "only a horizontal stereo rig"});
  refused("[110, 0, 0]", {"T: T_x is not negative: left and right are swapped"});
  refused("[-110, 0]", {"T: 1x2 numbers where 3x1 belong"});
  expect_refused(kByHand, {"T: baseline 110 m"});
}

TEST_F(CalibrationFile, Middlebury) {
  const StereoCalibration c = read(kMiddlebury, 5.0);  // the unit is for OpenCV files only
  EXPECT_TRUE(c.images_rectified);
  EXPECT_EQ(c.width, 741);
  EXPECT_EQ(c.height, 497);
  EXPECT_EQ(c.left.fx, 999.421);
  EXPECT_EQ(c.left.fy, 999.421);
  EXPECT_EQ(c.left.cx, 294.182);
  EXPECT_EQ(c.right.cx, 326.96);
  EXPECT_EQ(c.right.cy, 252.932);
  EXPECT_TRUE(c.R.isIdentity(0));
  EXPECT_NEAR(c.T.x(), -0.193001, 1e-15);
  EXPECT_EQ(c.T.y(), 0);
  EXPECT_FALSE(c.rectification.has_value());
}

TEST_F(CalibrationFile, MiddleburySpellings) {
  const StereoCalibration loose = read(
      "height = 497\r\n\r\n baseline\t= 193.001 \r\nwidth=741\r\n"
      "cam0 = [ 999.421, 0, 294.182 ;0 999.421 252.932; 0 0 1 ]\r\nsomething else\r\ndoffs=+32.778");
  EXPECT_NEAR(loose.right.cx, 326.96, 1e-9);  // no cam1: cam0 and doffs
  EXPECT_EQ(loose.height, 497);
  EXPECT_EQ(read(with(kMiddlebury, "doffs=32.778\n", "")).right.cx, 326.96);
  EXPECT_EQ(read(with(kMiddlebury, "doffs=32.778\n", "doffs=32.77\n")).right.cx, 326.96);
}

TEST_F(CalibrationFile, MiddleburyRefusals) {
  for (const std::string key : {"baseline", "width", "height", "cam0"}) {
    expect_middlebury_refused(key + "=", "x" + key + "=", {key + ": missing"});
  }
  expect_refused(with(with(kMiddlebury, "cam1=", "x="), "doffs=", "y="), {"cam1: missing"});
  expect_middlebury_refused("doffs=32.778", "doffs=32.8", {"doffs: 32.8", "32.778"});
  expect_middlebury_refused("doffs=32.778", "doffs=0", {"doffs: 0", "32.778"});
  expect_middlebury_refused("doffs=32.778", "doffs=", {"doffs: '' is not a number"});
  expect_middlebury_refused("doffs=32.778", "doffs=nan", {"doffs: 'nan' is not a finite number"});
  expect_middlebury_refused("193.001", "0.193", {"baseline: baseline 0.000193 m is outside", "millimetres"});
  expect_middlebury_refused("193.001", "193001", {"baseline: baseline 193.001 m is outside"});
  expect_middlebury_refused("193.001", "-193", {"baseline: "});
  expect_middlebury_refused("193.001", "193 mm", {"baseline: '193 mm' is not a number"});
  expect_middlebury_refused("741", "0", {"width: 0 is not an integer in 1..16384"});
  expect_middlebury_refused("497", "1e9", {"height: 1000000000 is not an integer"});
  expect_middlebury_refused("741", "741.5", {"width: 741.5"});
  expect_middlebury_refused("ndisp", "width", {"'width': given twice"});
}

TEST_F(CalibrationFile, MiddleburyCameraRefusals) {
  const auto refused = [this](const std::string& from, const std::string& to, const Fragments& fragments) {
    expect_middlebury_refused(from, to, fragments);
  };
  refused("0 999.421 252.932", "0 999.5 252.932", {"cam0: focal lengths 999.421 and 999.5 differ"});
  refused("cam1=[999.421 0 326.96; 0 999.421", "cam1=[999.5 0 326.96; 0 999.5",
          {"cam1: focal length 999.5 is not cam0's 999.421"});
  refused("326.96; 0 999.421 252.932", "326.96; 0 999.421 253", {"cam1: cy 253 is not cam0's"});
  refused("cam0=[999.421 0", "cam0=[999.421 1", {"cam0: not a camera matrix"});
  refused("cam0=[999.421 0 294.182; 0 999.421", "cam0=[-9 0 294.182; 0 -9",
          {"cam0: focal length -9 is not positive"});
  refused("294.182", "3000", {"cam0: principal point at 3000 px"});
  refused("cam0=[", "cam0=", {"cam0: ", "3x3 matrix"});
  refused("0 0 1]\ncam1", "0 0 1\ncam1", {"cam0: ", "3x3 matrix"});
  refused("0 0 1]", "0 0]", {"cam0: '' is not a number"});
  refused("0 0 1]", "0 0 1 1]", {"cam0: ", "3x3 matrix"});
  refused("0 0 1]", "0 0 1;]", {"cam0: ", "3x3 matrix"});
  refused("294.182;", "294.182", {"cam0: ", "3x3 matrix"});
  expect_refused(with(with(kMiddlebury, "cam1=", "x="), "32.778", "3000"), {"doffs: principal point at 3294.182"});
}

TEST_F(CalibrationFile, UnknownFormatsNameTheKnownOnes) {
  for (const std::string& text :
       {std::string("hello\n"), std::string("<?xml version=\"1.0\"?>\n<opencv_storage/>\n"),
        std::string(1000, '\0'), std::string("=\n:\n\n")}) {
    expect_refused(text, {"format: not a calibration that is known", "OpenCV stereo YAML", "Middlebury calib.txt",
                          "KITTI calib.txt", "EuRoC sensor.yaml", "ROS camera_info"});
  }
  expect_refused("%YAML:1.0\nsensor_type: camera\nP: {cols: 4}\n", {"K1: missing"});
}

TEST_F(CalibrationFile, FilesThatAreNone) {
  EXPECT_THROW(read_calibration(folder_.path("absent")), InputError);
  EXPECT_THROW(read_calibration(folder_.path("")), InputError);
  EXPECT_THROW(read(""), InputError);
  EXPECT_THROW(read(std::string((std::size_t{4} << 20) + 1, ' ')), InputError);
}

// Neither truncation nor a wrong byte may do more than be refused.
TEST_F(CalibrationFile, SurvivesTruncationAndDamage) {
  std::mt19937 random(5);
  const std::string by_hand = kByHand + kHandRectification + kHandQ;
  for (const std::string& text : {kOpencv, by_hand, kMiddlebury}) {
    for (std::size_t length = 1; length < text.size(); ++length)
      read_or_refuse(text.substr(0, length));
    for (int i = 0; i < 1000; ++i) {
      std::string damaged = text;
      const unsigned flips = 1 + static_cast<unsigned>(random() % 3);
      for (unsigned flip = 0; flip < flips; ++flip) {
        damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
      }
      read_or_refuse(damaged);
    }
  }
  EXPECT_GT(refusals_, 1000);
}

TEST_F(CalibrationFile, TruncatedInsideTheNeededPartIsRefused) {
  const std::size_t end_of_t = kOpencv.find(']', kOpencv.find("\nT:"));
  for (std::size_t length = 1; length <= end_of_t; ++length) {
    EXPECT_THROW(read(kOpencv.substr(0, length)), InputError) << length;
  }
  const std::size_t height = kMiddlebury.find("height=") + std::string("height=").size();
  for (std::size_t length = 1; length <= height; ++length) {
    EXPECT_THROW(read(kMiddlebury.substr(0, length)), InputError) << length;
  }
}

TEST(RequireImageSize, RefusesAnotherSize) {
  StereoCalibration c;
  c.source = "calib.yaml";
  EXPECT_NO_THROW(require_image_size(c, 1, 2, "left.png"));
  c.width = 640;
  c.height = 480;
  EXPECT_NO_THROW(require_image_size(c, 640, 480, "left.png"));
  EXPECT_THROW(require_image_size(c, 640, 481, "left.png"), InputError);
  try {
    require_image_size(c, 320, 240, "left.png");
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_EQ(
        std::string(e.what()),
        "left.png: image size: 320x240 is not the 640x480 of calib.yaml (use the calibration of these images)");
  }
}

TEST(CalibrationData, Motorcycle) {
  const std::string path = test::data_path("middlebury/motorcycle/calib.txt");
  if (path.empty()) GTEST_SKIP() << "no middlebury/motorcycle under LAKSHYA_DATA";
  const StereoCalibration c = read_calibration(path);
  EXPECT_NEAR(c.right.cx - c.left.cx, 32.778, 1e-9);
  EXPECT_NEAR(-c.T.x(), 0.193001, 1e-12);
  EXPECT_EQ(c.width, 741);
}

TEST(CalibrationData, Playground) {
  const std::string path = test::data_path("eth3d/playground/calib.txt");
  if (path.empty()) GTEST_SKIP() << "no eth3d/playground under LAKSHYA_DATA";
  const StereoCalibration c = read_calibration(path);
  EXPECT_EQ(c.left.fx, 542.019);
  EXPECT_EQ(c.right.cx, c.left.cx);
  EXPECT_NEAR(-c.T.x(), 0.0595549, 1e-12);
}

TEST(CalibrationData, Rendered) {
  const std::string path = test::data_path("rendered/s1/calib.txt");
  if (path.empty()) GTEST_SKIP() << "no rendered/s1 under LAKSHYA_DATA";
  const StereoCalibration c = read_calibration(path);
  EXPECT_EQ(c.left.fx, 420);
  EXPECT_EQ(c.T, Eigen::Vector3d(-0.12, 0, 0));
  EXPECT_EQ(c.height, 480);
}

TEST(CalibrationData, IntrinsicsAloneAreRefused) {
  const std::string path = test::data_path("chessboard_opencv/reference_intrinsics.yml");
  if (path.empty()) GTEST_SKIP() << "no chessboard_opencv under LAKSHYA_DATA";
  try {
    read_calibration(path);
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(": R: missing"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace lakshya

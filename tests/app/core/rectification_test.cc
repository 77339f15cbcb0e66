// Our rectification against OpenCV's, on real rigs and on random ones.
#include "app/core/rectification.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>

#include "app/core/calibration.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Projection = Eigen::Matrix<double, 3, 4>;

constexpr double kDegree = 3.14159265358979323846 / 180;

struct Rig {
  StereoCalibration calibration;
  int width = 0;
  int height = 0;
};

template <int kRows, int kCols>
cv::Mat to_cv(const Eigen::Matrix<double, kRows, kCols>& m) {
  cv::Mat out(kRows, kCols, CV_64F);
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kCols; ++c)
      out.at<double>(r, c) = m(r, c);
  }
  return out;
}

cv::Mat camera_matrix(const CameraModel& c) {
  return (cv::Mat_<double>(3, 3) << c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
}

cv::Mat distortion(const CameraModel& c) {
  cv::Mat d(1, 12, CV_64F);
  for (int i = 0; i < 12; ++i)
    d.at<double>(0, i) = c.distortion[static_cast<std::size_t>(i)];
  return d;
}

// EuRoC MAV rig (cam0, cam1): the sensors' T_BS are camera-to-body, so T_right_left = T_B1^-1 T_B0.
Rig euroc() {
  Eigen::Matrix4d body0;
  body0 << 0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216401454975, 0.999557249008, 0.0149672133247,
      0.025715529948, -0.064676986768, -0.0257744366974, 0.00375618835797, 0.999660727178, 0.00981073058949, 0, 0,
      0, 1;
  Eigen::Matrix4d body1;
  body1 << 0.0125552670891, -0.999755099723, 0.0182237714554, -0.0198435579556, 0.999598781151, 0.0130119051815,
      0.0251588363115, 0.0453689425024, -0.0253898008918, 0.0179005838253, 0.999517347078, 0.00786212447038, 0, 0,
      0, 1;
  const Eigen::Matrix4d t = body1.inverse() * body0;
  Rig rig{.calibration = {}, .width = 752, .height = 480};
  rig.calibration.source = "euroc";
  rig.calibration.left = {
      458.654, 457.296, 367.215, 248.375, {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05}};
  rig.calibration.right = {
      457.587, 456.134, 379.999, 255.238, {-0.28368365, 0.07451284, -0.00010473, -3.559070e-05}};
  rig.calibration.R = t.topLeftCorner<3, 3>();
  rig.calibration.T = t.topRightCorner<3, 1>();
  return rig;
}

// OpenCV's stereo chessboard set: reference result in squares of 25 mm.
Rig chessboard() {
  Rig rig{.calibration = {}, .width = 640, .height = 480};
  rig.calibration.source = "chessboard";
  rig.calibration.left = {533.56, 533.60, 342.53, 234.77, {-0.2887, 0.0936, 0.0012, -0.0001}};
  rig.calibration.right = {536.89, 536.48, 327.40, 249.95, {-0.2887, 0.0936, 0.0012, -0.0001}};
  const Vector3d turn = Vector3d(0.410, 0.245, -0.201) * kDegree;
  rig.calibration.R = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  rig.calibration.T = Vector3d(-3.327, 0.037, -0.005) * 0.025;
  return rig;
}

Rig ideal() {
  Rig rig{.calibration = {}, .width = 640, .height = 480};
  rig.calibration.source = "ideal";
  rig.calibration.left = {420, 420, 311.25, 243.5, {}};
  rig.calibration.right = rig.calibration.left;
  rig.calibration.T = Vector3d(-0.12, 0, 0);
  return rig;
}

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

enum class Model { kFour, kFive, kRational, kThinPrism };

CameraModel random_camera(std::mt19937& random, int width, int height, Model model) {
  CameraModel c;
  c.fx = width * uniform(random, 0.6, 1.5);
  c.fy = c.fx * uniform(random, 0.99, 1.01);
  c.cx = width * uniform(random, 0.45, 0.55);
  c.cy = height * uniform(random, 0.45, 0.55);
  auto& d = c.distortion;
  // As lenses are: the second radial term takes back a part of the first, so that the image does not fold.
  d[0] = uniform(random, -0.3, 0.1);
  d[1] = d[0] * d[0] * uniform(random, 0.8, 1.2);
  d[2] = uniform(random, -0.001, 0.001);
  d[3] = uniform(random, -0.001, 0.001);
  if (model != Model::kFour) d[4] = uniform(random, -0.02, 0.02);
  if (model == Model::kRational || model == Model::kThinPrism) {
    d[5] = uniform(random, -0.05, 0.05);
    d[6] = uniform(random, -0.02, 0.02);
    d[7] = uniform(random, -0.01, 0.01);
  }
  if (model == Model::kThinPrism) {
    for (std::size_t i = 8; i < 12; ++i)
      d[i] = uniform(random, -0.002, 0.002);
  }
  return c;
}

Rig random_rig(std::mt19937& random, Model model) {
  Rig rig;
  rig.width = std::uniform_int_distribution<int>(200, 1400)(random);
  rig.height = rig.width * 5 / 8 + std::uniform_int_distribution<int>(0, 60)(random);
  rig.calibration.source = "random";
  rig.calibration.left = random_camera(random, rig.width, rig.height, model);
  rig.calibration.right = random_camera(random, rig.width, rig.height, model);
  const Vector3d axis(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
  rig.calibration.R = Eigen::AngleAxisd(uniform(random, 0, 3) * kDegree, axis.normalized()).toRotationMatrix();
  rig.calibration.T =
      uniform(random, 0.03, 0.6) * Vector3d(-1, uniform(random, -0.05, 0.05), uniform(random, -0.05, 0.05));
  return rig;
}

struct Reference {
  cv::Mat R1, R2, P1, P2, Q;
};

Reference opencv_rectification(const Rig& rig) {
  const StereoCalibration& c = rig.calibration;
  Reference ref;
  cv::stereoRectify(camera_matrix(c.left), distortion(c.left), camera_matrix(c.right), distortion(c.right),
                    cv::Size(rig.width, rig.height), to_cv<3, 3>(c.R), to_cv<3, 1>(c.T), ref.R1, ref.R2, ref.P1,
                    ref.P2, ref.Q, cv::CALIB_ZERO_DISPARITY, 0);
  return ref;
}

template <int kCols>
double largest_difference(const Eigen::Matrix<double, 3, kCols>& a, const cv::Mat& b) {
  double worst = 0;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < kCols; ++c)
      worst = std::max(worst, std::abs(a(r, c) - b.at<double>(r, c)));
  }
  return worst;
}

void expect_as_opencv(const Rig& rig) {
  const Rectification ours = rectify_stereo(rig.calibration, rig.width, rig.height);
  const Reference ref = opencv_rectification(rig);
  EXPECT_LT(largest_difference<3>(ours.R1, ref.R1), 1e-6);
  EXPECT_LT(largest_difference<3>(ours.R2, ref.R2), 1e-6);
  EXPECT_LT(largest_difference<4>(ours.P1, ref.P1), 1e-3);
  EXPECT_LT(largest_difference<4>(ours.P2, ref.P2), 1e-3);
}

// Raw position in 1/128 px.
int map_x(const RectifyMaps& maps, int u, int v) {
  return maps.x.view().at(u, v) * kRectifyMapScale + rectify_fraction_x(maps.fraction.view().at(u, v));
}
int map_y(const RectifyMaps& maps, int u, int v) {
  return maps.y.view().at(u, v) * kRectifyMapScale + rectify_fraction_y(maps.fraction.view().at(u, v));
}

void expect_maps_as_opencv(const Rig& rig, const CameraModel& camera, const Matrix3d& R, const Projection& P) {
  const RectifyMaps maps = make_rectify_maps(camera, R, P, rig.width, rig.height);
  cv::Mat x;
  cv::Mat y;
  cv::initUndistortRectifyMap(camera_matrix(camera), distortion(camera), to_cv<3, 3>(R), to_cv<3, 4>(P),
                              cv::Size(rig.width, rig.height), CV_32FC1, x, y);
  double worst = 0;
  for (int v = 0; v < rig.height; ++v) {
    for (int u = 0; u < rig.width; ++u) {
      const double dx = map_x(maps, u, v) / static_cast<double>(kRectifyMapScale) - x.at<float>(v, u);
      const double dy = map_y(maps, u, v) / static_cast<double>(kRectifyMapScale) - y.at<float>(v, u);
      worst = std::max({worst, std::abs(dx), std::abs(dy)});
    }
  }
  EXPECT_LT(worst, 0.01);
}

void expect_both_maps_as_opencv(const Rig& rig) {
  const Rectification r = rectify_stereo(rig.calibration, rig.width, rig.height);
  expect_maps_as_opencv(rig, rig.calibration.left, r.R1, r.P1);
  expect_maps_as_opencv(rig, rig.calibration.right, r.R2, r.P2);
}

TEST(RectifyStereo, EurocRigIsAsOpencv) {
  const Rig rig = euroc();
  expect_as_opencv(rig);
  expect_both_maps_as_opencv(rig);
}

// The figures that the data set's documentation gives for OpenCV's rectification.
TEST(RectifyStereo, EurocGeometry) {
  const RectifiedGeometry g = rectified_geometry(euroc().calibration, 752, 480);
  EXPECT_EQ(g.width, 752);
  EXPECT_EQ(g.height, 480);
  EXPECT_NEAR(g.baseline_m, 0.11008, 1e-5);
  EXPECT_NEAR(g.focal_px, 436.235, 1e-3);
  EXPECT_NEAR(g.cx_left, 364.441, 1e-3);
  EXPECT_NEAR(g.cy, 256.952, 1e-3);
  EXPECT_EQ(g.doffs(), 0);
}

TEST(RectifyStereo, ChessboardRigIsAsOpencv) {
  const Rig rig = chessboard();
  expect_as_opencv(rig);
  expect_both_maps_as_opencv(rig);
  const Vector3d t = rig.calibration.T;
  EXPECT_NEAR(rectified_geometry(rig.calibration, rig.width, rig.height).baseline_m, t.norm(), 1e-9);
}

TEST(RectifyStereo, RandomRigsAreAsOpencv) {
  std::mt19937 random(20240229);
  constexpr Model kModels[] = {Model::kFour, Model::kFive, Model::kRational, Model::kThinPrism};
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE("rig " + std::to_string(i));
    expect_as_opencv(random_rig(random, kModels[i % 4]));
  }
}

TEST(RectifyStereo, NearlyRotationIsMadeOne) {
  Rig rig = euroc();
  for (double& value : rig.calibration.R.reshaped())
    value = std::round(value * 1000) / 1000;
  expect_as_opencv(rig);
}

TEST(RectifyStereo, IdealRigStaysAsItIs) {
  const Rig rig = ideal();
  const Rectification r = rectify_stereo(rig.calibration, rig.width, rig.height);
  EXPECT_TRUE(r.R1.isIdentity(1e-12));
  EXPECT_TRUE(r.R2.isIdentity(1e-12));
  Projection p1;
  p1 << 420, 0, 311.25, 0, 0, 420, 243.5, 0, 0, 0, 1, 0;
  Projection p2 = p1;
  p2(0, 3) = -420 * 0.12;
  EXPECT_TRUE(r.P1.isApprox(p1, 1e-12));
  EXPECT_TRUE(r.P2.isApprox(p2, 1e-12));
  expect_as_opencv(rig);
}

// What rectification is for: one point in space falls on one row of both images, at the disparity f B / z.
TEST(RectifyStereo, PointsFallOnOneRowAtTheRightDisparity) {
  std::mt19937 random(7);
  for (int i = 0; i < 100; ++i) {
    const Rig rig = random_rig(random, Model::kFive);
    const Rectification r = rectify_stereo(rig.calibration, rig.width, rig.height);
    const Vector3d left(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, 2, 20));
    const Vector3d right = rig.calibration.R * left + rig.calibration.T;
    const Vector3d pixel_left = r.P1 * (r.R1 * left).homogeneous();
    // P2 holds the baseline itself: it takes points of the left rectified frame.
    const Vector3d pixel_right = r.P2 * (r.R1 * left).homogeneous();
    const Vector3d seen_right = r.P2.leftCols<3>() * (r.R2 * right);
    EXPECT_NEAR((pixel_right.hnormalized() - seen_right.hnormalized()).norm(), 0, 1e-6);
    EXPECT_NEAR(pixel_left.hnormalized().y(), seen_right.hnormalized().y(), 1e-6);
    const double disparity = pixel_left.hnormalized().x() - seen_right.hnormalized().x();
    EXPECT_NEAR(disparity, r.P1(0, 0) * rig.calibration.T.norm() / (r.R1 * left).z(), 1e-6);
  }
}

// alpha 0: every rectified pixel shows a pixel that the camera has.
TEST(RectifyStereo, NoPixelLiesOutsideTheRawImage) {
  for (const Rig& rig : {euroc(), chessboard()}) {
    const Rectification r = rectify_stereo(rig.calibration, rig.width, rig.height);
    const RectifyMaps maps = make_rectify_maps(rig.calibration.left, r.R1, r.P1, rig.width, rig.height);
    const int slack =
        kRectifyMapScale / 2;  // the border is sampled, and the true border bulges between the samples
    for (int v = 0; v < rig.height; ++v) {
      for (int u = 0; u < rig.width; ++u) {
        ASSERT_GE(map_x(maps, u, v), -slack);
        ASSERT_GE(map_y(maps, u, v), -slack);
        ASSERT_LE(map_x(maps, u, v), (rig.width - 1) * kRectifyMapScale + slack);
        ASSERT_LE(map_y(maps, u, v), (rig.height - 1) * kRectifyMapScale + slack);
      }
    }
  }
}

void expect_refused(const Rig& rig, const std::string& fragment) {
  try {
    rectify_stereo(rig.calibration, rig.width, rig.height);
    ADD_FAILURE() << "accepted: " << fragment;
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(fragment), std::string::npos) << e.what();
  }
}

TEST(RectifyStereo, RefusesWhatHasNoRectification) {
  Rig swapped = euroc();
  swapped.calibration.T = -swapped.calibration.T;
  expect_refused(swapped, "not to the right");
  Rig backwards = ideal();
  backwards.calibration.R = Eigen::AngleAxisd(175 * kDegree, Vector3d::UnitX()).toRotationMatrix();
  expect_refused(backwards, "in front");
  Rig apart = ideal();
  apart.calibration.left.cx = -5000;
  expect_refused(apart, "no common rectangle");
  Rig overflow = ideal();
  overflow.calibration.left.distortion[2] = std::numeric_limits<double>::max();
  expect_refused(overflow, "no inverse");
  for (const int size : {0, -1, 16385}) {
    Rig absurd = ideal();
    absurd.width = size;
    expect_refused(absurd, "outside 1..16384");
    EXPECT_THROW(rectified_geometry(absurd.calibration, 640, size), InputError);
    EXPECT_THROW(
        make_rectify_maps(absurd.calibration.left, Matrix3d::Identity(), Projection::Identity(), size, 480),
        InputError);
  }
}

TEST(NeedsRemap, OnlyWhenTheRawImagesAreNotRectified) {
  EXPECT_FALSE(needs_remap(ideal().calibration));
  EXPECT_TRUE(needs_remap(euroc().calibration));

  StereoCalibration said = euroc().calibration;
  said.images_rectified = true;
  EXPECT_FALSE(needs_remap(said));

  StereoCalibration shifted = ideal().calibration;
  shifted.right.cx += 30;  // a horizontal shift is doffs, not a reason to remap
  EXPECT_FALSE(needs_remap(shifted));

  const auto with = [](auto change) {
    StereoCalibration c = ideal().calibration;
    change(c);
    return c;
  };
  EXPECT_TRUE(needs_remap(with([](auto& c) { c.left.distortion[0] = 1e-12; })));
  EXPECT_TRUE(needs_remap(with([](auto& c) { c.right.distortion[11] = 1e-12; })));
  EXPECT_TRUE(needs_remap(with([](auto& c) { c.left.fx += 1e-6; })));
  EXPECT_TRUE(needs_remap(with([](auto& c) { c.right.fx = c.right.fy = 421; })));
  EXPECT_TRUE(needs_remap(with([](auto& c) { c.right.cy += 1e-6; })));
  EXPECT_TRUE(needs_remap(with([](auto& c) { c.T.y() = 1e-6; })));
  EXPECT_TRUE(needs_remap(with([](auto& c) { c.T.z() = 1e-6; })));
  EXPECT_TRUE(needs_remap(with([](auto& c) { c.R(0, 1) = 1e-6; })));
}

TEST(RectifiedGeometry, OfRectifiedImagesIsTheCameras) {
  StereoCalibration c = ideal().calibration;
  c.right.cx += 32.778;
  const RectifiedGeometry g = rectified_geometry(c, 640, 480);
  EXPECT_EQ(g.focal_px, 420);
  EXPECT_EQ(g.cx_left, 311.25);
  EXPECT_EQ(g.cy, 243.5);
  EXPECT_EQ(g.baseline_m, 0.12);
  EXPECT_NEAR(g.doffs(), 32.778, 1e-9);
}

TEST(RectifiedGeometry, OfTheFilesRectificationComesFirst) {
  StereoCalibration c = euroc().calibration;
  Rectification given;
  given.P1 << 400, 0, 350, 0, 0, 400, 240, 0, 0, 0, 1, 0;
  given.P2 << 400, 0, 360, -44, 0, 400, 240, 0, 0, 0, 1, 0;
  c.rectification = given;
  const RectifiedGeometry g = rectified_geometry(c, 752, 480);
  EXPECT_EQ(g.focal_px, 400);
  EXPECT_EQ(g.cx_left, 350);
  EXPECT_EQ(g.cx_right, 360);
  EXPECT_EQ(g.doffs(), 10);
  EXPECT_EQ(g.cy, 240);
  EXPECT_NEAR(g.baseline_m, 0.11, 1e-15);
}

// x = 0.5, y = 0 with k1 = 0.1 only: r2 = 0.25, factor 1.025, u = 100 * 0.5125 + 50.
TEST(RawPixel, HandComputed) {
  CameraModel camera{.fx = 100, .fy = 200, .cx = 50, .cy = 60};
  Projection p;
  p << 10, 0, 20, 0, 0, 10, 30, 0, 0, 0, 1, 0;
  const Matrix3d identity = Matrix3d::Identity();
  EXPECT_TRUE(raw_pixel(camera, identity, p, 25, 30).isApprox(Vector2d(100, 60), 1e-12));
  camera.distortion[0] = 0.1;
  EXPECT_TRUE(raw_pixel(camera, identity, p, 25, 30).isApprox(Vector2d(101.25, 60), 1e-12));
  // p1 = 0.01 adds (2 p1 x y, p1 (r2 + 2 y2)) = (0, 0.0025); p2 = 0.02 adds (p2 (r2 + 2 x2), 2 p2 x y) = (0.015,
  // 0).
  camera.distortion[2] = 0.01;
  camera.distortion[3] = 0.02;
  EXPECT_TRUE(raw_pixel(camera, identity, p, 25, 30).isApprox(Vector2d(102.75, 60.5), 1e-12));
  // 100 degrees about y: the rectified centre looks behind the camera.
  const Matrix3d turned = Eigen::AngleAxisd(100 * kDegree, Vector3d::UnitY()).toRotationMatrix();
  EXPECT_EQ(raw_pixel(camera, turned, p, 20, 30), Vector2d::Constant(kRectifyMapMinPx));
}

TEST(Undistort, InvertsTheDistortion) {
  std::mt19937 random(3);
  Projection identity = Projection::Identity();
  for (int i = 0; i < 200; ++i) {
    CameraModel camera = random_camera(random, 640, 480, Model::kThinPrism);
    camera.distortion[0] = uniform(random, -0.05, 0.05);
    const Vector2d ideal_point(uniform(random, -0.4, 0.4), uniform(random, -0.3, 0.3));
    const Vector2d raw = raw_pixel(camera, Matrix3d::Identity(), identity, ideal_point.x(), ideal_point.y());
    EXPECT_LT((undistort_normalized(camera, raw.x(), raw.y()) - ideal_point).norm(), 1e-5);
  }
}

TEST(Undistort, FoldedDistortionReturnsTheDistortedPoint) {
  const CameraModel camera{.fx = 100, .fy = 100, .cx = 0, .cy = 0, .distortion = {-4}};
  EXPECT_TRUE(undistort_normalized(camera, 100, 0).isApprox(Vector2d(1, 0)));
}

TEST(RectifyMaps, AreRoundedAndClamped) {
  CameraModel camera{.fx = 1, .fy = 1, .cx = 0, .cy = 0};
  Projection p = Projection::Identity();
  camera.cx = 0.25 + 0.6 / kRectifyMapScale;
  camera.cy = -1e9;
  const RectifyMaps low = make_rectify_maps(camera, Matrix3d::Identity(), p, 2, 1);
  EXPECT_EQ(map_x(low, 0, 0), 33);
  EXPECT_EQ(map_x(low, 1, 0), 33 + kRectifyMapScale);
  EXPECT_EQ(map_y(low, 0, 0), kRectifyMapMinPx * kRectifyMapScale);
  camera.cy = 1e300;
  camera.cx = std::numeric_limits<double>::quiet_NaN();
  const RectifyMaps high = make_rectify_maps(camera, Matrix3d::Identity(), p, 1, 1);
  EXPECT_EQ(map_y(high, 0, 0), kRectifyMapMaxPx * kRectifyMapScale);
  EXPECT_EQ(map_x(high, 0, 0), kRectifyMapMinPx * kRectifyMapScale);
}

TEST(RectifyMaps, AllDistortionModelsAreAsOpencv) {
  std::mt19937 random(11);
  for (const Model model : {Model::kFour, Model::kFive, Model::kRational, Model::kThinPrism}) {
    SCOPED_TRACE(static_cast<int>(model));
    expect_both_maps_as_opencv(random_rig(random, model));
  }
}

}  // namespace
}  // namespace lakshya

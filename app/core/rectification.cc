#include "app/core/rectification.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "app/core/input_error.h"

namespace lakshya {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Projection = Eigen::Matrix<double, 3, 4>;

constexpr int kMaxSize = 16384;
constexpr int kUndistortRounds = 5;
constexpr int kBorderSamples = 9;
constexpr double kIdeal = 1e-9;

struct Distortion {
  double radial = 1;
  Vector2d tangential = Vector2d::Zero();  // and thin prism
};

Distortion distortion_at(const CameraModel& camera, const Vector2d& p) {
  const auto& [k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4] = camera.distortion;
  const double x = p.x();
  const double y = p.y();
  const double r2 = x * x + y * y;
  Distortion d;
  d.radial = (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1 + r2 * (k4 + r2 * (k5 + r2 * k6)));
  d.tangential.x() = 2 * p1 * x * y + p2 * (r2 + 2 * x * x) + r2 * (s1 + r2 * s2);
  d.tangential.y() = p1 * (r2 + 2 * y * y) + 2 * p2 * x * y + r2 * (s3 + r2 * s4);
  return d;
}

Vector2d distorted_pixel(const CameraModel& camera, const Vector2d& ideal) {
  const Distortion d = distortion_at(camera, ideal);
  const Vector2d p = ideal * d.radial + d.tangential;
  return {camera.fx * p.x() + camera.cx, camera.fy * p.y() + camera.cy};
}

bool undistorted(const CameraModel& camera) {
  return std::all_of(camera.distortion.begin(), camera.distortion.end(), [](double k) { return k == 0; });
}

bool near(double a, double b) {
  return std::abs(a - b) <= kIdeal;
}

[[noreturn]] void refuse(const StereoCalibration& calibration, const std::string& reason) {
  throw InputError(calibration.source, "rectification: " + reason);
}

void require_size(const std::string& source, int width, int height) {
  if (width >= 1 && height >= 1 && width <= kMaxSize && height <= kMaxSize) return;
  throw InputError(source, "image size: " + std::to_string(width) + "x" + std::to_string(height) +
                               " is outside 1..16384 (give the size of the camera's images)");
}

// A rotation that a file states with few digits is only nearly one.
Matrix3d nearest_rotation(const Matrix3d& m) {
  const Eigen::JacobiSVD<Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

void align_epipoles(const StereoCalibration& calibration, Rectification& result) {
  const Eigen::AngleAxisd whole(nearest_rotation(calibration.R));
  const Matrix3d half = Eigen::AngleAxisd(whole.angle() / 2, whole.axis()).toRotationMatrix();
  const Vector3d baseline = half.transpose() * calibration.T;
  if (!(-baseline.x() > baseline.tail<2>().cwiseAbs().maxCoeff())) {
    refuse(calibration, "the right camera is not to the right of the left one (check R and T)");
  }
  const Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(baseline, -Vector3d::UnitX()).toRotationMatrix();
  result.R1 = turn * half;
  result.R2 = turn * half.transpose();
}

// Rectified image coordinates of a raw pixel for focal length 1 and principal point (0, 0).
Vector2d rectified_point(const StereoCalibration& calibration, const CameraModel& camera, const Matrix3d& R,
                         double u, double v) {
  const Vector2d ideal = undistort_normalized(camera, u, v);
  if (!((distorted_pixel(camera, ideal) - Vector2d(u, v)).norm() <= kMaxSize)) {
    refuse(calibration, "the distortion has no inverse at the image border (calibrate again)");
  }
  const Vector3d ray = R * ideal.homogeneous();
  if (!(ray.z() > 0)) {
    refuse(calibration,
           "a camera's image does not lie in front of the rectified pair (check R and the distortion)");
  }
  return ray.hnormalized();
}

Vector2d mean_corner(const StereoCalibration& calibration, const CameraModel& camera, const Matrix3d& R, int width,
                     int height) {
  Vector2d sum = Vector2d::Zero();
  for (const int v : {0, height - 1}) {
    for (const int u : {0, width - 1})
      sum += rectified_point(calibration, camera, R, u, v);
  }
  return sum / 4;
}

struct Box {
  double left = -std::numeric_limits<double>::infinity();
  double top = -std::numeric_limits<double>::infinity();
  double right = std::numeric_limits<double>::infinity();
  double bottom = std::numeric_limits<double>::infinity();
};

// Largest upright rectangle inside the rectified border of the raw image (focal length 1, principal point (0, 0)).
Box inner_box(const StereoCalibration& calibration, const CameraModel& camera, const Matrix3d& R, int width,
              int height) {
  const int last = kBorderSamples - 1;
  Box box;
  for (int i = 0; i <= last; ++i) {
    const double u = static_cast<double>(i) * width / last;
    const double v = static_cast<double>(i) * height / last;
    box.left = std::max(box.left, rectified_point(calibration, camera, R, 0, v).x());
    box.right = std::min(box.right, rectified_point(calibration, camera, R, width, v).x());
    box.top = std::max(box.top, rectified_point(calibration, camera, R, u, 0).y());
    box.bottom = std::min(box.bottom, rectified_point(calibration, camera, R, u, height).y());
  }
  return box;
}

// Least focal length with which the box covers (0, 0)..(width, height) around principal point c.
double covering_focal(const Box& box, const Vector2d& c, int width, int height) {
  return std::max(
      {c.x() / -box.left, c.y() / -box.top, (width - c.x()) / box.right, (height - c.y()) / box.bottom});
}

Projection projection(double focal, const Vector2d& c, double baseline) {
  Projection p = Projection::Zero();
  p(0, 0) = p(1, 1) = focal;
  p(0, 2) = c.x();
  p(1, 2) = c.y();
  p(0, 3) = -focal * baseline;
  p(2, 2) = 1;
  return p;
}

// NaN becomes the lower bound: outside every image.
std::int32_t to_map(double px) {
  if (!(px > kRectifyMapMinPx)) return kRectifyMapMinPx * kRectifyMapScale;
  if (px > kRectifyMapMaxPx) return kRectifyMapMaxPx * kRectifyMapScale;
  return static_cast<std::int32_t>(std::lround(px * kRectifyMapScale));
}

}  // namespace

bool needs_remap(const StereoCalibration& calibration) {
  if (calibration.images_rectified) return false;
  const CameraModel& l = calibration.left;
  const CameraModel& r = calibration.right;
  const bool same_pinhole = undistorted(l) && undistorted(r) && near(l.fx, l.fy) && near(r.fx, r.fy) &&
                            near(l.fx, r.fx) && near(l.cy, r.cy);
  const bool parallel = (calibration.R - Matrix3d::Identity()).cwiseAbs().maxCoeff() <= kIdeal &&
                        calibration.T.x() < 0 && near(calibration.T.y(), 0) && near(calibration.T.z(), 0);
  return !(same_pinhole && parallel);
}

Rectification rectify_stereo(const StereoCalibration& calibration, int width, int height) {
  require_size(calibration.source, width, height);
  const CameraModel& l = calibration.left;
  const CameraModel& r = calibration.right;
  Rectification result;
  align_epipoles(calibration, result);

  const double focal0 = (l.fy + r.fy) / 2;
  const Vector2d mean = (mean_corner(calibration, l, result.R1, width, height) +
                         mean_corner(calibration, r, result.R2, width, height)) /
                        2;
  const Vector2d centre = Vector2d(width - 1, height - 1) / 2 - focal0 * mean;

  const Box left = inner_box(calibration, l, result.R1, width, height);
  const Box right = inner_box(calibration, r, result.R2, width, height);
  const Box both{std::max(left.left, right.left), std::max(left.top, right.top), std::min(left.right, right.right),
                 std::min(left.bottom, right.bottom)};
  if (!(both.left < 0 && both.top < 0 && both.right > 0 && both.bottom > 0)) {
    refuse(calibration, "the two views have no common rectangle (check R and the distortion)");
  }
  const double focal = covering_focal(both, centre, width, height);
  if (!(std::isfinite(focal) && focal > 0)) {
    refuse(calibration, "no focal length fits both views (check the distortion and the image size)");
  }
  result.P1 = projection(focal, centre, 0);
  result.P2 = projection(focal, centre, calibration.T.norm());
  return result;
}

RectifiedGeometry rectified_geometry(const StereoCalibration& calibration, int width, int height) {
  require_size(calibration.source, width, height);
  RectifiedGeometry g;
  g.width = width;
  g.height = height;
  if (!needs_remap(calibration)) {
    g.focal_px = calibration.left.fx;
    g.cx_left = calibration.left.cx;
    g.cx_right = calibration.right.cx;
    g.cy = calibration.left.cy;
    g.baseline_m = calibration.T.norm();
    return g;
  }
  const Rectification rectification =
      calibration.rectification ? *calibration.rectification : rectify_stereo(calibration, width, height);
  g.focal_px = rectification.P1(0, 0);
  g.cx_left = rectification.P1(0, 2);
  g.cx_right = rectification.P2(0, 2);
  g.cy = rectification.P1(1, 2);
  g.baseline_m = -rectification.P2(0, 3) / rectification.P2(0, 0);
  return g;
}

Vector2d undistort_normalized(const CameraModel& camera, double u, double v) {
  const Vector2d distorted((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy);
  Vector2d ideal = distorted;
  for (int round = 0; round < kUndistortRounds; ++round) {
    const Distortion d = distortion_at(camera, ideal);
    if (!(d.radial > 0)) return Vector2d(distorted);
    ideal = (distorted - d.tangential) / d.radial;
  }
  return ideal;
}

Vector2d raw_pixel(const CameraModel& camera, const Matrix3d& R_inverse, const Projection& P, double u, double v) {
  const Vector3d ray = R_inverse * Vector3d((u - P(0, 2)) / P(0, 0), (v - P(1, 2)) / P(1, 1), 1);
  if (!(ray.z() > 0)) return Vector2d::Constant(kRectifyMapMinPx);
  return distorted_pixel(camera, ray.hnormalized());
}

RectifyMaps make_rectify_maps(const CameraModel& camera, const Matrix3d& R, const Projection& P, int width,
                              int height) {
  require_size("rectify maps", width, height);
  const Matrix3d R_inverse = R.inverse();
  RectifyMaps maps{Image<std::int16_t>(width, height), Image<std::int16_t>(width, height),
                   Image<std::uint16_t>(width, height)};
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const Vector2d raw = raw_pixel(camera, R_inverse, P, u, v);
      const std::int32_t x = to_map(raw.x());
      const std::int32_t y = to_map(raw.y());
      maps.x.view().at(u, v) = static_cast<std::int16_t>(x >> kRectifyFractionBits);
      maps.y.view().at(u, v) = static_cast<std::int16_t>(y >> kRectifyFractionBits);
      maps.fraction.view().at(u, v) = rectify_fraction(x & (kRectifyMapScale - 1), y & (kRectifyMapScale - 1));
    }
  }
  return maps;
}

}  // namespace lakshya

#include "app/tools/bench_input.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "app/core/image_file.h"
#include "app/core/input_error.h"
#include "app/core/rectification.h"
#include "app/tools/bench_scene.h"
#include "app/tools/opencv_matchers.h"

namespace lakshya {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kUnitBaseline = 1;

// Lenses as they are sold with such rigs; the distortion is that of EuRoC's left camera, rounded.
CameraModel wide_lens(int width, int height, double off_center) {
  CameraModel camera;
  camera.fx = camera.fy = 0.62 * width;
  camera.cx = 0.5 * width + off_center;
  camera.cy = 0.5 * height - off_center;
  camera.distortion = {-0.28, 0.07, 0.0002, -0.0003};
  return camera;
}

StereoCalibration make_rig(int width, int height, double baseline_m) {
  constexpr double kHalfDegree = 0.0087;
  StereoCalibration rig;
  rig.source = "bench rig";
  rig.width = width;
  rig.height = height;
  rig.left = wide_lens(width, height, 0.006 * width);
  rig.right = wide_lens(width, height, -0.004 * width);
  rig.R = AngleAxisd(kHalfDegree, Vector3d(0.6, -0.64, 0.48)).toRotationMatrix();
  rig.T = baseline_m * Vector3d(-1, 0.01, -0.01).normalized();
  return rig;
}

double bilinear(const ImageView<const std::uint8_t>& image, const Vector2d& at) {
  const double x = std::clamp(at.x(), 0.0, image.width - 1.0);
  const double y = std::clamp(at.y(), 0.0, image.height - 1.0);
  const int u = static_cast<int>(x);
  const int v = static_cast<int>(y);
  const double a = x - u;
  const double b = y - v;
  const double top = (1 - a) * image.at(u, v) + a * at_repeated(image, u + 1, v);
  const double bottom = (1 - a) * at_repeated(image, u, v + 1) + a * at_repeated(image, u + 1, v + 1);
  return (1 - b) * top + b * bottom;
}

// What the lens would have taken: rectification turned round. Beyond the rectified image its border is repeated.
Image<std::uint8_t> raw_image(const Image<std::uint8_t>& rectified, const CameraModel& camera, const Matrix3d& R,
                              const Eigen::Matrix<double, 3, 4>& P) {
  Image<std::uint8_t> raw(rectified.width(), rectified.height());
  for (int v = 0; v < raw.height(); ++v) {
    for (int u = 0; u < raw.width(); ++u) {
      const Vector3d ray = R * undistort_normalized(camera, u, v).homogeneous();
      const Vector2d at = P(0, 0) * ray.hnormalized() + Vector2d(P(0, 2), P(1, 2));
      raw.view().at(u, v) = static_cast<std::uint8_t>(std::lround(bilinear(std::as_const(rectified).view(), at)));
    }
  }
  return raw;
}

// Columns first_u .. first_u + columns - 1, cropped about their middle to the shape width : height, then scaled.
Image<std::uint8_t> fitted(const Image<std::uint8_t>& image, int first_u, int columns, int width, int height) {
  const double scale = std::min(static_cast<double>(columns) / width, static_cast<double>(image.height()) / height);
  const int crop_width = std::clamp(static_cast<int>(std::lround(scale * width)), 1, columns);
  const int crop_height = std::clamp(static_cast<int>(std::lround(scale * height)), 1, image.height());
  const cv::Rect crop(first_u + (columns - crop_width) / 2, (image.height() - crop_height) / 2, crop_width,
                      crop_height);
  Image<std::uint8_t> out(width, height);
  cv::resize(opencv_view(image)(crop), opencv_view(out), {width, height}, 0, 0, cv::INTER_AREA);
  return out;
}

void read_pair(const BenchPair& pair, int width, int height, BenchInput& input) {
  const Image<std::uint8_t> left = read_gray(pair.left);
  const Image<std::uint8_t> right = read_gray(pair.right);
  if (!same_size(left.view(), right.view())) {
    throw InputError(pair.right, "its size differs from the left image's (give both images of one pair)");
  }
  const int columns = left.width() - std::abs(pair.shift);
  if (columns < left.width() / 2) {
    throw InputError(pair.left, "shift " + std::to_string(pair.shift) + " takes more than half of the image's " +
                                    std::to_string(left.width()) + " columns");
  }
  input.left = fitted(left, std::max(pair.shift, 0), columns, width, height);
  input.right = fitted(right, std::max(-pair.shift, 0), columns, width, height);
}

}  // namespace

BenchInput make_bench_input(int width, int height, int disparities, const BenchPair& pair) {
  const RectifiedGeometry unit = rectified_geometry(make_rig(width, height, kUnitBaseline), width, height);
  const double baseline_m = 0.9 * disparities * kBenchNearestM / unit.focal_px;
  BenchInput input;
  input.calibration = make_rig(width, height, baseline_m);
  if (pair.left.empty()) {
    const RectifiedGeometry geometry = rectified_geometry(input.calibration, width, height);
    input.left = render_bench_scene(geometry, BenchCamera::left);
    input.right = render_bench_scene(geometry, BenchCamera::right);
  } else {
    read_pair(pair, width, height, input);
  }
  const Rectification r = rectify_stereo(input.calibration, width, height);
  input.raw_left = raw_image(input.left, input.calibration.left, r.R1, r.P1);
  input.raw_right = raw_image(input.right, input.calibration.right, r.R2, r.P2);
  return input;
}

}  // namespace lakshya

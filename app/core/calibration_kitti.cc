#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "app/core/calibration_readers.h"

namespace lakshya {
namespace {

using Eigen::Vector3d;

constexpr int kCameras = 4;
constexpr double kOutOfRow = 0.02;  // of the baseline; KITTI's own colour pair has 0.006

constexpr const char* kHint =
    "a KITTI calibration has a line of 12 numbers for each camera: P0: .. P3: in calib.txt, P_rect_00: .. in "
    "calib_cam_to_cam.txt";

// Some copies of the odometry set leave the names out: line k is camera k.
std::string labelled(std::string_view text, const std::string& source) {
  std::string out;
  int camera = 0;
  for_each_line(text, [&](std::string_view line) {
    if (trimmed(line).empty()) return;
    if (camera == kCameras) {
      InputKey{source, "P4"}.refuse("more than 4 lines of numbers: a list of poses? (" + std::string(kHint) + ")");
    }
    out += "P" + std::to_string(camera++) + ": " + std::string(line) + "\n";
  });
  return out;
}

template <std::size_t kCount>
std::array<double, kCount> parse_numbers(const InputKey& key, std::string_view text) {
  std::array<double, kCount> numbers{};
  std::size_t found = 0;
  for (std::string_view rest = trimmed(text); !rest.empty(); ++found) {
    const std::size_t end = rest.find_first_of(" \t,");
    if (found < kCount) numbers[found] = parse_number(key, rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view{} : trimmed(rest.substr(end + 1));
  }
  if (found != kCount) {
    key.refuse(std::to_string(found) + " numbers where " + std::to_string(kCount) + " belong (" + kHint + ")");
  }
  return numbers;
}

std::string projection_key(const CalibrationLines& lines, int camera) {
  const std::string rectified = "P_rect_0" + std::to_string(camera);
  return lines.has(rectified) ? rectified : "P" + std::to_string(camera);
}

// S_rect_0k: width and height of the rectified images; calib.txt has none.
void read_size(const CalibrationLines& lines, int camera, StereoCalibration& calibration) {
  const std::string name = "S_rect_0" + std::to_string(camera);
  if (!lines.has(name)) return;
  const auto size = parse_numbers<2>(lines.key(name), lines.at(name));
  const int width = require_side(lines.key(name), size[0]);
  const int height = require_side(lines.key(name), size[1]);
  if (calibration.width != 0) {
    require_size_of_left(lines.key(name), calibration.width, calibration.height, width, height);
  }
  calibration.width = width;
  calibration.height = height;
}

struct KittiCamera {
  Projection p;          // last column zero
  Vector3d translation;  // from the reference camera's frame to this one's, m
};

KittiCamera read_camera(const CalibrationLines& lines, int camera, StereoCalibration& calibration) {
  const std::string name = projection_key(lines, camera);
  const InputKey key = lines.key(name);
  const auto numbers = parse_numbers<12>(key, lines.at(name));
  KittiCamera read;
  read.p = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(numbers.data());
  const Vector3d offset = read.p.col(3);
  read.p.col(3).setZero();
  read_size(lines, camera, calibration);
  require_projection(key, read.p, calibration.width, calibration.height);
  // P = K [I t]: t = K^-1 P e4.
  read.translation = {(offset.x() - read.p(0, 2) * offset.z()) / read.p(0, 0),
                      (offset.y() - read.p(1, 2) * offset.z()) / read.p(1, 1), offset.z()};
  return read;
}

}  // namespace

StereoCalibration parse_kitti_calibration(std::string_view text, const std::string& source, CameraNumbers cameras) {
  const std::string named = text.find(':') == std::string_view::npos ? labelled(text, source) : std::string(text);
  const CalibrationLines lines(named, source, ':', kHint);
  StereoCalibration calibration;
  calibration.source = source;
  calibration.images_rectified = true;
  const KittiCamera left = read_camera(lines, cameras.left, calibration);
  const KittiCamera right = read_camera(lines, cameras.right, calibration);
  const InputKey key = lines.key(projection_key(lines, cameras.right));
  require_same_rows(key, left.p, right.p);
  const Vector3d t = right.translation - left.translation;
  require_side_by_side(key, t, "KITTI's last column is metres times focal length; give two different cameras");
  if (t.tail<2>().cwiseAbs().maxCoeff() > kOutOfRow * -t.x()) {
    key.refuse("the cameras are offset by " + shown(t.y()) + " m in height and " + shown(t.z()) +
               " m in depth: not a rectified pair (take both cameras from one calibration)");
  }
  calibration.left = camera_of(left.p.leftCols<3>());
  calibration.right = camera_of(right.p.leftCols<3>());
  calibration.T.x() = t.x();
  return calibration;
}

}  // namespace lakshya

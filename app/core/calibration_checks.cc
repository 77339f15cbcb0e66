#include "app/core/calibration_checks.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace lakshya {
namespace {

constexpr double kMaxSide = 16384;
constexpr double kMinFocalPx = 10;
constexpr double kMaxFocalPx = 100000;
constexpr double kMaxOffCentre = 3;  // image sizes
constexpr double kMinBaselineM = 0.001;
constexpr double kMaxBaselineM = 10;
constexpr double kRotationTolerance = 1e-3;
constexpr double kSamePixel = 1e-3;
constexpr double kMaxSkewPx = 1e-6;

void require_focal(const InputKey& key, double focal) {
  if (!(focal > 0)) {
    key.refuse("focal length " + shown(focal) + " is not positive (calibrate again or fix the sign)");
  }
  if (focal < kMinFocalPx || focal > kMaxFocalPx) {
    key.refuse("focal length " + shown(focal) + " px is outside 10..100000 (it is in pixels, not in millimetres)");
  }
}

void require_near_image(const InputKey& key, double coordinate, int side) {
  if (side == 0 || std::abs(coordinate - side / 2.0) <= kMaxOffCentre * side) return;
  key.refuse("principal point at " + shown(coordinate) + " px is more than 3 image sizes from the centre of " +
             std::to_string(side) + " px (calibrate again or fix the size)");
}

// "0, 4 or 5"
std::string alternatives(std::initializer_list<std::size_t> counts) {
  std::string out;
  for (const std::size_t& count : counts) {
    if (!out.empty()) out += &count + 1 == counts.end() ? " or " : ", ";
    out += std::to_string(count);
  }
  return out;
}

}  // namespace

CalibrationLines::CalibrationLines(std::string_view text, const std::string& source, char separator,
                                   std::string hint)
    : source_(source), hint_(std::move(hint)) {
  for_each_line(text, [&](std::string_view line) {
    const std::size_t at = line.find(separator);
    if (at == std::string_view::npos) return;
    const std::string name(trimmed(line.substr(0, at)));
    if (!values_.emplace(name, trimmed(line.substr(at + 1))).second) {
      key(shown(name)).refuse("given twice (keep one)");
    }
  });
}

std::string_view CalibrationLines::at(const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) key(name).refuse("missing (" + hint_ + ")");
  return found->second;
}

int require_side(const InputKey& key, double value) {
  if (value >= 1 && value <= kMaxSide && value == std::floor(value)) return static_cast<int>(value);
  key.refuse(shown(value) + " is not an integer in 1..16384 (give the image size in pixels)");
}

void require_plausible(const InputKey& key, const CameraModel& camera, int width, int height) {
  require_focal(key, camera.fx);
  require_focal(key, camera.fy);
  require_near_image(key, camera.cx, width);
  require_near_image(key, camera.cy, height);
}

void require_plausible_baseline(const InputKey& key, double metres, const std::string& what_to_do) {
  if (metres >= kMinBaselineM && metres <= kMaxBaselineM) return;
  key.refuse("baseline " + shown(metres) + " m is outside 0.001..10 m (" + what_to_do + ")");
}

void require_side_by_side(const InputKey& key, const Eigen::Vector3d& t, const std::string& what_to_do) {
  require_plausible_baseline(key, t.norm(), what_to_do);
  if (t.tail<2>().cwiseAbs().maxCoeff() > std::abs(t.x())) {
    key.refuse(
        "the right camera is mainly above, below, before or behind the left one: only a horizontal stereo "
        "rig is supported (mount the cameras side by side)");
  }
  if (t.x() >= 0) key.refuse("T_x is not negative: left and right are swapped (exchange the cameras)");
}

void require_rotation(const InputKey& key, const Eigen::Matrix3d& r) {
  const double off = (r * r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (off <= kRotationTolerance && r.determinant() > 0) return;
  key.refuse("not a rotation: R R^T is off by " + shown(off) + ", determinant " + shown(r.determinant()) +
             " (write the 3x3 matrix with all its digits)");
}

void set_distortion(const InputKey& key, const std::vector<double>& values,
                    std::initializer_list<std::size_t> counts, CameraModel& camera) {
  if (std::find(counts.begin(), counts.end(), values.size()) == counts.end()) {
    key.refuse(std::to_string(values.size()) + " coefficients where " + alternatives(counts) +
               " belong (calibrate again)");
  }
  if (std::any_of(values.begin() + static_cast<std::ptrdiff_t>(std::min(values.size(), camera.distortion.size())),
                  values.end(), [](double tilt) { return tilt != 0; })) {
    key.refuse("a tilted sensor (tau_x, tau_y) is not supported (calibrate without the tilted model)");
  }
  std::copy_n(values.begin(), std::min(values.size(), camera.distortion.size()), camera.distortion.begin());
}

void require_camera_matrix(const InputKey& key, const Eigen::Matrix3d& k) {
  if (std::abs(k(0, 1)) <= kMaxSkewPx && k(1, 0) == 0 && k(2, 0) == 0 && k(2, 1) == 0 && k(2, 2) == 1) return;
  key.refuse("not a camera matrix without skew (write [fx 0 cx; 0 fy cy; 0 0 1])");
}

CameraModel camera_of(const Eigen::Matrix3d& k) {
  CameraModel camera;
  camera.fx = k(0, 0);
  camera.fy = k(1, 1);
  camera.cx = k(0, 2);
  camera.cy = k(1, 2);
  return camera;
}

void require_size_of_left(const InputKey& key, int left_width, int left_height, int width, int height) {
  if (width == left_width && height == left_height) return;
  const auto text = [](int w, int h) { return std::to_string(w) + "x" + std::to_string(h); };
  key.refuse(text(width, height) + " is not the left camera's " + text(left_width, left_height) +
             " (take both cameras from one calibration)");
}

void require_projection(const InputKey& key, const Projection& p, int width, int height) {
  const bool shaped = p(0, 1) == 0 && p(1, 0) == 0 && p(2, 0) == 0 && p(2, 1) == 0 && p(2, 2) == 1 && p(2, 3) == 0;
  if (!shaped) key.refuse("not a rectified projection (write [f 0 cx Tx*f; 0 f cy 0; 0 0 1 0])");
  if (p(1, 3) != 0) key.refuse("a vertical stereo rig is not supported (mount the cameras side by side)");
  if (!(std::abs(p(0, 0) - p(1, 1)) <= kSamePixel)) {
    key.refuse("focal lengths " + shown(p(0, 0)) + " and " + shown(p(1, 1)) +
               " differ (a rectified pair has one focal length)");
  }
  require_plausible(key, camera_of(p.leftCols<3>()), width, height);
}

void require_same_rows(const InputKey& key, const Projection& left, const Projection& right) {
  const auto require_same = [&key](const char* what, double l, double r) {
    if (std::abs(l - r) <= kSamePixel) return;
    key.refuse(std::string(what) + " " + shown(r) + " is not the left camera's " + shown(l) +
               " (take both projections from one rectification)");
  };
  require_same("focal length", left(0, 0), right(0, 0));
  require_same("cy", left(1, 2), right(1, 2));
}

}  // namespace lakshya

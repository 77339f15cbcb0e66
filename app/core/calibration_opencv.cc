#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "app/core/calibration_readers.h"
#include "app/core/calibration_yaml.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Projection = Eigen::Matrix<double, 3, 4>;

constexpr double kRotationTolerance = 1e-3;
constexpr double kSamePixel = 1e-3;
constexpr double kQPixelTolerance = 0.01;
constexpr double kQBaselineTolerance = 1e-3;     // relative
constexpr double kAgreesWithRotation = 5e-3;     // R1, R2 against R: 0.3 degrees
constexpr double kAgreesWithTranslation = 0.01;  // R2 T against P2, relative to the baseline
constexpr double kMaxSkewPx = 1e-6;

// K1, or M1 as OpenCV's stereo_calib sample names it.
std::string camera_key(const CalibrationYaml& file, char which) {
  const std::string k = std::string("K") + which;
  const std::string m = std::string("M") + which;
  if (file.has(k) && file.has(m)) file.key(m).refuse("given besides " + k + ", its other name (keep one)");
  return file.has(m) ? m : k;
}

void set_size(const CalibrationYaml& file, const std::string& name, StereoCalibration& calibration, double width,
              double height) {
  const int w = require_side(file.key(name), width);
  const int h = require_side(file.key(name), height);
  if (calibration.width != 0 && (calibration.width != w || calibration.height != h)) {
    file.key(name).refuse(std::to_string(w) + "x" + std::to_string(h) + " contradicts " +
                          std::to_string(calibration.width) + "x" + std::to_string(calibration.height) +
                          " (keep the right one)");
  }
  calibration.width = w;
  calibration.height = h;
}

void read_size(const CalibrationYaml& file, StereoCalibration& calibration) {
  for (const char* prefix : {"image_", ""}) {
    const std::string width = std::string(prefix) + "width";
    const std::string height = std::string(prefix) + "height";
    if (!file.has(width) && !file.has(height)) continue;
    set_size(file, width, calibration, file.number(width), file.number(height));
  }
  for (const char* name : {"size", "image_size", "imageSize"}) {
    if (!file.has(name)) continue;
    const auto size = file.matrix<1, 2>(name);
    set_size(file, name, calibration, size(0), size(1));
  }
}

void read_distortion(const CalibrationYaml& file, const std::string& name, CameraModel& camera) {
  constexpr std::array<std::size_t, 6> kCounts{0, 4, 5, 8, 12, 14};
  if (!file.has(name)) return;
  const CalibrationTable table = file.table(name);
  const std::vector<double>& d = table.values;
  if (!table.is_vector() || std::find(kCounts.begin(), kCounts.end(), d.size()) == kCounts.end()) {
    file.key(name).refuse(std::to_string(table.rows) + "x" + std::to_string(table.cols) +
                          " coefficients where a vector of 0, 4, 5, 8, 12 or 14 belongs (calibrate again)");
  }
  if (d.size() == 14 && (d[12] != 0 || d[13] != 0)) {
    file.key(name).refuse("a tilted sensor (tau_x, tau_y) is not supported (calibrate without the tilted model)");
  }
  std::copy_n(d.begin(), std::min(d.size(), camera.distortion.size()), camera.distortion.begin());
}

CameraModel read_camera(const CalibrationYaml& file, char which, const StereoCalibration& calibration) {
  const std::string name = camera_key(file, which);
  const CalibrationKey key = file.key(name);
  const auto k = file.matrix<3, 3>(name);
  if (std::abs(k(0, 1)) > kMaxSkewPx || k(1, 0) != 0 || k(2, 0) != 0 || k(2, 1) != 0 || k(2, 2) != 1) {
    key.refuse("not a camera matrix without skew (write [fx 0 cx; 0 fy cy; 0 0 1])");
  }
  CameraModel camera;
  camera.fx = k(0, 0);
  camera.fy = k(1, 1);
  camera.cx = k(0, 2);
  camera.cy = k(1, 2);
  require_plausible(key, camera, calibration.width, calibration.height);
  read_distortion(file, std::string("D") + which, camera);
  return camera;
}

Matrix3d read_rotation(const CalibrationYaml& file, const std::string& name) {
  Matrix3d r = file.matrix<3, 3>(name);
  const double off = (r * r.transpose() - Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= kRotationTolerance && r.determinant() > 0)) {
    file.key(name).refuse("not a rotation: R R^T is off by " + shown(off) + ", determinant " +
                          shown(r.determinant()) + " (write the 3x3 matrix with all its digits)");
  }
  return r;
}

Vector3d read_translation(const CalibrationYaml& file, double unit_m) {
  const CalibrationKey key = file.key("T");
  Vector3d t = file.matrix<3, 1>("T") * unit_m;
  require_plausible_baseline(key, t.norm(), "an OpenCV file in millimetres needs camera.calibration_unit_m: 0.001");
  if (t.tail<2>().cwiseAbs().maxCoeff() > std::abs(t.x())) {
    key.refuse(
        "the right camera is mainly above, below, before or behind the left one: only a horizontal stereo "
        "rig is supported (mount the cameras side by side)");
  }
  if (t.x() >= 0) key.refuse("T_x is not negative: left and right are swapped (exchange the cameras)");
  return t;
}

void require_projection(const CalibrationKey& key, const Projection& p, const StereoCalibration& calibration) {
  const bool shaped = p(0, 1) == 0 && p(1, 0) == 0 && p(2, 0) == 0 && p(2, 1) == 0 && p(2, 2) == 1 && p(2, 3) == 0;
  if (!shaped) key.refuse("not a rectified projection (write [f 0 cx Tx*f; 0 f cy 0; 0 0 1 0])");
  if (p(1, 3) != 0) key.refuse("a vertical stereo rig is not supported (mount the cameras side by side)");
  if (!(std::abs(p(0, 0) - p(1, 1)) <= kSamePixel)) {
    key.refuse("focal lengths " + shown(p(0, 0)) + " and " + shown(p(1, 1)) +
               " differ (a rectified pair has one focal length)");
  }
  CameraModel camera;
  camera.fx = p(0, 0);
  camera.fy = p(1, 1);
  camera.cx = p(0, 2);
  camera.cy = p(1, 2);
  require_plausible(key, camera, calibration.width, calibration.height);
}

// The file's R, T and unit against its R1 R2 P2: one of them would be wrong.
void require_agreement(const CalibrationYaml& file, const StereoCalibration& calibration, const Rectification& r) {
  const double baseline = -r.P2(0, 3) / r.P2(0, 0);
  if (!((r.R2 * calibration.R - r.R1).cwiseAbs().maxCoeff() <= kAgreesWithRotation)) {
    file.key("R1").refuse("R2 R is not R1 (write R R1 R2 from one calibration)");
  }
  const Vector3d off = r.R2 * calibration.T + Vector3d(baseline, 0, 0);
  if (!(off.norm() <= kAgreesWithTranslation * calibration.T.norm())) {
    file.key("P2").refuse("baseline " + shown(baseline) + " m contradicts R2 T, |T| = " +
                          shown(calibration.T.norm()) + " m (write T and P2 from one calibration)");
  }
}

// Q as OpenCV defines it: [1 0 0 -cx1; 0 1 0 -cy; 0 0 0 f; 0 0 -1/Tx (cx1 - cx2)/Tx], Tx = P2(0,3)/f.
void require_q(const CalibrationYaml& file, const Projection& p1, const Projection& p2) {
  if (!file.has("Q")) return;
  const Eigen::Matrix4d q = file.matrix<4, 4>("Q");
  const double tx = p2(0, 3) / p2(0, 0);
  const std::array<double, 4> pixels{q(0, 3) + p1(0, 2), q(1, 3) + p1(1, 2), q(2, 3) - p1(0, 0),
                                     q(3, 3) * tx - (p1(0, 2) - p2(0, 2))};
  const bool same_pixels = std::all_of(pixels.begin(), pixels.end(),
                                       [](double difference) { return std::abs(difference) <= kQPixelTolerance; });
  if (!same_pixels || !(std::abs(q(3, 2) * tx + 1) <= kQBaselineTolerance)) {
    file.key("Q").refuse("contradicts P1 and P2 (write Q from the same rectification or leave it out)");
  }
}

void read_rectification(const CalibrationYaml& file, double unit_m, StereoCalibration& calibration) {
  constexpr std::array<const char*, 4> kNames{"R1", "R2", "P1", "P2"};
  if (std::none_of(kNames.begin(), kNames.end(), [&](const char* name) { return file.has(name); })) return;
  for (const char* name : kNames) {
    if (!file.has(name)) file.key(name).refuse("missing (give all of R1 R2 P1 P2 or none)");
  }
  Rectification r;
  r.R1 = read_rotation(file, "R1");
  r.R2 = read_rotation(file, "R2");
  r.P1 = file.matrix<3, 4>("P1");
  r.P2 = file.matrix<3, 4>("P2");
  require_projection(file.key("P1"), r.P1, calibration);
  require_projection(file.key("P2"), r.P2, calibration);
  if (r.P1(0, 3) != 0) file.key("P1").refuse("its last column is not zero (the left camera has no offset)");
  if (!(std::abs(r.P1(0, 0) - r.P2(0, 0)) <= kSamePixel && std::abs(r.P1(1, 2) - r.P2(1, 2)) <= kSamePixel)) {
    file.key("P2").refuse("focal length or cy is not P1's (write P1 and P2 from one rectification)");
  }
  require_q(file, r.P1, r.P2);
  r.P2(0, 3) *= unit_m;
  require_agreement(file, calibration, r);
  calibration.rectification = r;
}

}  // namespace

StereoCalibration parse_opencv_calibration(const std::string& text, const std::string& source, double unit_m) {
  try {
    // FileStorage's "%YAML:1.0" is no YAML directive; as a comment it leaves the line numbers as they are.
    std::string yaml = text;
    if (yaml.starts_with("%YAML:")) yaml[0] = '#';
    const CalibrationYaml file(yaml, source);
    StereoCalibration calibration;
    calibration.source = source;
    read_size(file, calibration);
    calibration.left = read_camera(file, '1', calibration);
    calibration.right = read_camera(file, '2', calibration);
    calibration.R = read_rotation(file, "R");
    calibration.T = read_translation(file, unit_m);
    read_rectification(file, unit_m, calibration);
    return calibration;
  } catch (const YAML::Exception& e) {
    throw InputError(source, "YAML: line " + std::to_string(e.mark.line + 1) + ": " + e.msg + " (fix the line)");
  }
}

}  // namespace lakshya

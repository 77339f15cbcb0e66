#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "app/core/calibration_readers.h"
#include "app/core/calibration_yaml.h"

namespace lakshya {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kQPixelTolerance = 0.01;
constexpr double kQBaselineTolerance = 1e-3;     // relative
constexpr double kAgreesWithRotation = 5e-3;     // R1, R2 against R: 0.3 degrees
constexpr double kAgreesWithTranslation = 0.01;  // R2 T against P2, relative to the baseline

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
  if (!file.has(name)) return;
  set_distortion(file.key(name), file.vector(name), {0, 4, 5, 8, 12, 14}, camera);
}

CameraModel read_camera(const CalibrationYaml& file, char which, const StereoCalibration& calibration) {
  const std::string name = camera_key(file, which);
  const InputKey key = file.key(name);
  const Matrix3d k = file.matrix<3, 3>(name);
  require_camera_matrix(key, k);
  CameraModel camera = camera_of(k);
  require_plausible(key, camera, calibration.width, calibration.height);
  read_distortion(file, std::string("D") + which, camera);
  return camera;
}

Matrix3d read_rotation(const CalibrationYaml& file, const std::string& name) {
  Matrix3d r = file.matrix<3, 3>(name);
  require_rotation(file.key(name), r);
  return r;
}

Vector3d read_translation(const CalibrationYaml& file, double unit_m) {
  Vector3d t = file.matrix<3, 1>("T") * unit_m;
  require_side_by_side(file.key("T"), t, "an OpenCV file in millimetres needs camera.calibration_unit_m: 0.001");
  return t;
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
  require_projection(file.key("P1"), r.P1, calibration.width, calibration.height);
  require_projection(file.key("P2"), r.P2, calibration.width, calibration.height);
  if (r.P1(0, 3) != 0) file.key("P1").refuse("its last column is not zero (the left camera has no offset)");
  require_same_rows(file.key("P2"), r.P1, r.P2);
  require_q(file, r.P1, r.P2);
  r.P2(0, 3) *= unit_m;
  require_agreement(file, calibration, r);
  calibration.rectification = r;
}

}  // namespace

StereoCalibration parse_opencv_calibration(const std::string& text, const std::string& source, double unit_m) {
  const CalibrationYaml file(
      text, source, "a stereo calibration has K1 D1 K2 D2 R T in one file: join intrinsics.yml and extrinsics.yml");
  StereoCalibration calibration;
  calibration.source = source;
  read_size(file, calibration);
  calibration.left = read_camera(file, '1', calibration);
  calibration.right = read_camera(file, '2', calibration);
  calibration.R = read_rotation(file, "R");
  calibration.T = read_translation(file, unit_m);
  read_rectification(file, unit_m, calibration);
  return calibration;
}

}  // namespace lakshya

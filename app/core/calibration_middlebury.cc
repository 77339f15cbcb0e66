#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "app/core/calibration_readers.h"

namespace lakshya {
namespace {

constexpr double kDoffsTolerancePx = 0.01;
constexpr double kSameFocalPx = 1e-6;
constexpr double kMetresPerUnit = 0.001;

using Matrix3 = std::array<double, 9>;

// "[a b c; d e f; g h i]", row by row.
Matrix3 parse_matrix(const InputKey& key, std::string_view text) {
  constexpr std::string_view kWhatToDo = " (write [f 0 cx; 0 f cy; 0 0 1])";
  const auto refuse_shape = [&] { key.refuse(shown(text) + " is not a 3x3 matrix" + std::string(kWhatToDo)); };
  if (!text.starts_with('[') || !text.ends_with(']')) refuse_shape();
  std::string_view rest = text.substr(1, text.size() - 2);
  Matrix3 matrix{};
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    rest = trimmed(rest);
    const std::size_t end = rest.find_first_of(" \t,;");
    matrix[i] = parse_number(key, rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view{} : trimmed(rest.substr(end));
    const bool row_ends = i % 3 == 2 && i + 1 < matrix.size();
    if (rest.starts_with(';') != row_ends) refuse_shape();
    if (rest.starts_with(';') || rest.starts_with(',')) rest.remove_prefix(1);
  }
  if (!rest.empty()) refuse_shape();
  return matrix;
}

CameraModel parse_camera(const CalibrationLines& values, const std::string& name) {
  const InputKey key = values.key(name);
  const Matrix3 m = parse_matrix(key, values.at(name));
  if (m[1] != 0 || m[3] != 0 || m[6] != 0 || m[7] != 0 || m[8] != 1) {
    key.refuse("not a camera matrix (write [f 0 cx; 0 f cy; 0 0 1])");
  }
  if (std::abs(m[0] - m[4]) > kSameFocalPx) {
    key.refuse("focal lengths " + shown(m[0]) + " and " + shown(m[4]) + " differ (rectified images have one)");
  }
  CameraModel camera;
  camera.fx = m[0];
  camera.fy = m[4];
  camera.cx = m[2];
  camera.cy = m[5];
  return camera;
}

CameraModel parse_right_camera(const CalibrationLines& values, const CameraModel& left) {
  if (!values.has("cam1") && values.has("doffs")) {
    CameraModel right = left;
    right.cx += values.number("doffs");
    return right;
  }
  const CameraModel right = parse_camera(values, "cam1");
  if (std::abs(right.fx - left.fx) > kSameFocalPx) {
    values.key("cam1").refuse("focal length " + shown(right.fx) + " is not cam0's " + shown(left.fx) +
                              " (rectified images have one)");
  }
  if (std::abs(right.cy - left.cy) > kDoffsTolerancePx) {
    values.key("cam1").refuse("cy " + shown(right.cy) + " is not cam0's " + shown(left.cy) +
                              " (rectified images have one)");
  }
  if (values.has("doffs")) {
    const double doffs = values.number("doffs");
    const double shift = right.cx - left.cx;
    if (!(std::abs(doffs - shift) <= kDoffsTolerancePx)) {
      values.key("doffs").refuse(shown(doffs) + " is not cam1's cx minus cam0's cx, " + shown(shift) +
                                 " (fix the one that is wrong)");
    }
  }
  return right;
}

}  // namespace

StereoCalibration parse_middlebury_calibration(std::string_view text, const std::string& source) {
  const CalibrationLines values(text, source, '=',
                                "a Middlebury calib.txt has cam0, cam1, doffs, baseline, width and height");
  StereoCalibration calibration;
  calibration.source = source;
  calibration.images_rectified = true;
  calibration.width = require_side(values.key("width"), values.number("width"));
  calibration.height = require_side(values.key("height"), values.number("height"));
  calibration.left = parse_camera(values, "cam0");
  require_plausible(values.key("cam0"), calibration.left, calibration.width, calibration.height);
  calibration.right = parse_right_camera(values, calibration.left);
  const char* right_key = values.has("cam1") ? "cam1" : "doffs";
  require_plausible(values.key(right_key), calibration.right, calibration.width, calibration.height);
  const double baseline = values.number("baseline") * kMetresPerUnit;
  require_plausible_baseline(values.key("baseline"), baseline, "Middlebury files state millimetres");
  calibration.T.x() = -baseline;
  return calibration;
}

}  // namespace lakshya

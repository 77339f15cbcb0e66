#include "app/core/calibration_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string_view>
#include <system_error>

#include "app/core/calibration_readers.h"
#include "app/core/file_bytes.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{4} << 20;
constexpr double kMaxSide = 16384;
constexpr double kMinFocalPx = 10;
constexpr double kMaxFocalPx = 100000;
constexpr double kMaxOffCentre = 3;  // image sizes
constexpr double kMinBaselineM = 0.001;
constexpr double kMaxBaselineM = 10;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

template <std::size_t kCount>
bool has_line_key(std::string_view text, char separator, const std::array<std::string_view, kCount>& keys) {
  bool found = false;
  for_each_line(text, [&](std::string_view line) {
    const std::size_t end = line.find(separator);
    if (end == std::string_view::npos) return;
    found = found || std::find(keys.begin(), keys.end(), trimmed(line.substr(0, end))) != keys.end();
  });
  return found;
}

bool is_opencv_yaml(std::string_view text) {
  constexpr std::array<std::string_view, 4> kKeys{"K1", "K2", "M1", "M2"};
  return text.starts_with("%YAML") || has_line_key(text, ':', kKeys);
}

bool is_middlebury(std::string_view text) {
  constexpr std::array<std::string_view, 2> kKeys{"cam0", "cam1"};
  return has_line_key(text, '=', kKeys);
}

void require_focal(const CalibrationKey& key, double focal) {
  if (!(focal > 0)) {
    key.refuse("focal length " + shown(focal) + " is not positive (calibrate again or fix the sign)");
  }
  if (focal < kMinFocalPx || focal > kMaxFocalPx) {
    key.refuse("focal length " + shown(focal) + " px is outside 10..100000 (it is in pixels, not in millimetres)");
  }
}

void require_near_image(const CalibrationKey& key, double coordinate, int side) {
  if (side == 0 || std::abs(coordinate - side / 2.0) <= kMaxOffCentre * side) return;
  key.refuse("principal point at " + shown(coordinate) + " px is more than 3 image sizes from the centre of " +
             std::to_string(side) + " px (calibrate again or fix the size)");
}

// A calibration that does not state its image size is most often caught here when it is another size's.
void require_centre_inside(const StereoCalibration& calibration, const CameraModel& camera, int width, int height,
                           const std::string& image_path) {
  if (camera.cx >= 0 && camera.cx < width && camera.cy >= 0 && camera.cy < height) return;
  throw InputError(image_path, "image size: the principal point (" + shown(camera.cx) + ", " + shown(camera.cy) +
                                   ") of " + calibration.source + " is outside the image of " +
                                   std::to_string(width) + "x" + std::to_string(height) +
                                   " (use the calibration of these images)");
}

}  // namespace

void CalibrationKey::refuse(const std::string& reason) const {
  throw InputError(source, name + ": " + reason);
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\f\v";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

std::string shown(std::string_view text) {
  constexpr std::size_t kLength = 24;
  std::string out(text.substr(0, kLength));
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + out + (text.size() > kLength ? "...'" : "'");
}

std::string shown(double value) {
  std::array<char, 32> out{};
  const int length = std::snprintf(out.data(), out.size(), "%.10g", value);
  return {out.data(), static_cast<std::size_t>(length)};
}

double parse_number(const CalibrationKey& key, std::string_view text) {
  std::string_view digits = trimmed(text);
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) key.refuse(shown(text) + " is out of range (calibrate again)");
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    key.refuse(shown(text) + " is not a number (write decimal numbers)");
  }
  if (!std::isfinite(value)) key.refuse(shown(text) + " is not a finite number (calibrate again)");
  return value;
}

int require_side(const CalibrationKey& key, double value) {
  if (value >= 1 && value <= kMaxSide && value == std::floor(value)) return static_cast<int>(value);
  key.refuse(shown(value) + " is not an integer in 1..16384 (give the image size in pixels)");
}

void require_plausible(const CalibrationKey& key, const CameraModel& camera, int width, int height) {
  require_focal(key, camera.fx);
  require_focal(key, camera.fy);
  require_near_image(key, camera.cx, width);
  require_near_image(key, camera.cy, height);
}

void require_plausible_baseline(const CalibrationKey& key, double metres, const std::string& what_to_do) {
  if (metres >= kMinBaselineM && metres <= kMaxBaselineM) return;
  key.refuse("baseline " + shown(metres) + " m is outside 0.001..10 m (" + what_to_do + ")");
}

StereoCalibration read_calibration(const std::string& path, double opencv_unit_m) {
  std::string text = read_text(path, kMaxFileBytes);
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  if (is_middlebury(text)) return parse_middlebury_calibration(text, path);
  if (is_opencv_yaml(text)) return parse_opencv_calibration(text, path, opencv_unit_m);
  throw InputError(path,
                   "format: not a calibration that is known (give an OpenCV stereo YAML with K1 D1 K2 D2 R T, or a "
                   "Middlebury calib.txt with cam0= cam1= doffs= baseline= width= height=)");
}

void require_image_size(const StereoCalibration& calibration, int width, int height,
                        const std::string& image_path) {
  if (calibration.width == 0) {
    require_centre_inside(calibration, calibration.left, width, height, image_path);
    require_centre_inside(calibration, calibration.right, width, height, image_path);
    return;
  }
  if (calibration.width == width && calibration.height == height) return;
  throw InputError(image_path, "image size: " + std::to_string(width) + "x" + std::to_string(height) +
                                   " is not the " + std::to_string(calibration.width) + "x" +
                                   std::to_string(calibration.height) + " of " + calibration.source +
                                   " (use the calibration of these images)");
}

}  // namespace lakshya

// Private to the calibration readers: one parser per format, and the checks that they share.
#pragma once

#include <string>
#include <string_view>

#include "app/core/calibration.h"

namespace lakshya {

StereoCalibration parse_opencv_calibration(const std::string& text, const std::string& source, double unit_m);
StereoCalibration parse_middlebury_calibration(std::string_view text, const std::string& source);

// Where a value comes from, for messages.
struct CalibrationKey {
  const std::string& source;
  std::string name;

  [[noreturn]] void refuse(const std::string& reason) const;
};

std::string_view trimmed(std::string_view text);

// Calls f(line) for every line, without its line end.
template <class F>
void for_each_line(std::string_view text, F f) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    f(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
}

// Short and printable, whatever the file holds.
std::string shown(std::string_view text);
std::string shown(double value);

// A finite decimal number and nothing else.
double parse_number(const CalibrationKey& key, std::string_view text);

// An image width or height: an integer in 1..16384.
int require_side(const CalibrationKey& key, double value);

// Focal lengths and principal point; the size is 0 x 0 where the file states none.
void require_plausible(const CalibrationKey& key, const CameraModel& camera, int width, int height);

// what_to_do ends the message: formats differ in their units.
void require_plausible_baseline(const CalibrationKey& key, double metres, const std::string& what_to_do);

}  // namespace lakshya

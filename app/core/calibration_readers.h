// Private to the calibration readers: one parser per format.
#pragma once

#include <string>
#include <string_view>

#include "app/core/calibration.h"
#include "app/core/calibration_checks.h"
#include "app/core/calibration_file.h"

namespace lakshya {

// A file's content and its name for messages.
struct CalibrationText {
  std::string text;
  std::string source;
};

StereoCalibration parse_opencv_calibration(const std::string& text, const std::string& source, double unit_m);
StereoCalibration parse_middlebury_calibration(std::string_view text, const std::string& source);
StereoCalibration parse_kitti_calibration(std::string_view text, const std::string& source, CameraNumbers cameras);
StereoCalibration parse_euroc_calibration(const CalibrationText& left, const CalibrationText& right);
StereoCalibration parse_ros_calibration(const CalibrationText& left, const CalibrationText& right);

}  // namespace lakshya

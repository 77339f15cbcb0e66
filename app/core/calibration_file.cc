#include "app/core/calibration_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "app/core/calibration_readers.h"
#include "app/core/file_bytes.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{4} << 20;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

enum class Format { opencv, middlebury, kitti, euroc, ros };

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

// KITTI's projections without their names: nothing but numbers.
bool is_table_of_numbers(std::string_view text) {
  return text.find_first_of("0123456789") != std::string_view::npos &&
         text.find_first_not_of("0123456789+-.eE \t\r\n") == std::string_view::npos;
}

Format format_of(std::string_view text, const std::string& path) {
  constexpr std::array<std::string_view, 2> kMiddlebury{"cam0", "cam1"};
  constexpr std::array<std::string_view, 4> kOpencv{"K1", "K2", "M1", "M2"};
  constexpr std::array<std::string_view, 1> kEuroc{"T_BS"};
  constexpr std::array<std::string_view, 3> kRos{"camera_name", "rectification_matrix", "projection_matrix"};
  constexpr std::array<std::string_view, 8> kKitti{"P0",        "P1",        "P2",        "P3",
                                                   "P_rect_00", "P_rect_01", "P_rect_02", "P_rect_03"};
  if (has_line_key(text, '=', kMiddlebury)) return Format::middlebury;
  if (has_line_key(text, ':', kOpencv)) return Format::opencv;
  if (has_line_key(text, ':', kEuroc)) return Format::euroc;
  if (has_line_key(text, ':', kRos)) return Format::ros;
  if (text.starts_with("%YAML")) return Format::opencv;
  if (has_line_key(text, ':', kKitti) || is_table_of_numbers(text)) return Format::kitti;
  throw InputError(path,
                   "format: not a calibration that is known (give an OpenCV stereo YAML with K1 D1 K2 D2 R T, a "
                   "Middlebury calib.txt with cam0= cam1= doffs= baseline= width= height=, a KITTI calib.txt with "
                   "P0: P1:, or both cameras' EuRoC sensor.yaml or ROS camera_info YAML)");
}

CalibrationText read_calibration_text(const std::string& path) {
  CalibrationText input{read_text(path, kMaxFileBytes), path};
  if (input.text.starts_with(kByteOrderMark)) input.text.erase(0, kByteOrderMark.size());
  return input;
}

StereoCalibration read_one(const CalibrationText& file, const CalibrationRequest& request) {
  switch (format_of(file.text, file.source)) {
    case Format::middlebury:
      return parse_middlebury_calibration(file.text, file.source);
    case Format::opencv:
      return parse_opencv_calibration(file.text, file.source, request.opencv_unit_m);
    case Format::kitti:
      return parse_kitti_calibration(file.text, file.source, request.cameras);
    case Format::euroc:
      throw InputError(file.source,
                       "format: one camera's EuRoC sensor.yaml; the other camera's is needed, too (give two files, "
                       "left then right, or the folder with cam0 and cam1)");
    case Format::ros:
      break;
  }
  throw InputError(file.source,
                   "format: one camera's ROS camera_info; the other camera's is needed, too (give two files, left "
                   "then right, or the folder with left.yaml and right.yaml)");
}

StereoCalibration read_two(const CalibrationText& left, const CalibrationText& right) {
  const Format format = format_of(left.text, left.source);
  const bool per_camera = format == Format::euroc || format == Format::ros;
  if (!per_camera) {
    throw InputError(left.source, "format: holds both cameras by itself (give this one file alone)");
  }
  if (format_of(right.text, right.source) != format) {
    throw InputError(right.source, "format: not that of " + left.source + " (give the files of one rig)");
  }
  return format == Format::euroc ? parse_euroc_calibration(left, right) : parse_ros_calibration(left, right);
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

StereoCalibration read_calibration(const CalibrationRequest& request) {
  std::vector<std::string> paths = request.paths;
  std::error_code ignored;
  if (paths.size() == 1 && std::filesystem::is_directory(paths[0], ignored)) paths = find_calibration(paths[0]);
  if (paths.size() == 1) return read_one(read_calibration_text(paths[0]), request);
  if (paths.size() == 2) return read_two(read_calibration_text(paths[0]), read_calibration_text(paths[1]));
  throw InputError("calibration", "paths: " + std::to_string(paths.size()) +
                                      " given (give one file, the left and the right camera's file, or a folder)");
}

StereoCalibration read_calibration(const std::string& path, double opencv_unit_m) {
  return read_calibration(CalibrationRequest{{path}, opencv_unit_m, {}});
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

#include <Eigen/Core>
#include <string>
#include <vector>

#include "app/core/calibration_readers.h"
#include "app/core/calibration_yaml.h"

namespace lakshya {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr const char* kHint =
    "a ROS camera_info file has image_width, image_height, camera_matrix, distortion_model, "
    "distortion_coefficients, rectification_matrix and projection_matrix";

struct CameraInfo {
  CameraModel camera;
  int width = 0;
  int height = 0;
  Matrix3d rectification;
  Projection projection;
};

// plumb_bob and rational_polynomial are OpenCV's coefficients in OpenCV's order (sensor_msgs/CameraInfo).
void read_distortion(const CalibrationYaml& file, CameraModel& camera) {
  const std::string model = file.text("distortion_model");
  const InputKey key = file.key("distortion_coefficients");
  const std::vector<double> values = file.vector("distortion_coefficients");
  if (model == "plumb_bob") {
    set_distortion(key, values, {4, 5}, camera);
  } else if (model == "rational_polynomial") {
    set_distortion(key, values, {8, 12, 14}, camera);
  } else {
    file.key("distortion_model")
        .refuse(shown(model) + " is not supported (calibrate with plumb_bob or rational_polynomial)");
  }
}

CameraInfo read_camera_info(const CalibrationText& input) {
  const CalibrationYaml file(input.text, input.source, kHint);
  CameraInfo info;
  info.width = require_side(file.key("image_width"), file.number("image_width"));
  info.height = require_side(file.key("image_height"), file.number("image_height"));
  const Matrix3d k = file.matrix<3, 3>("camera_matrix");
  require_camera_matrix(file.key("camera_matrix"), k);
  info.camera = camera_of(k);
  require_plausible(file.key("camera_matrix"), info.camera, info.width, info.height);
  read_distortion(file, info.camera);
  info.rectification = file.matrix<3, 3>("rectification_matrix");
  require_rotation(file.key("rectification_matrix"), info.rectification);
  info.projection = file.matrix<3, 4>("projection_matrix");
  require_projection(file.key("projection_matrix"), info.projection, info.width, info.height);
  return info;
}

double checked_baseline(const CalibrationText& left_file, const CameraInfo& left, const CalibrationText& right_file,
                        const CameraInfo& right) {
  if (left.projection(0, 3) != 0) {
    InputKey{left_file.source, "projection_matrix"}.refuse(
        "its last column is not zero: left and right are swapped (the left camera has no offset)");
  }
  const InputKey key{right_file.source, "projection_matrix"};
  require_same_rows(key, left.projection, right.projection);
  const double baseline = (left.projection(0, 3) - right.projection(0, 3)) / right.projection(0, 0);
  if (baseline < 0) {
    key.refuse("baseline " + shown(baseline) + " m is negative: left and right are swapped (exchange the files)");
  }
  require_plausible_baseline(key, baseline, "the last column is -f B in px m; calibrate both cameras as one pair");
  return baseline;
}

}  // namespace

StereoCalibration parse_ros_calibration(const CalibrationText& left_file, const CalibrationText& right_file) {
  const CameraInfo left = read_camera_info(left_file);
  const CameraInfo right = read_camera_info(right_file);
  require_size_of_left({right_file.source, "image_width"}, left.width, left.height, right.width, right.height);
  const double baseline = checked_baseline(left_file, left, right_file, right);
  StereoCalibration calibration;
  calibration.source = left_file.source + " and " + right_file.source;
  calibration.width = left.width;
  calibration.height = left.height;
  calibration.left = left.camera;
  calibration.right = right.camera;
  // Rectified coordinates differ by the baseline only: R2 x_right = R1 x_left - (B, 0, 0).
  calibration.R = right.rectification.transpose() * left.rectification;
  calibration.T = right.rectification.transpose() * Vector3d(-baseline, 0, 0);
  calibration.rectification =
      Rectification{left.rectification, right.rectification, left.projection, right.projection};
  return calibration;
}

}  // namespace lakshya

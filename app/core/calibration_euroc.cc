#include <Eigen/Core>
#include <string>

#include "app/core/calibration_readers.h"
#include "app/core/calibration_yaml.h"

namespace lakshya {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;

constexpr const char* kHint =
    "a EuRoC sensor.yaml has T_BS, resolution, camera_model, intrinsics, distortion_model and "
    "distortion_coefficients";

struct Sensor {
  CameraModel camera;
  int width = 0;
  int height = 0;
  Matrix3d rotation;  // T_BS: x_body = rotation x_camera + position
  Vector3d position;
};

void require_name(const CalibrationYaml& file, const std::string& key, const std::string& supported) {
  const std::string name = file.text(key);
  if (name == supported) return;
  file.key(key).refuse(shown(name) + " is not supported (calibrate with " + supported + ")");
}

Sensor read_sensor(const CalibrationText& input) {
  const CalibrationYaml file(input.text, input.source, kHint);
  Sensor sensor;
  const Matrix4d pose = file.matrix<4, 4>("T_BS");
  if (pose.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    file.key("T_BS").refuse("its last row is not 0 0 0 1 (write the 4x4 matrix from camera to body)");
  }
  sensor.rotation = pose.topLeftCorner<3, 3>();
  sensor.position = pose.topRightCorner<3, 1>();
  require_rotation(file.key("T_BS"), sensor.rotation);

  const auto size = file.matrix<1, 2>("resolution");
  sensor.width = require_side(file.key("resolution"), size(0));
  sensor.height = require_side(file.key("resolution"), size(1));

  require_name(file, "camera_model", "pinhole");
  require_name(file, "distortion_model", "radial-tangential");
  const auto intrinsics = file.matrix<1, 4>("intrinsics");
  sensor.camera.fx = intrinsics(0);
  sensor.camera.fy = intrinsics(1);
  sensor.camera.cx = intrinsics(2);
  sensor.camera.cy = intrinsics(3);
  require_plausible(file.key("intrinsics"), sensor.camera, sensor.width, sensor.height);
  const std::string distortion = "distortion_coefficients";
  set_distortion(file.key(distortion), file.vector(distortion), {4, 5}, sensor.camera);
  return sensor;
}

}  // namespace

StereoCalibration parse_euroc_calibration(const CalibrationText& left_file, const CalibrationText& right_file) {
  const Sensor left = read_sensor(left_file);
  const Sensor right = read_sensor(right_file);
  require_size_of_left({right_file.source, "resolution"}, left.width, left.height, right.width, right.height);
  StereoCalibration calibration;
  calibration.source = left_file.source + " and " + right_file.source;
  calibration.width = left.width;
  calibration.height = left.height;
  calibration.left = left.camera;
  calibration.right = right.camera;
  // x_body is the same for both: R_l x_l + p_l = R_r x_r + p_r.
  calibration.R = right.rotation.transpose() * left.rotation;
  calibration.T = right.rotation.transpose() * (left.position - right.position);
  require_side_by_side({right_file.source, "T_BS"}, calibration.T, "give the left and the right camera's file");
  return calibration;
}

}  // namespace lakshya

// Where the pixels of a camera look, its lens distortion included. Made once per camera.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/core/calibration.h"

namespace lakshya::sim {

// The camera's optical frame: x right, y down, z forward.
struct CameraPose {
  Eigen::Matrix3d world_from_camera = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // m
};

class RayTable {
 public:
  // 1..16384 px each way; throws InputError otherwise, and for a focal length that is not positive.
  RayTable(const CameraModel& model, int width, int height);

  const CameraModel& model() const { return model_; }
  int width() const { return width_; }
  int height() const { return height_; }
  // x / z and y / z of pixel (u, v)'s centre, row-major.
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }
  // Size of a pixel at 1 m depth, m.
  float pixel_m() const { return static_cast<float>(1 / model_.fx); }

 private:
  CameraModel model_;
  int width_ = 0;
  int height_ = 0;
  std::vector<float> x_;
  std::vector<float> y_;
};

}  // namespace lakshya::sim

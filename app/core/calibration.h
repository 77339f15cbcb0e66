// Stereo calibration: what a calibration file says, in one form, whatever the file's format.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

namespace lakshya {

// Pinhole camera with OpenCV's distortion model: k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 (missing ones are 0).
struct CameraModel {
  double fx = 0;  // px
  double fy = 0;
  double cx = 0;  // px, integer coordinates at pixel centres
  double cy = 0;
  std::array<double, 12> distortion{};
};

// Rotations and projections after rectification, in OpenCV's meaning: x_rectified = R x_camera,
// P = [f 0 cx -f*B; 0 f cy 0; 0 0 1 0] with the last column zero for the left camera.
struct Rectification {
  Eigen::Matrix3d R1 = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d R2 = Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 3, 4> P1 = Eigen::Matrix<double, 3, 4>::Zero();
  Eigen::Matrix<double, 3, 4> P2 = Eigen::Matrix<double, 3, 4>::Zero();
};

// What every later stage needs to know of a rectified pair.
struct RectifiedGeometry {
  int width = 0;
  int height = 0;
  double focal_px = 0;
  double cx_left = 0;
  double cx_right = 0;
  double cy = 0;
  double baseline_m = 0;
  double doffs() const { return cx_right - cx_left; }  // docs/contract.md section 2
};

struct StereoCalibration {
  std::string source;  // file name, for messages
  int width = 0;       // px; 0: the file does not say
  int height = 0;
  CameraModel left;
  CameraModel right;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  // x_right = R x_left + T
  Eigen::Vector3d T = Eigen::Vector3d::Zero();      // metres
  bool images_rectified = false;                    // the images are already rectified: no remap
  std::optional<Rectification> rectification;       // given by the file; else computed by rectify_stereo()
};

}  // namespace lakshya

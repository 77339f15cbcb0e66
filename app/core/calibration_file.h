// Reads a stereo calibration. The format is recognised by content, never by name:
//
//  - OpenCV stereo YAML, as cv::FileStorage writes it or written by hand: K1 D1 K2 D2 R T (also M1 M2 for K1 K2),
//    matrices as !!opencv-matrix, as a flat list or as a list of rows. D1, D2: 0, 4, 5, 8, 12 or 14 coefficients,
//    absent: none; a tilted sensor is refused. Optional R1 R2 P1 P2 (all four or none; Q is only compared with
//    them), image size as image_width and image_height, width and height, or size, image_size or imageSize:
//    [width, height]. Other keys are ignored.
//  - Middlebury calib.txt (vision.middlebury.edu/stereo, 2014 data sets): cam0=[f 0 cx; 0 f cy; 0 0 1], cam1,
//    doffs, baseline (mm), width, height, in any order; other keys are ignored. doffs = cx1 - cx0; either doffs or
//    cam1 may be absent. The images are rectified already.
//  - KITTI (cvlibs.net/datasets/kitti): a projection P = K [I t] of 12 numbers, row by row, for each of four
//    rectified cameras: lines P0: .. P3: (odometry, stereo 2012), P_rect_00: .. P_rect_03: with image sizes S_rect_00:
//    .. (calib_cam_to_cam.txt), or two to four lines without names. Cameras 0, 1 are grey, 2, 3 colour. The baseline
//    is x of t_left - t_right, t = K^-1 P e_4; y and z up to 2 % of it are neglected.
//  - EuRoC (Burri et al., "The EuRoC micro aerial vehicle datasets", IJRR 2016): one sensor.yaml for each camera: T_BS
//    (x_body = T_BS x_camera), resolution, camera_model pinhole, intrinsics [fu, fv, cu, cv], distortion_model
//    radial-tangential, distortion_coefficients (4 or 5).
//  - ROS camera_info (sensor_msgs/CameraInfo as camera_calibration writes it): one YAML for each camera: image_width,
//    image_height, camera_matrix, distortion_model plumb_bob (4 or 5 coefficients) or rational_polynomial (8, 12 or
//    14), distortion_coefficients, rectification_matrix R, projection_matrix P. B = -P_right(0,3) / P_right(0,0),
//    x_right = R_right^T (R_left x_left - (B, 0, 0)).
//
// Throws InputError(path, "key: reason (what to do)") for everything else: truncated, contradicting itself, not
// finite, focal lengths outside 10..100000 px, principal points more than 3 image sizes from the image centre,
// baselines outside 0.001..10 m, rotations that are none (R R^T off by more than 1e-3), a right camera that is not
// mainly to the right, left and right swapped, two cameras whose sizes differ, sizes outside 1..16384, a key given
// twice, a file above 4 MiB.
#pragma once

#include <string>
#include <vector>

#include "app/core/calibration.h"

namespace lakshya {

// Which cameras of a KITTI calibration are the pair; the other formats have two.
struct CameraNumbers {
  int left = 0;
  int right = 1;
};

struct CalibrationRequest {
  // One file; the left and the right camera's file (EuRoC, ROS); or one folder, see find_calibration().
  std::vector<std::string> paths;
  double opencv_unit_m = 1.0;  // metres per unit of T in an OpenCV file (camera.calibration_unit_m)
  CameraNumbers cameras;
};

StereoCalibration read_calibration(const CalibrationRequest& request);

// One file or folder, KITTI cameras 0 and 1.
StereoCalibration read_calibration(const std::string& path, double opencv_unit_m = 1.0);

// The calibration that a folder holds, by name: one path, or left and right. cam0/sensor.yaml and cam1/sensor.yaml, also
// below mav0/, cam0_sensor.yaml and cam1_sensor.yaml (EuRoC); left.yaml and right.yaml (ROS); or one calib.txt,
// calib_cam_to_cam.txt, or calib, calibration, stereo, stereo_calib with .yaml or .yml. Throws InputError when there is
// none, only one camera's, or more than one calibration.
std::vector<std::string> find_calibration(const std::string& folder);

// Throws InputError(image_path, ...) when the calibration states another size; when it states none, only where its
// principal point lies outside the image.
void require_image_size(const StereoCalibration& calibration, int width, int height, const std::string& image_path);

}  // namespace lakshya

// Reads a stereo calibration file. The format is recognised by content, never by name:
//
//  - OpenCV stereo YAML, as cv::FileStorage writes it or written by hand: K1 D1 K2 D2 R T (also M1 M2 for K1 K2),
//    matrices as !!opencv-matrix, as a flat list or as a list of rows. D1, D2: 0, 4, 5, 8, 12 or 14 coefficients,
//    absent: none; a tilted sensor is refused. Optional R1 R2 P1 P2 (all four or none; Q is only compared with
//    them), image size as image_width and image_height, width and height, or size, image_size or imageSize:
//    [width, height]. Other keys are ignored.
//  - Middlebury calib.txt (vision.middlebury.edu/stereo, 2014 data sets): cam0=[f 0 cx; 0 f cy; 0 0 1], cam1,
//    doffs, baseline (mm), width, height, in any order; other keys are ignored. doffs = cx1 - cx0; either doffs or
//    cam1 may be absent. The images are rectified already.
//
// Throws InputError(path, "key: reason (what to do)") for everything else: truncated, contradicting itself, not
// finite, focal lengths outside 10..100000 px, principal points more than 3 image sizes from the image centre,
// baselines outside 0.001..10 m, rotations that are none (R R^T off by more than 1e-3), a right camera that is not
// mainly to the right, sizes outside 1..16384, a key given twice, a file above 4 MiB.
#pragma once

#include <string>

#include "app/core/calibration.h"

namespace lakshya {

// opencv_unit_m: metres per unit of T in an OpenCV file (camera.calibration_unit_m); Middlebury files are in mm.
StereoCalibration read_calibration(const std::string& path, double opencv_unit_m = 1.0);

// Throws InputError(image_path, ...) when the calibration states another size; does nothing when it states none.
void require_image_size(const StereoCalibration& calibration, int width, int height, const std::string& image_path);

}  // namespace lakshya

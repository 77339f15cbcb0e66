// From a stereo calibration to a rectified pair: rotations, projections, maps, and what later stages need to know.
//
// Meanings: docs/contract.md sections 1 and 2. A rectified pixel (u, v) of a camera with rotation R and projection
// P looks along R^-1 ((u - P02) / P00, (v - P12) / P11, 1) in that camera's frame.
//
// Start-up only: these functions allocate and may throw InputError. They refuse image sizes outside 1..16384.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "app/core/calibration.h"
#include "app/core/image.h"
#include "kernels/rectify/rectify.h"

namespace lakshya {

// Maps hold pixels in the kernel's fixed point (1/128 px).
inline constexpr int kRectifyMapScale = 1 << kRectifyFractionBits;
inline constexpr int kRectifyMapMinPx = -32768;
inline constexpr int kRectifyMapMaxPx = 32767;

// Where each rectified pixel lies in the raw image, clamped to kRectifyMapMinPx..kRectifyMapMaxPx: the memory of a
// RectifyMap.
struct RectifyMaps {
  Image<std::int16_t> x;
  Image<std::int16_t> y;
  Image<std::uint16_t> fraction;
  RectifyMap view() const { return {x.view(), y.view(), fraction.view()}; }
};

// False when the raw images are rectified already: the calibration says so, or both cameras have no distortion,
// square pixels, one focal length and one cy, R = I and T along x (all to 1e-9).
bool needs_remap(const StereoCalibration& calibration);

// Bouguet's rectification (J.-Y. Bouguet, Camera Calibration Toolbox for Matlab, "stereo rectification"), with
// the conventions of cv::stereoRectify(CALIB_ZERO_DISPARITY, alpha 0) of OpenCV 4.6, so that one calibration gives
// one geometry in both:
//  - R is split into two halves, one for each camera; then both cameras turn by the least rotation that brings the
//    baseline onto the x axis;
//  - principal point: with f0 = mean of the two fy, c = ((w-1)/2, (h-1)/2) minus the mean of the projected image
//    corners (0, 0)..(w-1, h-1), averaged over both cameras;
//  - inner rectangle of each rectified view: from 9 samples of each side of the raw image (0, 0)..(w, h); the focal
//    length is the least with which both rectangles cover (0, 0)..(w, h), so that no rectified pixel lies outside
//    its raw image (but for the fraction of a pixel by which the border bulges between samples).
// Refuses what has no such rectangle: a right camera that is not on the right, views without a common part, a
// distortion without an inverse.
Rectification rectify_stereo(const StereoCalibration& calibration, int width, int height);

// Geometry of the rectified pair: of the cameras where no remap is needed, else of the file's own rectification,
// else of rectify_stereo(). The size is that of the images; require_image_size() has compared it with the file's.
RectifiedGeometry rectified_geometry(const StereoCalibration& calibration, int width, int height);

// Ideal normalized image coordinates (x/z, y/z) of a raw pixel: the distortion is inverted by five fixed-point
// rounds x <- (x_d - tangential(x)) / radial(x), as many as cv::undistortPoints makes; where the radial factor is
// not positive the distorted coordinates are returned.
Eigen::Vector2d undistort_normalized(const CameraModel& camera, double u, double v);

// Raw pixel that a rectified pixel (u, v) shows. Distortion: OpenCV's, equations of the calib3d module reference
// (Brown's radial and tangential terms, rational k4..k6, thin prism s1..s4). A ray that points backwards lies in
// no image: (kRectifyMapMinPx, kRectifyMapMinPx).
Eigen::Vector2d raw_pixel(const CameraModel& camera, const Eigen::Matrix3d& R_inverse,
                          const Eigen::Matrix<double, 3, 4>& P, double u, double v);

// raw_pixel() of every pixel of a width x height rectified image, rounded to the nearest 1/128 px.
RectifyMaps make_rectify_maps(const CameraModel& camera, const Eigen::Matrix3d& R,
                              const Eigen::Matrix<double, 3, 4>& P, int width, int height);

}  // namespace lakshya

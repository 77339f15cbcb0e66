// What the disparity image shows where a thing was remembered: whether it is still there, or what lies behind it is seen. Floor seen in
// a cell says nothing about a board above it; the pixels of the board do.
#pragma once

#include <cstdint>

#include "kernels/base/image_view.h"

namespace lakshya {

// The rectified left camera in the body frame (origin on the ground below the turning centre). Metres, radians, pixels; the mount as in
// kernels/prune/prune.h.
struct DepthViewParams {
  double focal_px = 0;  // 0: there is no view
  double baseline_m = 0;
  double center_u = 0;
  double center_v = 0;
  double height_m = 0;
  double pitch = 0;
  double roll = 0;
  double yaw = 0;
  double forward_m = 0;
  double left_m = 0;
  double depth_sigma = 0;  // standard deviation of a depth at 1 m, which grows with its square, m
};

enum class Shown : std::uint8_t {
  outside,  // not in the image, or too near its upper border to be matched
  nothing,  // too few pixels have a disparity
  behind,   // what lies farther away, and hardly anything nearer
  thing     // something there or before it
};

class DepthView {
 public:
  // Rows below the upper border that are seldom matched: their windows reach beyond the image.
  static constexpr int kUnmatchedRows = 8;

  explicit DepthView(const DepthViewParams& params);

  // disparity: stored, 1/16 px or NoDisparity. A thing of the cell's width at (forward, left), whose mean height was height_m: looked at
  // from 0.12 m below that height to 0.03 m above.
  Shown at(ImageView<const std::int16_t> disparity, double forward_m, double left_m, double height_m,
           double cell_m) const;

 private:
  struct Pixel {
    double u = 0;
    double v = 0;
    double depth_m = 0;
  };
  Pixel project(double forward_m, double left_m, double height_m) const;

  DepthViewParams params_;
  double forward_[3] = {};  // body axes in the camera frame
  double left_[3] = {};
  double down_[3] = {};
};

}  // namespace lakshya

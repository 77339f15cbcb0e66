// Disparity and points as files that other programs read.
#pragma once

#include <cstdint>
#include <string>

#include "app/core/image.h"
#include "app/core/pipeline.h"

namespace lakshya {

// KITTI's encoding: 16 bits, disparity * 256, 0 = none, a valid 0 is written as 1. Image disparity u_left -
// u_right, that is stored disparity without doffs, as ground-truth files hold it. `clipped` counts the values that
// 16 bits cannot hold (below 0 or from 256 px on); they are written as 1 or 65535.
struct KittiDisparity {
  Image<std::uint16_t> image;
  int clipped = 0;
};
KittiDisparity kitti_disparity(ImageView<const std::int16_t> stored, double doffs);

// Every pixel with a class other than no_disparity and too_far as a point: body frame (x forward, y left, z up,
// metres), coloured by class. Binary little-endian PLY.
std::string ply_points(const FrameResult& frame, const PruneModel& model);

}  // namespace lakshya

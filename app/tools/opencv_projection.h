// Projection and binning as one writes them with OpenCV: a point cloud of the whole image (cv::reprojectImageTo3D), then
// one loop over it with the tests of docs/contract.md section 3 and the binning of section 4, in float. The yardstick
// for the stages `ground` and `project_and_bin`: nothing that runs on a vehicle calls it.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "kernels/base/image_view.h"
#include "kernels/base/nav_grid.h"
#include "kernels/prune/prune.h"

namespace lakshya {

// What stays the same from frame to frame.
struct OpencvProjection {
  PruneGeometry geometry;
  cv::Mat Q;      // disparity in 1/16 px to metres
  cv::Mat cloud;  // kept, so that only the first frame allocates it
};
OpencvProjection make_opencv_projection(const PruneGeometry& geometry);

// Adds to the counts of `grid`, which clear_grid has cleared. From `model` (build_prune_model of the same geometry) only
// the floor is taken, where shift_floor put it.
void project_and_bin_opencv(ImageView<const std::int16_t> disparity, OpencvProjection& projection,
                            const PruneModel& model, const NavGrid& grid);

}  // namespace lakshya

#include "app/tools/sim/ray_table.h"

#include <string>

#include "app/core/image_file.h"
#include "app/core/input_error.h"
#include "app/core/rectification.h"

namespace lakshya::sim {

RayTable::RayTable(const CameraModel& model, int width, int height)
    : model_(model), width_(width), height_(height) {
  if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide) {
    throw InputError("simulated camera", "image size " + std::to_string(width) + " x " + std::to_string(height) +
                                             " is outside 1.." + std::to_string(kMaxImageSide));
  }
  if (!(model.fx > 0 && model.fy > 0)) {
    throw InputError("simulated camera", "the focal length must be greater than 0");
  }
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  x_.reserve(count);
  y_.reserve(count);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const Eigen::Vector2d p = undistort_normalized(model, u, v);
      x_.push_back(static_cast<float>(p.x()));
      y_.push_back(static_cast<float>(p.y()));
    }
  }
}

}  // namespace lakshya::sim

#include "app/nav/nearest_obstacle.h"

#include <cmath>
#include <limits>

#include "kernels/base/units.h"

namespace lakshya {

NearestObstacle nearest_obstacle(ImageView<const std::uint8_t> type, const GridGeometry& geometry) {
  NearestObstacle result;
  // In half cells, so that the middle of a cell is a whole number.
  std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
  for (int r = 0; r < type.height; ++r) {
    const std::int64_t forward = 2 * std::int64_t{r} + 1;
    for (int c = 0; c < type.width; ++c) {
      if (type.at(c, r) != kCellObstacle) continue;
      ++result.cells;
      const std::int64_t left = geometry.cols - 2 * std::int64_t{c} - 1;
      const std::int64_t squared = forward * forward + left * left;
      if (squared < nearest) nearest = squared;
    }
  }
  if (result.cells > 0) result.distance_m = std::sqrt(static_cast<double>(nearest)) * geometry.cell_mm / 2000.0;
  return result;
}

}  // namespace lakshya

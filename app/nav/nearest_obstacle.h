// The obstacle cell nearest to the turning centre, for people who look on; the planners do not use it.
#pragma once

#include <cstdint>

#include "kernels/base/image_view.h"
#include "kernels/base/nav_grid.h"

namespace lakshya {

struct NearestObstacle {
  std::uint32_t cells = 0;  // all obstacle cells of the map
  double distance_m = -1;   // from the turning centre to the middle of the nearest of them; -1: there is none
};

// `type` is geometry's rows x cols cells of CellType.
NearestObstacle nearest_obstacle(ImageView<const std::uint8_t> type, const GridGeometry& geometry);

}  // namespace lakshya

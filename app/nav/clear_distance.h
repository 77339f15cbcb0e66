// How far the vehicle may go in a direction, as the map knows it: docs/contract.md section 5.
// Distances are from the turning centre (not from the bumper), directions in radians counter-clockwise from
// straight ahead, finite. `type` is rows x cols of CellType; everything outside the grid is unknown.
//
// A ray is followed in half-cell steps; what it meets is placed where the ray enters that cell. A ray along the
// border between the two middle columns meets both, and the worse of the two counts (obstacle, then unknown), so
// that mirrored maps give the same distances. A cell whose corner is cut by less than half a step may be passed
// over.
#pragma once

#include <cstdint>

#include "kernels/base/image_view.h"
#include "kernels/base/nav_grid.h"

namespace lakshya {

enum class ClearEnd : std::uint8_t { obstacle, unknown };

struct RayView {
  bool seen = false;  // the first known cell comes within the blind zone (plus one cell)
  double clear_m =
      0;  // to the first cell that is not free; inside the blind zone (plus one cell) unknown cells are passed over
          // when a known one follows there. 0 when not seen
  ClearEnd end = ClearEnd::unknown;  // what is there; the end of the grid is unknown
};

RayView look_along(ImageView<const std::uint8_t> type, const GridGeometry& geometry, double direction,
                   double blind_zone_m);

// Distance to the first obstacle cell whose centre is ahead and at most radius_m beside the ray (at least half a
// cell's diagonal, so that no cell on the ray is missed), to the near face of a cell met square on; infinity
// without one. Unknown cells do not count.
double corridor_obstacle_m(ImageView<const std::uint8_t> type, const GridGeometry& geometry, double direction,
                           double radius_m);

struct ClearDistance {
  double metres = 0;
  ClearEnd end = ClearEnd::unknown;
};

// The nearer of the two above.
ClearDistance clear_distance(ImageView<const std::uint8_t> type, const GridGeometry& geometry, double direction,
                             double blind_zone_m, double radius_m);

}  // namespace lakshya

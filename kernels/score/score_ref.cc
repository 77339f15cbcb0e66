#include "kernels/base/units.h"
#include "kernels/grid_bin/grid_bin.h"
#include "kernels/score/score.h"

namespace lakshya {

Status score_ref(std::span<const CellThresholds> thresholds, std::int32_t min_height_mm, const NavGrid& grid) {
  const GridGeometry& g = grid.geometry;
  if (thresholds.size() != static_cast<std::size_t>(g.rows) * static_cast<std::size_t>(g.cols)) {
    return Status::size_mismatch;
  }
  if (min_height_mm < 0 || !grid_ok(grid)) return Status::bad_argument;
  std::size_t i = 0;
  for (int row = 0; row < g.rows; ++row) {
    for (int col = 0; col < g.cols; ++col, ++i) {
      const std::uint32_t count = grid.count.at(col, row);
      const bool seen = count >= thresholds[i].points;
      const bool high = grid.height_sum.at(col, row) > std::int64_t{min_height_mm} * count;
      const std::uint32_t below_count = grid.below_count.at(col, row);
      const std::uint32_t floor_count = grid.floor_count.at(col, row);
      const bool below = below_count >= thresholds[i].below && below_count > floor_count;
      const bool floor = floor_count >= thresholds[i].floor;
      std::uint8_t& type = grid.type.at(col, row);
      if ((seen && high) || below) {
        type = kCellObstacle;
      } else {
        type = seen || floor ? kCellUnoccupied : kCellUnknown;
      }
    }
  }
  return Status::ok;
}

}  // namespace lakshya

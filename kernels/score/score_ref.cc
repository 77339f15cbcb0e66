#include "kernels/base/units.h"
#include "kernels/grid_bin/grid_bin.h"
#include "kernels/score/score.h"

namespace lakshya {

Status check_score_arguments(std::span<const CellThresholds> thresholds, std::int32_t min_height_mm,
                             const NavGrid& grid) {
  const GridGeometry& g = grid.geometry;
  if (thresholds.size() != static_cast<std::size_t>(g.rows) * static_cast<std::size_t>(g.cols)) {
    return Status::size_mismatch;
  }
  return min_height_mm < 0 || !grid_ok(grid) ? Status::bad_argument : Status::ok;
}

void score_cells_ref(std::span<const CellThresholds> thresholds, std::int32_t min_height_mm, const NavGrid& grid,
                     int row, int begin) {
  for (int col = begin; col < grid.geometry.cols; ++col) {
    const CellThresholds& least = thresholds[static_cast<std::size_t>(col)];
    const std::uint32_t count = grid.count.at(col, row);
    const bool seen = count >= least.points;
    const bool high = grid.height_sum.at(col, row) > std::int64_t{min_height_mm} * count;
    const std::uint32_t below_count = grid.below_count.at(col, row);
    const std::uint32_t floor_count = grid.floor_count.at(col, row);
    const bool below = below_count >= least.below && below_count > floor_count;
    const bool floor = floor_count >= least.floor;
    std::uint8_t& type = grid.type.at(col, row);
    if ((seen && high) || below) {
      type = kCellObstacle;
    } else {
      type = seen || floor ? kCellUnoccupied : kCellUnknown;
    }
  }
}

Status score_ref(std::span<const CellThresholds> thresholds, std::int32_t min_height_mm, const NavGrid& grid) {
  const Status checked = check_score_arguments(thresholds, min_height_mm, grid);
  if (checked != Status::ok) return checked;
  const auto cols = static_cast<std::size_t>(grid.geometry.cols);
  for (int row = 0; row < grid.geometry.rows; ++row)
    score_cells_ref(thresholds.subspan(static_cast<std::size_t>(row) * cols, cols), min_height_mm, grid, row, 0);
  return Status::ok;
}

}  // namespace lakshya

#include <algorithm>
#include <cstring>

#include "kernels/base/integer.h"
#include "kernels/base/units.h"
#include "kernels/grid_bin/grid_bin.h"
#include "kernels/score/score.h"

namespace lakshya {
namespace {

struct About {
  std::uint64_t points = 0;
  std::uint64_t floor = 0;
  std::uint64_t below = 0;
};

About sum_about(const NavGrid& grid, int col, int row) {
  const int cols = grid.geometry.cols;
  const int rows = grid.geometry.rows;
  About sum;
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows - 1); ++r) {
    for (int c = std::max(col - 1, 0); c <= std::min(col + 1, cols - 1); ++c) {
      sum.points += grid.count.at(c, r);
      sum.floor += grid.floor_count.at(c, r);
      sum.below += grid.below_count.at(c, r);
    }
  }
  return sum;
}

bool drops(const CellThresholds& least, const NavGrid& grid, int col, int row) {
  const std::uint32_t below = grid.below_count.at(col, row);
  return below >= least.below && below > grid.floor_count.at(col, row);
}

// An obstacle by its points, or a drop-off, that its surroundings do not bear out.
bool stands_alone(const CellThresholds& least, std::int32_t min_height_mm, const NavGrid& grid, int col, int row) {
  const std::uint32_t count = grid.count.at(col, row);
  const std::uint64_t sure = std::uint64_t{kSurePoints} * least.points;
  const std::int64_t heights = grid.height_sum.at(col, row);
  const bool high = heights > std::int64_t{min_height_mm} * count;
  if (count >= sure && high) return false;
  const About about = sum_about(grid, col, row);
  if (count >= least.points && high && about.points >= sure) {
    const bool low = heights < 2 * std::int64_t{min_height_mm} * count;
    if (!low || count >= grid.floor_count.at(col, row)) return false;
  }
  return !drops(least, grid, col, row) || about.below < std::uint64_t{kSureDrops} * least.below ||
         about.below <= about.floor;
}

// An obstacle by points that lies on the streak of another one.
bool is_smeared(const CellThresholds& least, const NavGrid& grid, int col, int row) {
  const std::uint32_t count = grid.count.at(col, row);
  if (least.streak == 0 || count == 0) return false;  // a drop-off has no points
  for (int k = -static_cast<int>(least.streak); k <= static_cast<int>(least.streak); ++k) {
    const int r = row + static_cast<int>(floor_divide(2 * k * least.per_row + 64, 128));
    const int c = col + static_cast<int>(floor_divide(2 * k * least.per_col + 64, 128));
    if (r < 0 || r >= grid.geometry.rows || c < 0 || c >= grid.geometry.cols) continue;
    if (grid.type.at(c, r) == kCellObstacle && grid.count.at(c, r) / 2 > count) return true;
  }
  return false;
}

// Calls check(thresholds, col, row, type) for the obstacle cells.
template <class Check>
void visit_obstacles(std::span<const CellThresholds> thresholds, const NavGrid& grid, Check&& check) {
  const auto cols = static_cast<std::size_t>(grid.geometry.cols);
  for (int row = 0; row < grid.geometry.rows; ++row) {
    std::uint8_t* const types = grid.type.row(row);
    std::uint8_t* const end = types + cols;
    for (std::uint8_t* type = types; type < end; ++type) {
      type = static_cast<std::uint8_t*>(std::memchr(type, kCellObstacle, static_cast<std::size_t>(end - type)));
      if (type == nullptr) break;
      const auto col = static_cast<std::size_t>(type - types);
      check(thresholds[static_cast<std::size_t>(row) * cols + col], static_cast<int>(col), row, *type);
    }
  }
}

}  // namespace

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
    const bool floor = grid.floor_count.at(col, row) >= least.floor;
    std::uint8_t& type = grid.type.at(col, row);
    if ((seen && high) || drops(least, grid, col, row)) {
      type = kCellObstacle;
    } else {
      type = seen || floor ? kCellUnoccupied : kCellUnknown;
    }
  }
}

void check_weak_cells(std::span<const CellThresholds> thresholds, std::int32_t min_height_mm, const NavGrid& grid) {
  visit_obstacles(thresholds, grid, [&](const CellThresholds& least, int col, int row, std::uint8_t& type) {
    if (!stands_alone(least, min_height_mm, grid, col, row)) return;
    type = grid.floor_count.at(col, row) >= least.floor ? kCellUnoccupied : kCellUnknown;
  });
  visit_obstacles(thresholds, grid, [&](const CellThresholds& least, int col, int row, std::uint8_t& type) {
    if (is_smeared(least, grid, col, row)) type = kCellUnknown;
  });
}

Status score_ref(std::span<const CellThresholds> thresholds, std::int32_t min_height_mm, const NavGrid& grid) {
  const Status checked = check_score_arguments(thresholds, min_height_mm, grid);
  if (checked != Status::ok) return checked;
  const auto cols = static_cast<std::size_t>(grid.geometry.cols);
  for (int row = 0; row < grid.geometry.rows; ++row)
    score_cells_ref(thresholds.subspan(static_cast<std::size_t>(row) * cols, cols), min_height_mm, grid, row, 0);
  check_weak_cells(thresholds, min_height_mm, grid);
  return Status::ok;
}

}  // namespace lakshya

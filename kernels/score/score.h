// Cell scoring: from counts to obstacle, unoccupied or unknown. docs/contract.md section 4.
//
// A surface must show a density of points that falls with distance (the paper's condition on average point density):
//   n_min(z)   = max(n_abs, rho f^2 cell h_ref / z^2 * min(1, cell / (2.5 sigma_z))),  sigma_z = z^2 sigma_d / (f B)
//   n_floor(z) = max(1, rho_f f^2 cell^2 H / z^3);  n_below likewise, at least 2 n_abs
// In this order:
//   count >= n_min and mean height > h_min             obstacle
//   below_count >= n_below and > floor_count           obstacle (drop-off)
//   count >= n_min, or floor_count >= n_floor          unoccupied
//   otherwise                                          unknown: unknown is never free
// What stands alone is none [+]; a thing reaches into the cells beside its own, or smears into those before and behind it, while a few
// wrong matches lie alone. An obstacle with count < kSurePoints n_min is one only if
//   the counts of the 3 x 3 cells about it add up to kSurePoints n_min, and
//   its mean height is at least 2 h_min, or count >= floor_count (noise lifts a little of the floor)
// and a drop-off only if the below_counts about it add up to kSureDrops n_below and to more than the floor_counts. Otherwise the cell is
// unoccupied with floor_count >= n_floor, and unknown without.
// What is smeared is none [+]: the error of a depth draws a thing out along the line of sight, over the more cells the farther it is. An
// obstacle with less than half the points of another one within 2 sigma_z of it on that line, kLongestStreak cells at most, is unknown.
#pragma once

#include <cstdint>
#include <span>

#include "kernels/base/nav_grid.h"
#include "kernels/base/status.h"

namespace lakshya {

// Least counts of one cell, and the line of sight there.
struct CellThresholds {
  std::uint32_t points = 1;
  std::uint32_t floor = 1;
  std::uint32_t below = 1;
  std::int8_t per_row = 0;  // of the direction away from the camera, 1/64 cell per cell
  std::int8_t per_col = 0;
  std::uint16_t streak = 0;  // cells to either side that a depth's error reaches
};
static_assert(sizeof(CellThresholds) == 16, "score_simd loads four words a cell");

// Metres, radians and pixels; camera mount as in prune.h.
struct ScoreGeometry {
  double focal_px = 0;
  double baseline_m = 0;
  double height_m = 0;
  double pitch = 0;
  double yaw = 0;
  double forward_m = 0;
  double left_m = 0;
  double disparity_sigma_px = 0.25;
  double max_disparity_px = 64;      // nothing is seen nearer than f B / max_disparity
  int min_count = 4;                 // n_abs
  double density = 0.15;             // rho
  double reference_height_m = 0.15;  // h_ref
  double floor_density = 0.10;       // rho_f
};

// thresholds[row * cols + col] for each cell, z = camera depth of the cell's centre on the ground, not nearer than
// the camera can see. Rounded up, once. size_mismatch, bad_argument.
Status build_score_table(const GridGeometry& grid, const ScoreGeometry& geometry,
                         std::span<CellThresholds> thresholds);

// Writes grid.type from the counts. thresholds: rows * cols. min_height_mm: h_min. size_mismatch, bad_argument.
Status score_ref(std::span<const CellThresholds> thresholds, std::int32_t min_height_mm, const NavGrid& grid);
Status score_simd(std::span<const CellThresholds> thresholds, std::int32_t min_height_mm, const NavGrid& grid);

inline constexpr std::uint32_t kSurePoints = 5;
inline constexpr std::uint32_t kSureDrops = 3;
inline constexpr int kLongestStreak = 6;

// What both refuse.
Status check_score_arguments(std::span<const CellThresholds> thresholds, std::int32_t min_height_mm,
                             const NavGrid& grid);
// Columns from `begin` of one row by the reference: what a vector does not reach. thresholds: of the row.
void score_cells_ref(std::span<const CellThresholds> thresholds, std::int32_t min_height_mm, const NavGrid& grid,
                     int row, int begin);
// Last for both: few cells are obstacles, and fewer of them weak.
void check_weak_cells(std::span<const CellThresholds> thresholds, std::int32_t min_height_mm, const NavGrid& grid);

}  // namespace lakshya

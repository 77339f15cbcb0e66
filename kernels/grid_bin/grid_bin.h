// Grid binning: counts points into the navigation map. docs/contract.md section 4.
//
//   row = floor(forward / cell), column = floor((cols/2 cells - left) / cell), integer millimetres
//
// An obstacle point nearer than the first row is clamped into it: nothing is dropped for being near. Ground is not
// clamped: floor behind the first row says nothing about it. What lies beside or beyond the map is dropped. Counts grow
// by relaxed atomic adds, so any number of threads gives the same map in any order.
#pragma once

#include <span>

#include "kernels/base/nav_grid.h"
#include "kernels/base/status.h"
#include "kernels/prune/prune.h"

namespace lakshya {

// Sets every count to zero and every type to kCellUnknown. bad_argument: see grid_ok.
Status clear_grid(const NavGrid& grid);

// Adds the counts of `from` in these rows to those of `to`, a map of the same geometry. bad_argument (grids, rows).
Status add_grid(const NavGrid& from, Rows rows, const NavGrid& to);

// True when all planes are rows x cols, the sizes are positive and cols is even.
bool grid_ok(const NavGrid& grid);

// count += 1 and height_sum += height in each point's cell. bad_argument (grid).
Status bin_obstacles_ref(std::span<const ObstaclePoint> points, const NavGrid& grid);

// += 1 in every cell along each strip, both ends included: the strip is sampled at max(|rows|, |columns|) + 1
// evenly spaced points, where |rows| and |columns| are the cells between its ends. `plane` is grid.floor_count or
// grid.below_count. bad_argument (grid), size_mismatch (plane).
Status bin_ground_ref(std::span<const GroundStrip> strips, const NavGrid& grid, ImageView<std::uint32_t> plane);

}  // namespace lakshya

#include <algorithm>
#include <atomic>
#include <cstdlib>

#include "kernels/base/integer.h"
#include "kernels/base/units.h"
#include "kernels/grid_bin/grid_bin.h"

namespace lakshya {
namespace {

struct Cell {
  int row;
  int col;
};

Cell cell_of(const GridGeometry& g, std::int32_t forward_mm, std::int32_t left_mm) {
  return {floor_divide(forward_mm, g.cell_mm), floor_divide(g.cols / 2 * g.cell_mm - left_mm, g.cell_mm)};
}

bool inside(const GridGeometry& g, const Cell& c) {
  return c.row >= 0 && c.row < g.rows && c.col >= 0 && c.col < g.cols;
}

template <class T>
void add(T& counter, T amount) {
  std::atomic_ref<T>(counter).fetch_add(amount, std::memory_order_relaxed);
}

template <class T>
bool plane_ok(const GridGeometry& g, const ImageView<T>& plane) {
  return plane.data != nullptr && plane.width == g.cols && plane.height == g.rows;
}

int samples_of(const GridGeometry& g, const GroundStrip& s) {
  const Cell near = cell_of(g, s.near_forward_mm, s.near_left_mm);
  const Cell far = cell_of(g, s.far_forward_mm, s.far_left_mm);
  return std::max(std::abs(far.row - near.row), std::abs(far.col - near.col));
}

void bin_strip(const GroundStrip& s, const NavGrid& grid, const ImageView<std::uint32_t>& plane) {
  const int steps = samples_of(grid.geometry, s);
  for (int i = 0; i <= steps; ++i) {
    const auto between = [&](std::int32_t near, std::int32_t far) {
      return steps == 0 ? near : near + static_cast<std::int32_t>((std::int64_t{far} - near) * i / steps);
    };
    const Cell c = cell_of(grid.geometry, between(s.near_forward_mm, s.far_forward_mm),
                           between(s.near_left_mm, s.far_left_mm));
    if (inside(grid.geometry, c)) add(plane.at(c.col, c.row), std::uint32_t{1});
  }
}

}  // namespace

bool grid_ok(const NavGrid& grid) {
  const GridGeometry& g = grid.geometry;
  return g.rows > 0 && g.cols > 0 && g.cols % 2 == 0 && g.cell_mm > 0 && plane_ok(g, grid.count) &&
         plane_ok(g, grid.height_sum) && plane_ok(g, grid.floor_count) && plane_ok(g, grid.below_count) &&
         plane_ok(g, grid.type);
}

Status clear_grid(const NavGrid& grid) {
  if (!grid_ok(grid)) return Status::bad_argument;
  for (int r = 0; r < grid.geometry.rows; ++r) {
    std::fill_n(grid.count.row(r), grid.geometry.cols, 0U);
    std::fill_n(grid.height_sum.row(r), grid.geometry.cols, std::int64_t{0});
    std::fill_n(grid.floor_count.row(r), grid.geometry.cols, 0U);
    std::fill_n(grid.below_count.row(r), grid.geometry.cols, 0U);
    std::fill_n(grid.type.row(r), grid.geometry.cols, std::uint8_t{kCellUnknown});
  }
  return Status::ok;
}

Status add_grid(const NavGrid& from, Rows rows, const NavGrid& to) {
  if (!grid_ok(from) || !grid_ok(to) || from.geometry != to.geometry || !rows_inside(rows, to.count))
    return Status::bad_argument;
  const auto add_row = [](const auto& source, int r, const auto& sum) {
    for (int c = 0; c < sum.width; ++c)
      sum.at(c, r) += source.at(c, r);
  };
  for (int r = rows.begin; r < rows.end; ++r) {
    add_row(from.count, r, to.count);
    add_row(from.height_sum, r, to.height_sum);
    add_row(from.floor_count, r, to.floor_count);
    add_row(from.below_count, r, to.below_count);
  }
  return Status::ok;
}

Status bin_obstacles_ref(std::span<const ObstaclePoint> points, const NavGrid& grid) {
  if (!grid_ok(grid)) return Status::bad_argument;
  for (const ObstaclePoint& p : points) {
    Cell c = cell_of(grid.geometry, p.forward_mm, p.left_mm);
    c.row = std::max(c.row, 0);
    if (!inside(grid.geometry, c)) continue;
    add(grid.count.at(c.col, c.row), std::uint32_t{1});
    add(grid.height_sum.at(c.col, c.row), std::int64_t{p.height_mm});
  }
  return Status::ok;
}

Status bin_ground_ref(std::span<const GroundStrip> strips, const NavGrid& grid, ImageView<std::uint32_t> plane) {
  if (!grid_ok(grid)) return Status::bad_argument;
  if (!plane_ok(grid.geometry, plane)) return Status::size_mismatch;
  for (const GroundStrip& s : strips)
    bin_strip(s, grid, plane);
  return Status::ok;
}

}  // namespace lakshya

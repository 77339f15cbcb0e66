// Between the world's cells and the frame's: what rolling_map*.cc share, for nobody else.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "app/nav/map_cells.h"
#include "app/nav/rolling_map.h"

namespace lakshya {

inline std::int64_t wrapped(std::int64_t x, std::int64_t side) {
  const std::int64_t rest = x % side;
  return rest < 0 ? rest + side : rest;
}

// Whole numbers i with 0 <= at + i * step < end, one too many at either side.
struct CellRange {
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();

  void clip(double at, double step, double limit) {
    if (std::abs(step) < 1e-9) {
      if (at < -1 || at > limit + 1) end = begin;
      return;
    }
    const double a = -at / step;
    const double b = (limit - at) / step;
    begin = std::max(begin, std::min(a, b) - 1);
    end = std::min(end, std::max(a, b) + 1);
  }
};

// The frame of the vehicle in units of cells: rows ahead of the turning centre, columns from the grid's left border.
struct RollingMap::Sight {
  Sight(const GridGeometry& g, const Pose& pose, double cell_m)
      : east(pose.east_m / cell_m),
        north(pose.north_m / cell_m),
        cos(std::cos(pose.yaw)),
        sin(std::sin(pose.yaw)),
        half(g.cols / 2.0) {}

  double row(double x, double y) const { return (x - east) * cos + (y - north) * sin; }
  double column(double x, double y) const { return half + (x - east) * sin - (y - north) * cos; }
  double x(double row, double column) const { return east + row * cos + (column - half) * sin; }
  double y(double row, double column) const { return north + row * sin - (column - half) * cos; }

  double east, north, cos, sin, half;
};

// World cells [begin, end) of one world row that may lie in the frame, and where the first of them lies there.
struct RollingMap::Run {
  std::int64_t begin = 0;
  std::int64_t end = 0;
  double row = 0;
  double column = 0;
};

inline RollingMap::Run RollingMap::run_of(const Sight& sight, std::int64_t y) const {
  const double x0 = static_cast<double>(x_begin_) + 0.5;
  const double y0 = static_cast<double>(y) + 0.5;
  Run run{.row = sight.row(x0, y0), .column = sight.column(x0, y0)};
  CellRange range{0.0, static_cast<double>(side_)};
  range.clip(run.row, sight.cos, geometry_.rows);
  range.clip(run.column, sight.sin, geometry_.cols);
  if (!(range.begin < range.end)) return {};
  const double first = std::floor(range.begin);
  run.row += first * sight.cos;
  run.column += first * sight.sin;
  run.begin = x_begin_ + static_cast<std::int64_t>(first);
  run.end = x_begin_ + static_cast<std::int64_t>(std::min(std::ceil(range.end), static_cast<double>(side_)));
  return run;
}

// Calls visit(index, row, column) for the world cells whose centres lie in the frame's grid; row and column in kFraction.
template <class Visit>
void RollingMap::visit_below(const Sight& sight, Visit&& visit) const {
  const auto rows = static_cast<std::uint64_t>(geometry_.rows) << kFraction;
  const auto cols = static_cast<std::uint64_t>(geometry_.cols) << kFraction;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double row : {0.0, static_cast<double>(geometry_.rows)}) {
    for (const double column : {0.0, static_cast<double>(geometry_.cols)}) {
      low = std::min(low, sight.y(row, column));
      high = std::max(high, sight.y(row, column));
    }
  }
  const std::int64_t begin = std::max(y_begin_, cell_of(low) - 1);
  const std::int64_t end = std::min(y_begin_ + side_, cell_of(high) + 2);
  const std::int64_t row_step = fixed(sight.cos);
  const std::int64_t column_step = fixed(sight.sin);
  for (std::int64_t y = begin; y < end; ++y) {
    const Run run = run_of(sight, y);
    const std::size_t line = static_cast<std::size_t>(wrapped(y, side_) * side_);
    const std::size_t line_end = line + static_cast<std::size_t>(side_);
    std::size_t i = line + static_cast<std::size_t>(wrapped(run.begin, side_));
    std::int64_t row = fixed(run.row);
    std::int64_t column = fixed(run.column);
    for (std::int64_t x = run.begin; x < run.end; ++x) {
      // What is negative is very large.
      if (static_cast<std::uint64_t>(row) < rows && static_cast<std::uint64_t>(column) < cols)
        visit(i, row, column);
      row += row_step;
      column += column_step;
      if (++i == line_end) i = line;
    }
  }
}

}  // namespace lakshya

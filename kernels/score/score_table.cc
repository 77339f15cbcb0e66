#include <algorithm>
#include <cmath>

#include "kernels/score/score.h"

namespace lakshya {
namespace {

std::uint32_t at_least(double expected, double least) {
  return static_cast<std::uint32_t>(std::ceil(std::min(std::max(expected, least), 1e9)));
}

double sigma_at(const ScoreGeometry& g, double z) {
  return z * z * g.disparity_sigma_px / (g.focal_px * g.baseline_m);
}

CellThresholds thresholds_at(const ScoreGeometry& g, double cell, double z) {
  const double f2 = g.focal_px * g.focal_px;
  const double sigma_z = sigma_at(g, z);
  const double smear = sigma_z > 0 ? std::min(1.0, cell / (2.5 * sigma_z)) : 1.0;
  const double points = g.density * f2 * cell * g.reference_height_m / (z * z) * smear;
  const double ground = g.floor_density * f2 * cell * cell * g.height_m / (z * z * z);
  const double least = g.min_count;
  // A false drop-off stops a vehicle where there is nothing; a true one that matters fills its cells.
  return {.points = at_least(points, least), .floor = at_least(ground, 1.0), .below = at_least(ground, 2 * least)};
}

// forward, left: metres from the camera. Rows go ahead, columns to the right.
void set_line_of_sight(const ScoreGeometry& g, double cell, double forward, double left, CellThresholds& at) {
  const double range = std::hypot(forward, left);
  if (range <= 0) return;
  constexpr double kUnit = 64;
  at.per_row = static_cast<std::int8_t>(std::lround(kUnit * forward / range));
  at.per_col = static_cast<std::int8_t>(std::lround(-kUnit * left / range));
  at.streak = static_cast<std::uint16_t>(std::min<double>(kLongestStreak, 2 * sigma_at(g, range) / cell));
}

}  // namespace

Status build_score_table(const GridGeometry& grid, const ScoreGeometry& g, std::span<CellThresholds> thresholds) {
  if (thresholds.size() != static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.cols)) {
    return Status::size_mismatch;
  }
  if (!(g.focal_px > 0 && g.baseline_m > 0 && g.height_m > 0 && g.max_disparity_px > 0) || g.min_count < 1) {
    return Status::bad_argument;
  }
  const double cell = grid.cell_mm / 1000.0;
  const double nearest = g.focal_px * g.baseline_m / g.max_disparity_px;
  std::size_t i = 0;
  for (int row = 0; row < grid.rows; ++row) {
    for (int col = 0; col < grid.cols; ++col) {
      const double forward = (row + 0.5) * cell - g.forward_m;
      const double left = (0.5 * grid.cols - col - 0.5) * cell - g.left_m;
      const double ahead = std::cos(g.yaw) * forward + std::sin(g.yaw) * left;
      const double z = std::cos(g.pitch) * ahead + std::sin(g.pitch) * g.height_m;
      thresholds[i] = thresholds_at(g, cell, std::max(z, nearest));
      set_line_of_sight(g, cell, forward, left, thresholds[i++]);
    }
  }
  return Status::ok;
}

}  // namespace lakshya

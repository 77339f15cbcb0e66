// What a step into each cell of the window costs.
#include "app/nav/route_cells.h"

#include <algorithm>
#include <cmath>

#include "app/nav/sectors.h"
#include "kernels/base/units.h"

namespace lakshya {
namespace {

constexpr int kUnknown = 12;      // factor of an unknown cell, beyond that of a free one
constexpr int kUnknownNear = 80;  // ... of one that the camera should have seen
constexpr int kEscape = 150;      // ... of one that is too near to an obstacle, on the way out from there
constexpr int kEscapeCells = 6;
constexpr int kBlank = 4;      // of nine cells about one: a wall, not a spot on the floor
constexpr double kKept = 0.7;  // share of its cost that a cell of the last way has

}  // namespace

// Ground that was looked at in vain is a wall that shows nothing to match where there is more of it than a spot; the way may lead past it at
// the vehicle's distance, not through it. The factors are not in use yet.
void RoutePlanner::close_blank_walls(const RollingMap& map) {
  const auto cell = [](int x, int y) { return static_cast<std::size_t>(index(x, y)); };
  for (int v = 0; v < kRouteSide; ++v) {
    for (int u = 0; u < kRouteSide; ++u)
      memory_.factor[cell(u, v)] =
          memory_.type[cell(u, v)] == kCellUnknown && map.looked_in_vain(x_begin_ + u, y_begin_ + v) ? 1 : 0;
  }
  for (int v = 1; v < kRouteSide - 1; ++v) {
    for (int u = 1; u < kRouteSide - 1; ++u) {
      if (memory_.factor[cell(u, v)] == 0) continue;
      int blank = 0;
      for (int y = v - 1; y <= v + 1; ++y)
        blank += memory_.factor[cell(u - 1, y)] + memory_.factor[cell(u, y)] + memory_.factor[cell(u + 1, y)];
      if (blank >= kBlank) memory_.type[cell(u, v)] = kCellObstacle;
    }
  }
}

// Squared distance of every cell to the nearest obstacle cell, up to kRouteReach.
void RoutePlanner::measure_distances() {
  constexpr auto kNone = static_cast<std::uint8_t>(kRouteReach * kRouteReach + 1);
  std::ranges::fill(memory_.distance2, kNone);
  const auto obstacle = [this](int x, int y) {
    return !inside(x, y) || memory_.type[static_cast<std::size_t>(index(x, y))] == kCellObstacle;
  };
  for (int y = 0; y < kRouteSide; ++y) {
    for (int x = 0; x < kRouteSide; ++x) {
      const auto i = static_cast<std::size_t>(index(x, y));
      if (memory_.type[i] != kCellObstacle) continue;
      memory_.distance2[i] = 0;
      if (obstacle(x + 1, y) && obstacle(x - 1, y) && obstacle(x, y + 1) && obstacle(x, y - 1)) continue;
      const int x0 = std::max(x - kRouteReach, 0);
      const int x1 = std::min(x + kRouteReach, kRouteSide - 1);
      for (int v = std::max(y - kRouteReach, 0); v <= std::min(y + kRouteReach, kRouteSide - 1); ++v) {
        const int dy2 = (v - y) * (v - y);
        std::uint8_t* row = &memory_.distance2[static_cast<std::size_t>(index(0, v))];
        for (int u = x0; u <= x1; ++u) {
          const int d2 = (u - x) * (u - x) + dy2;
          row[u] = static_cast<std::uint8_t>(std::min<int>(row[u], d2));
        }
      }
    }
  }
}

void RoutePlanner::price_cells(const RollingMap& map, const Pose& pose, double x, double y) {
  const int start_x = static_cast<int>(x);
  const int start_y = static_cast<int>(y);
  const int start2 = memory_.distance2[static_cast<std::size_t>(index(start_x, start_y))];
  const double near2 = params_.unknown_near_m * params_.unknown_near_m / (cell_m_ * cell_m_);
  const double blind2 = params_.blind_m * params_.blind_m / (cell_m_ * cell_m_);
  for (int v = 0; v < kRouteSide; ++v) {
    for (int u = 0; u < kRouteSide; ++u) {
      const auto i = static_cast<std::size_t>(index(u, v));
      const int d2 = memory_.distance2[i];
      int factor = price_[static_cast<std::size_t>(d2)];
      if (d2 < closed2_) {
        const int near = std::max(std::abs(u - start_x), std::abs(v - start_y));
        const bool way_out = near <= kEscapeCells && d2 >= std::min(start2, closed2_) - 1 && d2 > 0;
        factor = way_out ? factor + kEscape : kRouteClosed;
      } else if (memory_.type[i] != kCellUnoccupied) {
        const double dx = u + 0.5 - x;
        const double dy = v + 0.5 - y;
        const double r2 = dx * dx + dy * dy;
        const bool should_be_seen =
            r2 > blind2 && r2 < near2 && std::abs(wrap_angle(std::atan2(dy, dx) - pose.yaw)) < params_.view;
        const bool in_vain = should_be_seen || map.looked_in_vain(x_begin_ + u, y_begin_ + v);
        factor += in_vain ? kUnknownNear : kUnknown;
      }
      memory_.factor[i] = static_cast<std::uint8_t>(std::min(factor, 255));
    }
  }
  for (int k = 0; k < count_; ++k) {
    const Point& p = points_[static_cast<std::size_t>(k)];
    const auto u = static_cast<int>(p.x - x_begin_);
    const auto v = static_cast<int>(p.y - y_begin_);
    if (!inside(u, v)) continue;
    std::uint8_t& factor = memory_.factor[static_cast<std::size_t>(index(u, v))];
    if (factor != kRouteClosed) factor = static_cast<std::uint8_t>(std::max<long>(1, std::lround(kKept * factor)));
  }
}

}  // namespace lakshya

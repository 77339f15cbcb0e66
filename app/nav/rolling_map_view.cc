#include <array>
#include <cmath>

#include "app/nav/rolling_map_walk.h"
#include "kernels/base/units.h"

namespace lakshya {

Status RollingMap::view(ImageView<const std::uint8_t> frame, ImageView<std::uint8_t> type) const {
  if (!started_) return Status::bad_argument;
  if (type.height != geometry_.rows || type.width != geometry_.cols || !same_size(frame, type))
    return Status::size_mismatch;
  const Sight sight(geometry_, at_.pose, cell_m_);
  const auto side = static_cast<std::uint64_t>(side_);
  const auto x_wrap = static_cast<std::uint64_t>(x_wrap_);
  const auto y_wrap = static_cast<std::uint64_t>(y_wrap_);
  const std::int64_t x_step = fixed(sight.sin);
  const std::int64_t y_step = fixed(-sight.cos);
  for (int r = 0; r < geometry_.rows; ++r) {
    std::int64_t x = fixed(sight.x(r + 0.5, 0.5) - static_cast<double>(x_begin_));
    std::int64_t y = fixed(sight.y(r + 0.5, 0.5) - static_cast<double>(y_begin_));
    const std::uint8_t* seen_now = frame.row(r);
    std::uint8_t* out = type.row(r);
    for (int c = 0; c < geometry_.cols; ++c, x += x_step, y += y_step) {
      auto u = static_cast<std::uint64_t>(x) >> kFraction;  // what is negative is very large
      auto v = static_cast<std::uint64_t>(y) >> kFraction;
      if (u >= side || v >= side) {
        out[c] = seen_now[c];
        continue;
      }
      u += x_wrap;
      v += y_wrap;
      if (u >= side) u -= side;
      if (v >= side) v -= side;
      out[c] = memory_.evidence[v * side + u] == kFree ? kCellUnoccupied : kCellUnknown;
    }
  }
  const auto mark = [&](std::int64_t row, std::int64_t column) {
    const std::int64_t r = row >> kFraction;
    const std::int64_t c = column >> kFraction;
    if (r >= 0 && c >= 0 && r < geometry_.rows && c < geometry_.cols)
      type.at(static_cast<int>(c), static_cast<int>(r)) = kCellObstacle;
  };
  const std::size_t line = static_cast<std::size_t>(side_);
  const std::size_t cells = line * line;
  visit_below(sight, [&](std::size_t i, std::int64_t row, std::int64_t column) {
    if (memory_.evidence[i] < kFree + kBelieved) return;
    mark(row, column);
    const std::size_t x = i % line;
    const std::size_t y = i - x;
    // Eastwards, westwards, northwards, southwards, until something is known.
    const auto behind = [&](std::size_t cell, std::size_t count, std::int64_t r, std::int64_t c) {
      if (memory_.evidence[cell] != 0) return false;
      const auto n = static_cast<std::int64_t>(count);
      mark(row + n * r, column + n * c);
      return true;
    };
    for (std::size_t n = 1; n <= kThickness && behind(y + (x + n) % line, n, -y_step, x_step); ++n) {
    }
    for (std::size_t n = 1; n <= kThickness && behind(y + (x + line - n) % line, n, y_step, -x_step); ++n) {
    }
    for (std::size_t n = 1; n <= kThickness && behind((i + n * line) % cells, n, x_step, y_step); ++n) {
    }
    for (std::size_t n = 1; n <= kThickness && behind((i + cells - n * line) % cells, n, -x_step, -y_step); ++n) {
    }
  });
  return Status::ok;
}

Status RollingMap::window(std::int64_t x, std::int64_t y, ImageView<std::uint8_t> type) const {
  if (!started_) return Status::bad_argument;
  for (int v = 0; v < type.height; ++v) {
    for (int u = 0; u < type.width; ++u) {
      std::uint8_t& out = type.at(u, v);
      out = kCellUnknown;
      if (!holds(x + u, y + v)) continue;
      const int evidence = memory_.evidence[index(x + u, y + v)];
      if (evidence >= kFree + kBelieved) out = kCellObstacle;
      if (evidence == kFree) out = kCellUnoccupied;
    }
  }
  thicken(type, at_.pose.east_m / cell_m_ - static_cast<double>(x),
          at_.pose.north_m / cell_m_ - static_cast<double>(y));
  return Status::ok;
}

// What was never seen behind a face, as the vehicle at (x, y) looks at it, counts as an obstacle, too. What lies beside it only where the
// vehicle is so near that it will not come into view any more: farther away a doorway may begin there.
void RollingMap::thicken(ImageView<std::uint8_t> type, double from_x, double from_y) const {
  constexpr double kBehindCos = 0.5;
  const double near = (params_.blind_m + kBesideM) / cell_m_;
  constexpr std::uint8_t kBehind = 255;  // until all are found
  constexpr std::array<std::array<int, 2>, 4> kSides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  for (int v = 0; v < type.height; ++v) {
    for (int u = 0; u < type.width; ++u) {
      if (type.at(u, v) != kCellObstacle) continue;
      const double dx = u + 0.5 - from_x;
      const double dy = v + 0.5 - from_y;
      const double range = std::hypot(dx, dy);
      const double least = range < near ? -range : kBehindCos * range;
      for (const auto& [du, dv] : kSides) {
        if (du * dx + dv * dy < least) continue;
        for (int n = 1; n <= static_cast<int>(kThickness); ++n) {
          const int x = u + n * du;
          const int y = v + n * dv;
          if (x < 0 || x >= type.width || y < 0 || y >= type.height) break;
          std::uint8_t& there = type.at(x, y);
          if (there != kCellUnknown && there != kBehind) break;
          there = kBehind;
        }
      }
    }
  }
  for (int v = 0; v < type.height; ++v) {
    for (int u = 0; u < type.width; ++u) {
      if (type.at(u, v) == kBehind) type.at(u, v) = kCellObstacle;
    }
  }
}

}  // namespace lakshya

#include "app/nav/rolling_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/base/units.h"

namespace lakshya {
namespace {

constexpr double kMostCells = 1e8;
constexpr double kNanosecond = 1e-9;

std::int64_t cell_of(double cells) {
  return static_cast<std::int64_t>(std::floor(cells));
}

std::int64_t wrapped(std::int64_t x, std::int64_t side) {
  const std::int64_t rest = x % side;
  return rest < 0 ? rest + side : rest;
}

bool finite(const MapPose& at, double cell_m) {
  const double far = kMostCells * cell_m;
  return std::isfinite(at.pose.yaw) && std::abs(at.pose.east_m) < far && std::abs(at.pose.north_m) < far;
}

bool usable(const RollingMapParams& p) {
  const auto in = [](double value, double most) { return value >= 0 && value <= most; };
  return in(p.keep_s, 1e6) && in(p.near_m, 1e3) && in(p.latency_s, 1e3) && p.deceleration_mps2 > 0 &&
         std::isfinite(p.deceleration_mps2) && in(p.radius_m, 1e2) && p.far_hits >= 1 &&
         p.far_hits <= RollingMap::kBelieved && std::isfinite(p.camera.height_m) &&
         std::isfinite(p.camera.forward_m) && std::isfinite(p.camera.left_m) && std::isfinite(p.camera.yaw) &&
         std::abs(p.camera.angle) <= 1.5;
}

// Whole numbers i with 0 <= at + i * step < end, one too many at either side.
struct Range {
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

}  // namespace

double UpperEdge::height_at(double forward, double left) const {
  const double ahead = (forward - forward_m) * std::cos(yaw) + (left - left_m) * std::sin(yaw);
  if (ahead <= 0) return -std::numeric_limits<double>::infinity();
  return height_m + ahead * std::tan(angle);
}

int rolling_map_side(const GridGeometry& geometry, double size_m) {
  if (geometry.cell_mm <= 0) return 0;
  const double side = std::round(size_m * 1000 / geometry.cell_mm);
  return side >= 1 && side <= kRollingMapMaxSide ? static_cast<int>(side) : 0;
}

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

Status RollingMap::configure(const RollingMapParams& params, const GridGeometry& geometry,
                             const RollingMapMemory& memory) {
  const int side = rolling_map_side(geometry, params.size_m);
  if (side == 0 || geometry.rows <= 0 || geometry.cols <= 0 || !usable(params)) return Status::bad_argument;
  const std::size_t cells = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  if (memory.hits.size() != cells || memory.frees.size() != cells || memory.height.size() != cells ||
      memory.seen.size() != cells)
    return Status::size_mismatch;
  params_ = params;
  geometry_ = geometry;
  memory_ = memory;
  side_ = side;
  cell_m_ = geometry.cell_mm / 1000.0;
  keep_ = static_cast<std::uint32_t>(std::llround(params.keep_s / (kTickNs * kNanosecond)));
  reset();
  return Status::ok;
}

void RollingMap::reset() {
  std::ranges::fill(memory_.hits, std::uint8_t{0});
  std::ranges::fill(memory_.frees, std::uint8_t{0});
  std::ranges::fill(memory_.height, std::int16_t{0});
  std::ranges::fill(memory_.seen, 0U);
  started_ = false;
}

bool RollingMap::holds(std::int64_t x, std::int64_t y) const {
  return x >= x_begin_ && x < x_begin_ + side_ && y >= y_begin_ && y < y_begin_ + side_;
}

std::size_t RollingMap::index(std::int64_t x, std::int64_t y) const {
  return static_cast<std::size_t>(wrapped(y, side_) * side_ + wrapped(x, side_));
}

void RollingMap::forget(std::size_t i) {
  memory_.hits[i] = 0;
  memory_.frees[i] = 0;
  memory_.height[i] = 0;
}

// The square's corner goes to (x, y); rows and columns that come in start empty, in the place of those that leave.
void RollingMap::roll(std::int64_t x, std::int64_t y) {
  const std::int64_t right = std::clamp<std::int64_t>(x - x_begin_, -side_, side_);
  const std::int64_t up = std::clamp<std::int64_t>(y - y_begin_, -side_, side_);
  x_begin_ = x;
  y_begin_ = y;
  const auto entering = [this](std::int64_t begin, std::int64_t moved) {
    return moved > 0 ? Run{.begin = begin + side_ - moved, .end = begin + side_}
                     : Run{.begin = begin, .end = begin - moved};
  };
  const Run columns = entering(x, right);
  const Run rows = entering(y, up);
  for (std::int64_t v = rows.begin; v < rows.end; ++v) {
    for (std::int64_t u = x; u < x + side_; ++u)
      forget(index(u, v));
  }
  for (std::int64_t u = columns.begin; u < columns.end; ++u) {
    for (std::int64_t v = y; v < y + side_; ++v)
      forget(index(u, v));
  }
}

RollingMap::Run RollingMap::run_of(const Sight& sight, std::int64_t y) const {
  const double x0 = static_cast<double>(x_begin_) + 0.5;
  const double y0 = static_cast<double>(y) + 0.5;
  Run run{.row = sight.row(x0, y0), .column = sight.column(x0, y0)};
  Range range{0.0, static_cast<double>(side_)};
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

// Calls visit(index, row, column) for the world cells whose centres lie in the frame's grid.
template <class Visit>
void RollingMap::visit_below(const Sight& sight, Visit&& visit) const {
  const double rows = geometry_.rows;
  const double cols = geometry_.cols;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double row : {0.0, rows}) {
    for (const double column : {0.0, cols}) {
      low = std::min(low, sight.y(row, column));
      high = std::max(high, sight.y(row, column));
    }
  }
  const std::int64_t begin = std::max(y_begin_, cell_of(low) - 1);
  const std::int64_t end = std::min(y_begin_ + side_, cell_of(high) + 2);
  for (std::int64_t y = begin; y < end; ++y) {
    const Run run = run_of(sight, y);
    if (run.begin >= run.end) continue;
    const std::size_t line = static_cast<std::size_t>(wrapped(y, side_) * side_);
    std::int64_t x = wrapped(run.begin, side_);
    for (std::int64_t i = 0; i < run.end - run.begin; ++i, x = x + 1 == side_ ? 0 : x + 1) {
      const double row = run.row + static_cast<double>(i) * sight.cos;
      const double column = run.column + static_cast<double>(i) * sight.sin;
      if (row < 0 || column < 0 || row >= rows || column >= cols) continue;
      visit(line + static_cast<std::size_t>(x), row, column);
    }
  }
}

int RollingMap::weight(double forward, double left, int near, int far) const {
  const double distance = std::hypot(forward, left);
  if (distance <= near_m_) return near;
  return std::max(far, static_cast<int>(near * near_m_ / distance));
}

void RollingMap::see_free(std::size_t i, double forward, double left) {
  if (memory_.hits[i] > 0) {
    if (is_stale(i)) {
      forget(i);
    } else {
      const double height_m = memory_.height[i] / 1000.0;
      if (params_.camera.height_at(forward, left) < height_m + kEdgeMarginM) return;
      const int left_over = memory_.hits[i] - weight(forward, left, kCleared, kClearedFar);
      memory_.hits[i] = static_cast<std::uint8_t>(std::max(0, left_over));
      if (left_over <= 0) memory_.height[i] = 0;
    }
  }
  memory_.frees[i] = 1;
  memory_.seen[i] = now_;
}

void RollingMap::clear_seen_free(const NavGrid& frame, const Sight& sight) {
  visit_below(sight, [&](std::size_t i, double row, double column) {
    const std::uint8_t type = frame.type.at(static_cast<int>(column), static_cast<int>(row));
    if (type == kCellUnoccupied) {
      see_free(i, row * cell_m_, (sight.half - column) * cell_m_);
    } else if (type == kCellObstacle) {
      memory_.frees[i] = 0;
    }
  });
}

void RollingMap::add_obstacles(const NavGrid& frame, const Sight& sight) {
  for (int r = 0; r < geometry_.rows; ++r) {
    for (int c = 0; c < geometry_.cols; ++c) {
      if (frame.type.at(c, r) != kCellObstacle) continue;
      const std::int64_t x = cell_of(sight.x(r + 0.5, c + 0.5));
      const std::int64_t y = cell_of(sight.y(r + 0.5, c + 0.5));
      if (!holds(x, y)) continue;
      const std::size_t i = index(x, y);
      if (memory_.hits[i] > 0 && is_stale(i)) forget(i);
      const int hit = weight((r + 0.5) * cell_m_, (sight.half - c - 0.5) * cell_m_, kBelieved,
                             (kBelieved + params_.far_hits - 1) / params_.far_hits);
      memory_.hits[i] = static_cast<std::uint8_t>(std::min(kMost, memory_.hits[i] + hit));
      memory_.frees[i] = 0;
      memory_.seen[i] = now_;
      const std::uint32_t count = frame.count.at(c, r);
      if (count == 0) continue;  // a drop-off
      const std::int64_t mean = frame.height_sum.at(c, r) / count;
      memory_.height[i] = static_cast<std::int16_t>(std::clamp<std::int64_t>(mean, memory_.height[i], 32767));
    }
  }
}

void RollingMap::stand_here(const Sight& sight) {
  const double radius = params_.radius_m / cell_m_;
  const auto reach = static_cast<std::int64_t>(std::ceil(radius));
  const std::int64_t x0 = cell_of(sight.east);
  const std::int64_t y0 = cell_of(sight.north);
  for (std::int64_t y = y0 - reach; y <= y0 + reach; ++y) {
    for (std::int64_t x = x0 - reach; x <= x0 + reach; ++x) {
      const double distance =
          std::hypot(static_cast<double>(x) + 0.5 - sight.east, static_cast<double>(y) + 0.5 - sight.north);
      if (distance > radius || !holds(x, y)) continue;
      const std::size_t i = index(x, y);
      if (memory_.hits[i] > 0 && (is_stale(i) || distance <= radius - kSunk)) forget(i);
      if (memory_.hits[i] > 0) continue;
      memory_.frees[i] = 1;
      memory_.seen[i] = now_;
    }
  }
}

Status RollingMap::add(const NavGrid& frame, const MapPose& at) {
  const bool fits = frame.geometry == geometry_ && frame.type.height == geometry_.rows &&
                    frame.type.width == geometry_.cols && same_size(frame.count, frame.type) &&
                    same_size(frame.height_sum, frame.type);
  if (side_ == 0 || !fits || !finite(at, cell_m_)) return Status::bad_argument;
  const Sight sight(geometry_, at.pose, cell_m_);
  const std::int64_t x = cell_of(sight.east) - side_ / 2;
  const std::int64_t y = cell_of(sight.north) - side_ / 2;
  double speed = 0;
  if (!started_) {
    first_ns_ = at.time_ns;
    x_begin_ = x;
    y_begin_ = y;
  } else if (at.time_ns > at_.time_ns) {
    const double way = std::hypot(at.pose.east_m - at_.pose.east_m, at.pose.north_m - at_.pose.north_m);
    speed = way / (static_cast<double>(at.time_ns - at_.time_ns) * kNanosecond);
  }
  started_ = true;
  at_ = at;
  now_ = static_cast<std::uint32_t>(std::max<std::int64_t>(0, at.time_ns - first_ns_) / kTickNs);
  near_m_ = params_.near_m + speed * params_.latency_s + speed * speed / (2 * params_.deceleration_mps2);
  roll(x, y);
  clear_seen_free(frame, sight);
  add_obstacles(frame, sight);
  stand_here(sight);
  return Status::ok;
}

Status RollingMap::view(ImageView<const std::uint8_t> frame, ImageView<std::uint8_t> type) const {
  if (!started_) return Status::bad_argument;
  if (type.height != geometry_.rows || type.width != geometry_.cols || !same_size(frame, type))
    return Status::size_mismatch;
  const Sight sight(geometry_, at_.pose, cell_m_);
  const std::int64_t x_wrap = wrapped(x_begin_, side_);
  const std::int64_t y_wrap = wrapped(y_begin_, side_);
  const double x_begin = static_cast<double>(x_begin_);
  const double y_begin = static_cast<double>(y_begin_);
  for (int r = 0; r < geometry_.rows; ++r) {
    const double x0 = sight.x(r + 0.5, 0.5) - x_begin;
    const double y0 = sight.y(r + 0.5, 0.5) - y_begin;
    const std::uint8_t* seen_now = frame.row(r);
    std::uint8_t* out = type.row(r);
    for (int c = 0; c < geometry_.cols; ++c) {
      const double x = x0 + c * sight.sin;
      const double y = y0 - c * sight.cos;
      if (x < 0 || y < 0 || x >= side_ || y >= side_) {
        out[c] = seen_now[c];
        continue;
      }
      std::int64_t u = static_cast<std::int64_t>(x) + x_wrap;
      std::int64_t v = static_cast<std::int64_t>(y) + y_wrap;
      if (u >= side_) u -= side_;
      if (v >= side_) v -= side_;
      const auto i = static_cast<std::size_t>(v * side_ + u);
      const bool is_free = memory_.hits[i] == 0 && memory_.frees[i] != 0 && !is_stale(i);
      out[c] = is_free ? kCellUnoccupied : kCellUnknown;
    }
  }
  visit_below(sight, [&](std::size_t i, double row, double column) {
    if (memory_.hits[i] >= kBelieved && !is_stale(i))
      type.at(static_cast<int>(column), static_cast<int>(row)) = kCellObstacle;
  });
  return Status::ok;
}

}  // namespace lakshya

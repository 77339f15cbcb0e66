#include "app/nav/rolling_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kernels/base/units.h"

namespace lakshya {
namespace {

constexpr double kMostCells = 1e8;
constexpr double kNanosecond = 1e-9;
constexpr std::size_t kThickness = 2;
constexpr std::uint8_t kFree = 1;  // evidence

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
  return in(p.keep_s, 1e6) && in(p.blind_m, 1e2) && in(p.near_m, 1e3) && in(p.latency_s, 1e3) &&
         p.deceleration_mps2 > 0 && std::isfinite(p.deceleration_mps2) && in(p.radius_m, 1e2) && p.far_hits >= 1 &&
         p.far_hits <= RollingMap::kBelieved && std::isfinite(p.camera.height_m) &&
         std::isfinite(p.camera.forward_m) && std::isfinite(p.camera.left_m) && std::isfinite(p.camera.yaw) &&
         std::abs(p.camera.angle) <= 1.5;
}

// A length in cells and 2^-32 of one, so that a step along a row is one addition.
constexpr int kFraction = 32;
std::int64_t fixed(double cells) {
  return std::llround(cells * 0x1p32);
}
double cells_of(std::int64_t length) {
  return static_cast<double>(length) * 0x1p-32;
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
  if (memory.evidence.size() != cells || memory.height.size() != cells || memory.seen.size() != cells)
    return Status::size_mismatch;
  params_ = params;
  geometry_ = geometry;
  memory_ = memory;
  side_ = side;
  cell_m_ = geometry.cell_mm / 1000.0;
  const UpperEdge& camera = params.camera;
  edge_forward_ = std::cos(camera.yaw) * std::tan(camera.angle);
  edge_left_ = std::sin(camera.yaw) * std::tan(camera.angle);
  edge_height_ = camera.height_m - camera.forward_m * edge_forward_ - camera.left_m * edge_left_;
  keep_ = static_cast<std::uint32_t>(std::llround(params.keep_s / (kTickNs * kNanosecond)));
  reset();
  return Status::ok;
}

void RollingMap::reset() {
  std::ranges::fill(memory_.evidence, std::uint8_t{0});
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

void RollingMap::forget_old() {
  if (now_ - swept_ < std::min(kSweepTicks, keep_)) return;
  swept_ = now_;
  std::uint8_t* evidence = memory_.evidence.data();
  const std::uint32_t* seen = memory_.seen.data();
  for (std::size_t i = 0; i < memory_.evidence.size(); ++i)
    evidence[i] = now_ - seen[i] > keep_ ? std::uint8_t{0} : evidence[i];
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
      memory_.evidence[index(u, v)] = 0;
  }
  for (std::int64_t u = columns.begin; u < columns.end; ++u) {
    for (std::int64_t v = y; v < y + side_; ++v)
      memory_.evidence[index(u, v)] = 0;
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

int RollingMap::weight(double forward, double left, int near, int far) const {
  const double squared = forward * forward + left * left;
  if (squared <= near_m_ * near_m_) return near;
  return std::max(far, static_cast<int>(near * near_m_ / std::sqrt(squared)));
}

bool RollingMap::sees_height(std::size_t i, double forward, double left) const {
  const double edge_m = edge_height_ + edge_forward_ * forward + edge_left_ * left;
  return edge_m >= memory_.height[i] / 1000.0 + kEdgeMarginM;
}

void RollingMap::see_free(std::size_t i, double forward, double left) {
  std::uint8_t& evidence = memory_.evidence[i];
  if (evidence > kFree) {
    if (!sees_height(i, forward, left)) return;
    evidence =
        static_cast<std::uint8_t>(std::max<int>(kFree, evidence - weight(forward, left, kCleared, kClearedFar)));
  } else {
    evidence = kFree;
  }
  memory_.seen[i] = now_;
}

void RollingMap::clear_seen_free(const NavGrid& frame, const Sight& sight) {
  visit_below(sight, [&](std::size_t i, std::int64_t row, std::int64_t column) {
    const std::uint8_t type =
        frame.type.at(static_cast<int>(column >> kFraction), static_cast<int>(row >> kFraction));
    if (type == kCellUnoccupied) {
      see_free(i, cells_of(row) * cell_m_, (sight.half - cells_of(column)) * cell_m_);
    } else if (type == kCellObstacle && memory_.evidence[i] == kFree) {
      memory_.evidence[i] = 0;
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
      const int hit = weight((r + 0.5) * cell_m_, (sight.half - c - 0.5) * cell_m_, kBelieved,
                             (kBelieved + params_.far_hits - 1) / params_.far_hits);
      if (memory_.evidence[i] <= kFree) memory_.height[i] = 0;
      const int before = std::max<int>(memory_.evidence[i], kFree);
      memory_.evidence[i] = static_cast<std::uint8_t>(std::min(kFree + kMost, before + hit));
      memory_.seen[i] = now_;
      const std::uint32_t count = frame.count.at(c, r);
      if (count == 0) continue;  // a drop-off
      const std::int64_t mean = frame.height_sum.at(c, r) / count;
      memory_.height[i] = static_cast<std::int16_t>(std::clamp<std::int64_t>(mean, memory_.height[i], 32767));
    }
  }
}

void RollingMap::stand_here(const Sight& sight) {
  const double radius = params_.radius_m / cell_m_ - kSunk;
  const double blind = params_.blind_m / cell_m_;
  const auto reach = static_cast<std::int64_t>(std::ceil(std::max(radius, blind)));
  const std::int64_t x0 = cell_of(sight.east);
  const std::int64_t y0 = cell_of(sight.north);
  for (std::int64_t y = y0 - reach; y <= y0 + reach; ++y) {
    for (std::int64_t x = x0 - reach; x <= x0 + reach; ++x) {
      if (!holds(x, y)) continue;
      const std::size_t i = index(x, y);
      if (memory_.evidence[i] == 0) continue;
      const double distance =
          std::hypot(static_cast<double>(x) + 0.5 - sight.east, static_cast<double>(y) + 0.5 - sight.north);
      if (distance <= radius) memory_.evidence[i] = kFree;
      if (distance <= blind) memory_.seen[i] = now_;
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
  if (!started_) swept_ = 0;
  started_ = true;
  at_ = at;
  now_ = static_cast<std::uint32_t>(std::max<std::int64_t>(0, at.time_ns - first_ns_) / kTickNs);
  near_m_ = params_.near_m + speed * params_.latency_s + speed * speed / (2 * params_.deceleration_mps2);
  roll(x, y);
  stand_here(sight);
  forget_old();
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
  const auto side = static_cast<std::uint64_t>(side_);
  const auto x_wrap = static_cast<std::uint64_t>(wrapped(x_begin_, side_));
  const auto y_wrap = static_cast<std::uint64_t>(wrapped(y_begin_, side_));
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
  thicken(type);
  return Status::ok;
}

// What was never seen behind a face counts as an obstacle there, too; see view().
void RollingMap::thicken(ImageView<std::uint8_t> type) {
  constexpr std::uint8_t kBehind = 255;  // until all are found
  constexpr std::array<std::array<int, 2>, 4> kSides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  for (int v = 0; v < type.height; ++v) {
    for (int u = 0; u < type.width; ++u) {
      if (type.at(u, v) != kCellObstacle) continue;
      for (const auto& [du, dv] : kSides) {
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

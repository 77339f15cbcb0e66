#include "app/nav/rolling_map.h"

#include <algorithm>
#include <cmath>

#include "app/nav/rolling_map_walk.h"
#include "kernels/base/units.h"

namespace lakshya {
namespace {

constexpr double kNanosecond = 1e-9;

bool usable(const RollingMapParams& p) {
  const auto in = [](double value, double most) { return value >= 0 && value <= most; };
  return in(p.keep_s, 1e6) && in(p.blind_m, 1e2) && in(p.near_m, 1e3) && in(p.latency_s, 1e3) &&
         p.deceleration_mps2 > 0 && std::isfinite(p.deceleration_mps2) && in(p.radius_m, 1e2) && p.far_hits >= 1 &&
         p.far_hits <= RollingMap::kBelieved && std::isfinite(p.camera.height_m) &&
         std::isfinite(p.camera.forward_m) && std::isfinite(p.camera.left_m) && std::isfinite(p.camera.yaw) &&
         std::abs(p.camera.angle) <= 1.5 && in(p.view, 1.5) && in(p.row_m, 1e2) && in(p.sight.focal_px, 1e6);
}

}  // namespace

int rolling_map_side(const GridGeometry& geometry, double size_m) {
  if (geometry.cell_mm <= 0) return 0;
  const double side = std::round(size_m * 1000 / geometry.cell_mm);
  return side >= 1 && side <= kRollingMapMaxSide ? static_cast<int>(side) : 0;
}

Status RollingMap::configure(const RollingMapParams& params, const GridGeometry& geometry,
                             const RollingMapMemory& memory) {
  const int side = rolling_map_side(geometry, params.size_m);
  if (side == 0 || geometry.rows <= 0 || geometry.cols <= 0 || !usable(params)) return Status::bad_argument;
  const std::size_t cells = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  if (memory.evidence.size() != cells || memory.height.size() != cells || memory.seen.size() != cells ||
      memory.floor.size() != cells)
    return Status::size_mismatch;
  params_ = params;
  depth_view_ = DepthView(params.sight);
  geometry_ = geometry;
  memory_ = memory;
  side_ = side;
  cell_m_ = geometry.cell_mm / 1000.0;
  const UpperEdge& camera = params.camera;
  edge_forward_ = std::cos(camera.yaw) * std::tan(camera.angle);
  edge_left_ = std::sin(camera.yaw) * std::tan(camera.angle);
  edge_height_ = camera.height_m - camera.forward_m * edge_forward_ - camera.left_m * edge_left_;
  view_cos_ = std::cos(params.view);
  yaw_cos_ = std::cos(camera.yaw);
  yaw_sin_ = std::sin(camera.yaw);
  keep_ = static_cast<std::uint32_t>(std::llround(params.keep_s / (kTickNs * kNanosecond)));
  reset();
  return Status::ok;
}

void RollingMap::reset() {
  std::ranges::fill(memory_.evidence, std::uint8_t{0});
  std::ranges::fill(memory_.height, std::int16_t{0});
  std::ranges::fill(memory_.seen, 0U);
  std::ranges::fill(memory_.floor, std::uint8_t{0});
  started_ = false;
}

bool RollingMap::holds(std::int64_t x, std::int64_t y) const {
  return x >= x_begin_ && x < x_begin_ + side_ && y >= y_begin_ && y < y_begin_ + side_;
}

std::size_t RollingMap::index(std::int64_t x, std::int64_t y) const {
  std::int64_t u = x - x_begin_ + x_wrap_;
  std::int64_t v = y - y_begin_ + y_wrap_;
  if (u >= side_) u -= side_;
  if (v >= side_) v -= side_;
  return static_cast<std::size_t>(v * side_ + u);
}

void RollingMap::forget_old() {
  if (now_ - swept_ < std::min(kSweepTicks, keep_)) return;
  swept_ = now_;
  std::uint8_t* evidence = memory_.evidence.data();
  std::int16_t* height = memory_.height.data();
  const std::uint32_t* seen = memory_.seen.data();
  for (std::size_t i = 0; i < memory_.evidence.size(); ++i) {
    const auto believed = static_cast<std::uint64_t>(std::max<int>(evidence[i] - kFree, kBelieved));
    const std::uint64_t age = now_ - seen[i];
    const bool old = age * kBelieved > keep_ * believed;
    const bool in_vain = evidence[i] == 0 && age <= kVainTimes * keep_;
    height[i] = old && !in_vain ? std::int16_t{0} : height[i];
    evidence[i] = old ? std::uint8_t{0} : evidence[i];
  }
}

// The square's corner goes to (x, y); rows and columns that come in start empty, in the place of those that leave.
void RollingMap::roll(std::int64_t x, std::int64_t y) {
  const std::int64_t right = std::clamp<std::int64_t>(x - x_begin_, -side_, side_);
  const std::int64_t up = std::clamp<std::int64_t>(y - y_begin_, -side_, side_);
  x_begin_ = x;
  y_begin_ = y;
  x_wrap_ = wrapped(x, side_);
  y_wrap_ = wrapped(y, side_);
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

int RollingMap::weight(double forward, double left, int near, int far) const {
  const double squared = forward * forward + left * left;
  if (squared <= near_m_ * near_m_) return near;
  return std::max(far, static_cast<int>(near * near_m_ / std::sqrt(squared)));
}

// An obstacle that the frame shows in a cell, or that lies behind one.
void RollingMap::hit(std::size_t i, int evidence, std::int64_t height_mm) {
  if (memory_.evidence[i] <= kFree) memory_.height[i] = 0;
  const int before = std::max<int>(memory_.evidence[i], kFree);
  memory_.evidence[i] =
      static_cast<std::uint8_t>(std::max(before, std::min(kFree + kMostHits * evidence, before + evidence)));
  memory_.seen[i] = now_;
  memory_.height[i] = static_cast<std::int16_t>(std::clamp<std::int64_t>(height_mm, memory_.height[i], 32767));
}

// Of what hangs, with floor in view below it, only the face is seen, and the floor below its back says nothing: kBody cells of it are taken
// to be there.
void RollingMap::add_body(const Sight& sight, int row, int col, int evidence, std::int64_t height_mm) {
  const double forward = row + 0.5 - params_.camera.forward_m / cell_m_;
  const double right = col + 0.5 - sight.half + params_.camera.left_m / cell_m_;
  const double range = std::hypot(forward, right);
  for (int n = 1; n <= kBody; ++n) {
    const double r = row + 0.5 + n * forward / range;
    const double c = col + 0.5 + n * right / range;
    const std::int64_t x = cell_of(sight.x(r, c));
    const std::int64_t y = cell_of(sight.y(r, c));
    if (holds(x, y)) hit(index(x, y), evidence, height_mm);
  }
}

void RollingMap::add_obstacles(const NavGrid& frame, const Sight& sight) {
  for (int r = 0; r < geometry_.rows; ++r) {
    for (int c = 0; c < geometry_.cols; ++c) {
      if (frame.type.at(c, r) != kCellObstacle) continue;
      const std::int64_t x = cell_of(sight.x(r + 0.5, c + 0.5));
      const std::int64_t y = cell_of(sight.y(r + 0.5, c + 0.5));
      if (!holds(x, y)) continue;
      const std::size_t i = index(x, y);
      const int evidence = weight((r + 0.5) * cell_m_, (sight.half - c - 0.5) * cell_m_, kBelieved,
                                  (kBelieved + params_.far_hits - 1) / params_.far_hits);
      const std::uint32_t count = frame.count.at(c, r);
      const std::int64_t mean = count > 0 ? frame.height_sum.at(c, r) / count : 0;  // none: a drop-off
      const bool hangs = mean >= kBodyMm && kBodyFloor * frame.floor_count.at(c, r) >= count;
      memory_.floor[i] = static_cast<std::uint8_t>(std::max(memory_.floor[i] - 1, 0));
      hit(i, evidence, mean);
      if (hangs) add_body(sight, r, c, evidence, mean);
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
      const double east = static_cast<double>(x) + 0.5 - sight.east;
      const double north = static_cast<double>(y) + 0.5 - sight.north;
      const double squared = east * east + north * north;
      if (radius > 0 && squared <= radius * radius) {
        memory_.evidence[i] = kFree;
        memory_.height[i] = 0;
      }
      if (squared <= blind * blind) memory_.seen[i] = now_;
    }
  }
}

Status RollingMap::add(const NavGrid& frame, const MapPose& at, ImageView<const std::int16_t> disparity) {
  if (side_ == 0 || !frame_fits(frame, geometry_) || !same_size(frame.floor_count, frame.type) ||
      !is_finite(at, cell_m_))
    return Status::bad_argument;
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
  if (!started_) now_ = swept_ = 0;
  started_ = true;
  at_ = at;
  now_ = std::max(now_, static_cast<std::uint32_t>(std::max<std::int64_t>(0, at.time_ns - first_ns_) / kTickNs));
  near_m_ = params_.near_m + speed * params_.latency_s + speed * speed / (2 * params_.deceleration_mps2);
  roll(x, y);
  find_shadows(frame, sight);
  clear_seen_free(frame, sight, disparity);
  add_obstacles(frame, sight);
  stand_here(sight);
  forget_old();
  return Status::ok;
}

}  // namespace lakshya

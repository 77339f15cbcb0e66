#include "app/nav/motion_watch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/nav/map_cells.h"
#include "kernels/base/units.h"

namespace lakshya {
namespace {

constexpr double kNanosecond = 1e-9;
constexpr double kCutM = 0.35;  // half a person and a cell
constexpr double kTurnsRps = 0.15;
constexpr int kGap = 2;  // cells between the cells of one cluster, at most
constexpr int kWrap = kWatchSide - 1;
static_assert((kWatchSide & kWrap) == 0);
constexpr double kMostError = 2;  // cells
constexpr int kOccupied = 128;    // bit of free_run

}  // namespace

// Of a cluster's cells, world cells from the window's corner.
struct MotionWatch::Sums {
  int cells = 0;
  int fresh = 0;
  double x = 0, y = 0;
  int left = kWatchSide, right = 0, low = kWatchSide, high = 0;
};

Status MotionWatch::configure(const MotionWatchParams& params, const GridGeometry& geometry,
                              const MotionWatchMemory& memory) {
  if (geometry.rows <= 0 || geometry.cols <= 0 || geometry.cell_mm <= 0) return Status::bad_argument;
  if (!std::isfinite(params.forward_m) || !std::isfinite(params.left_m) || !std::isfinite(params.yaw) ||
      !(params.view > 0 && params.view <= 1.5) || !(params.blind_m >= 0 && params.blind_m <= 100) ||
      !(params.depth_sigma >= 0 && params.depth_sigma <= 100))
    return Status::bad_argument;
  params_ = params;
  if (memory.free_at.size() != kWatchCells || memory.now.size() != kWatchCells ||
      memory.free_run.size() != kWatchCells)
    return Status::size_mismatch;
  geometry_ = geometry;
  memory_ = memory;
  cell_m_ = geometry.cell_mm / 1000.0;
  reset();
  return Status::ok;
}

void MotionWatch::reset() {
  std::ranges::fill(memory_.free_at, 0U);
  std::ranges::fill(memory_.free_run, std::uint8_t{0});
  std::ranges::fill(memory_.now, static_cast<std::uint8_t>(nothing));
  tracks_ = {};
  mover_count_ = 0;
  cluster_count_ = 0;
  speed_mps_ = 0;
  started_ = false;
}

std::size_t MotionWatch::index(std::int64_t x, std::int64_t y) const {
  return static_cast<std::size_t>((y & kWrap) * kWatchSide + (x & kWrap));
}

bool MotionWatch::holds(std::int64_t x, std::int64_t y) const {
  return x >= x_begin_ && x < x_begin_ + kWatchSide && y >= y_begin_ && y < y_begin_ + kWatchSide;
}

// The window's corner goes to (x, y); what comes in was never seen.
void MotionWatch::roll(std::int64_t x, std::int64_t y) {
  const std::int64_t right = std::clamp<std::int64_t>(x - x_begin_, -kWatchSide, kWatchSide);
  const std::int64_t up = std::clamp<std::int64_t>(y - y_begin_, -kWatchSide, kWatchSide);
  x_begin_ = x;
  y_begin_ = y;
  const std::int64_t u0 = right > 0 ? x + kWatchSide - right : x;
  const std::int64_t v0 = up > 0 ? y + kWatchSide - up : y;
  for (std::int64_t u = u0; u < u0 + std::abs(right); ++u) {
    for (std::int64_t v = y; v < y + kWatchSide; ++v)
      memory_.free_run[index(u, v)] = 0;
  }
  for (std::int64_t v = v0; v < v0 + std::abs(up); ++v) {
    for (std::int64_t u = x; u < x + kWatchSide; ++u)
      memory_.free_run[index(u, v)] = 0;
  }
}

// Every cell of the window asks the frame's cell at its centre.
void MotionWatch::look(const NavGrid& frame, const Pose& pose, std::uint32_t tick) {
  const auto fresh_ticks = static_cast<std::uint32_t>(kFreshNs / kTickNs);
  const double c = std::cos(pose.yaw);
  const double s = std::sin(pose.yaw);
  const auto reach = std::min<std::uint64_t>(static_cast<std::uint64_t>(geometry_.rows),
                                             static_cast<std::uint64_t>(kReachM / cell_m_));
  const std::uint64_t rows = reach << kFraction;
  const std::uint64_t cols = static_cast<std::uint64_t>(geometry_.cols) << kFraction;
  const std::int64_t row_step = fixed(c);
  const std::int64_t column_step = fixed(s);
  fresh_count_ = 0;
  std::ranges::fill(memory_.now, static_cast<std::uint8_t>(nothing));
  for (int v = 0; v < kWatchSide; ++v) {
    const double dx = static_cast<double>(x_begin_) + 0.5 - pose.east_m / cell_m_;
    const double dy = static_cast<double>(y_begin_ + v) + 0.5 - pose.north_m / cell_m_;
    std::int64_t row = fixed(dx * c + dy * s);
    std::int64_t column = fixed(geometry_.cols / 2.0 + dx * s - dy * c);
    for (int u = 0; u < kWatchSide; ++u, row += row_step, column += column_step) {
      // What is negative is very large.
      if (static_cast<std::uint64_t>(row) >= rows || static_cast<std::uint64_t>(column) >= cols) continue;
      const std::uint8_t type =
          frame.type.at(static_cast<int>(column >> kFraction), static_cast<int>(row >> kFraction));
      if (type == kCellUnknown) continue;
      const std::size_t i = index(x_begin_ + u, y_begin_ + v);
      std::uint8_t& run = memory_.free_run[i];
      if (type == kCellUnoccupied) {
        run = static_cast<std::uint8_t>((run & kOccupied) != 0 ? 1 : std::min(run + 1, kOccupied - 1));
        memory_.free_at[i] = tick;
        memory_.now[i] = free;
        continue;
      }
      run |= kOccupied;
      const std::uint32_t free_at = memory_.free_at[i];
      const int free_frames = run & ~kOccupied;
      const bool is_fresh = free_frames > 0 && tick - free_at <= fresh_ticks;
      memory_.now[i] = !is_fresh ? old : free_frames >= kFreeFrames ? fresh : again;
      if (is_fresh && fresh_count_ < kMostFresh)
        fresh_[static_cast<std::size_t>(fresh_count_)] = v * kWatchSide + u;
      fresh_count_ += is_fresh ? 1 : 0;
    }
  }
}

// Takes the fresh cells near (x, y) into the cluster, and those near to them.
void MotionWatch::grow(std::int64_t x, std::int64_t y, Sums& sums) {
  std::array<std::int32_t, kMostFresh> waiting;
  std::size_t count = 0;
  const auto take = [&](std::int64_t cx, std::int64_t cy) {
    std::uint8_t& now = memory_.now[index(cx, cy)];
    if ((now != fresh && now != again) || count >= waiting.size()) return;
    sums.fresh += now == fresh ? 1 : 0;
    now = taken;
    const auto u = static_cast<int>(cx - x_begin_);
    const auto v = static_cast<int>(cy - y_begin_);
    waiting[count++] = v * kWatchSide + u;
    ++sums.cells;
    sums.x += u + 0.5;
    sums.y += v + 0.5;
    sums.left = std::min(sums.left, u);
    sums.right = std::max(sums.right, u);
    sums.low = std::min(sums.low, v);
    sums.high = std::max(sums.high, v);
  };
  take(x, y);
  for (std::size_t k = 0; k < count; ++k) {
    const std::int64_t cx = x_begin_ + waiting[k] % kWatchSide;
    const std::int64_t cy = y_begin_ + waiting[k] / kWatchSide;
    for (int dv = -kGap; dv <= kGap; ++dv) {
      for (int du = -kGap; du <= kGap; ++du) {
        if (holds(cx + du, cy + dv)) take(cx + du, cy + dv);
      }
    }
  }
}

void MotionWatch::find_clusters(const NavGrid& frame, const Pose& pose) {
  cluster_count_ = 0;
  if (fresh_count_ > kMostFresh) return;
  const std::span<const std::int32_t> all(fresh_.data(), static_cast<std::size_t>(fresh_count_));
  const auto beside_old = [&](std::int64_t x, std::int64_t y) {
    const double error_m =
        depth_error_m((static_cast<double>(x) + 0.5) * cell_m_, (static_cast<double>(y) + 0.5) * cell_m_);
    const int reach = 1 + static_cast<int>(std::min(error_m / cell_m_, kMostError));
    for (int dv = -reach; dv <= reach; ++dv) {
      for (int du = -reach; du <= reach; ++du) {
        if (holds(x + du, y + dv) && memory_.now[index(x + du, y + dv)] == old) return true;
      }
    }
    return false;
  };
  for (const std::int32_t place : all) {
    const std::int64_t x = x_begin_ + place % kWatchSide;
    const std::int64_t y = y_begin_ + place / kWatchSide;
    if (beside_old(x, y)) memory_.now[index(x, y)] = edge;
  }
  const double c = std::cos(pose.yaw);
  const double s = std::sin(pose.yaw);
  const auto mean_height_m = [&](double east, double north) {
    const double dx = east - pose.east_m / cell_m_;
    const double dy = north - pose.north_m / cell_m_;
    const auto row = static_cast<int>(std::floor(dx * c + dy * s));
    const auto column = static_cast<int>(std::floor(geometry_.cols / 2.0 + dx * s - dy * c));
    std::int64_t sum = 0;
    std::int64_t points = 0;
    for (int r = std::max(row - 1, 0); r <= std::min(row + 1, geometry_.rows - 1); ++r) {
      for (int k = std::max(column - 1, 0); k <= std::min(column + 1, geometry_.cols - 1); ++k) {
        if (frame.type.at(k, r) != kCellObstacle) continue;
        sum += frame.height_sum.at(k, r);
        points += frame.count.at(k, r);
      }
    }
    return points == 0 ? 0.0 : static_cast<double>(sum) / static_cast<double>(points) / 1000;
  };
  for (const std::int32_t place : all) {
    if (cluster_count_ == clusters_.size()) return;
    const std::int64_t x = x_begin_ + place % kWatchSide;
    const std::int64_t y = y_begin_ + place / kWatchSide;
    Sums sums;
    grow(x, y, sums);
    if (sums.cells < kLeastCells) continue;
    const double extent_m = std::max(sums.right - sums.left, sums.high - sums.low) * cell_m_;
    const double east = static_cast<double>(x_begin_) + sums.x / sums.cells;
    const double north = static_cast<double>(y_begin_) + sums.y / sums.cells;
    if (extent_m > kMostExtentM || mean_height_m(east, north) < kLeastMeanHeightM) continue;
    clusters_[cluster_count_++] = {.east_m = east * cell_m_,
                                   .north_m = north * cell_m_,
                                   .cells = sums.cells,
                                   .fresh = sums.fresh >= kLeastCells,
                                   .cut = is_cut(pose, east * cell_m_, north * cell_m_)};
  }
}

// One standard deviation of where something is seen there.
double MotionWatch::depth_error_m(double east_m, double north_m) const {
  const double east = east_m - at_.pose.east_m;
  const double north = north_m - at_.pose.north_m;
  return params_.depth_sigma * (east * east + north * north);
}

// Where the border of the view is so near that a part of a person may lie beyond, or where no floor is seen and so nothing fresh: what
// is left of him moves with that border.
bool MotionWatch::is_cut(const Pose& pose, double east_m, double north_m) const {
  const double c = std::cos(pose.yaw);
  const double s = std::sin(pose.yaw);
  const double east = east_m - pose.east_m;
  const double north = north_m - pose.north_m;
  if (std::hypot(east, north) < params_.blind_m + kCutM) return true;
  const double forward = east * c + north * s - params_.forward_m;
  const double left = north * c - east * s - params_.left_m;
  const double inside = params_.view - std::abs(std::atan2(left, forward) - params_.yaw);
  return std::hypot(forward, left) * std::sin(std::clamp(inside, -1.5, 1.5)) < kCutM;
}

// An obstacle within `reach` cells; else what the cell itself shows.
MotionWatch::Seen MotionWatch::seen_near(double east_m, double north_m, int reach) const {
  const std::int64_t x = cell_of(east_m / cell_m_);
  const std::int64_t y = cell_of(north_m / cell_m_);
  for (int dv = -reach; dv <= reach; ++dv) {
    for (int du = -reach; du <= reach; ++du) {
      if (!holds(x + du, y + dv)) continue;
      const std::uint8_t now = memory_.now[index(x + du, y + dv)];
      if (now != free && now != nothing) return old;
    }
  }
  return holds(x, y) && memory_.now[index(x, y)] == free ? free : nothing;
}

Status MotionWatch::add(const NavGrid& frame, const MapPose& at) {
  if (memory_.now.empty() || !frame_fits(frame, geometry_) || !is_finite(at, cell_m_)) return Status::bad_argument;
  if (started_ && at.time_ns <= at_.time_ns) reset();
  const std::int64_t x = cell_of(at.pose.east_m / cell_m_) - kWatchSide / 2;
  const std::int64_t y = cell_of(at.pose.north_m / cell_m_) - kWatchSide / 2;
  double dt_s = 0;
  if (!started_) {
    first_ns_ = at.time_ns;
    x_begin_ = x;
    y_begin_ = y;
  } else {
    dt_s = static_cast<double>(at.time_ns - at_.time_ns) * kNanosecond;
    speed_mps_ = std::hypot(at.pose.east_m - at_.pose.east_m, at.pose.north_m - at_.pose.north_m) / dt_s;
    turns_ = std::abs(std::remainder(at.pose.yaw - at_.pose.yaw, 2 * std::numbers::pi)) > kTurnsRps * dt_s;
  }
  started_ = true;
  at_ = at;
  roll(x, y);
  look(frame, at.pose, 1 + static_cast<std::uint32_t>((at.time_ns - first_ns_) / kTickNs));
  find_clusters(frame, at.pose);
  predict(dt_s);
  associate(at.time_ns, dt_s);
  for (Track& t : tracks_) {
    if (t.alive) judge(t, at.time_ns);
  }
  begin_tracks(at.time_ns);
  list_movers(at.time_ns);
  return Status::ok;
}

}  // namespace lakshya

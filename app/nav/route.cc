#include "app/nav/route.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/nav/sectors.h"
#include "kernels/base/units.h"

namespace lakshya {
namespace {

constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
constexpr int kReach = 9;         // cells that distances are known up to
constexpr int kOpen = 10;         // factor of a free cell, tenths
constexpr int kClosed = 0;        // factor of a cell that is none of the way
constexpr int kTight = 60;        // what a cell at the margin costs more than a free one
constexpr int kUnknown = 12;      // ... an unknown one
constexpr int kUnknownNear = 80;  // ... one that the camera should have seen
constexpr int kEscape = 150;      // ... one that is too near to an obstacle, on the way out from there
constexpr int kEscapeCells = 6;
constexpr int kCorner = 60;     // share of the way's least squared distance that a straight line keeps, percent
constexpr int kStopShare = 82;  // of the squared distance that a way keeps: nearer the vehicle stops, percent
constexpr double kKept = 0.7;   // share of its cost that a cell of the last way has
constexpr int kStraight = 10;   // length of a step, tenths of a cell
constexpr int kDiagonal = 14;
constexpr int kSunkCells = 3;
constexpr double kSeenBehind = 3;  // cells behind the blind zone in which its floor may begin to show
constexpr double kBorderWeight = 1.0 * kStraight * kOpen;  // of what is left to go beyond the window, per cell

struct Step {
  int x, y, length;
};
constexpr std::array<Step, 8> kSteps{{{1, 0, kStraight},
                                      {0, 1, kStraight},
                                      {-1, 0, kStraight},
                                      {0, -1, kStraight},
                                      {1, 1, kDiagonal},
                                      {-1, 1, kDiagonal},
                                      {-1, -1, kDiagonal},
                                      {1, -1, kDiagonal}}};

std::int64_t cell_of(double metres, double cell_m) {
  return static_cast<std::int64_t>(std::floor(metres / cell_m));
}

bool in(double value, double least, double most) {
  return value >= least && value <= most;
}

}  // namespace

Status RoutePlanner::configure(const RouteParams& p, std::int32_t cell_mm, const RouteMemory& memory) {
  if (!in(p.radius_m, 0, 100) || !in(p.margin_m, 0, 100) || !in(p.comfort_m, 0, 100) ||
      !in(p.reach_m, 0.01, 1000) || !in(p.blind_m, 0, 1000) || !in(p.view, 0, 4) ||
      !in(p.unknown_near_m, 0, 1000) || cell_mm < 1)
    return Status::bad_argument;
  const auto fits = [](const auto& span) { return span.size() == kRouteCells; };
  if (!fits(memory.type) || !fits(memory.distance2) || !fits(memory.factor) || !fits(memory.cost) ||
      !fits(memory.next) || !fits(memory.previous) || !fits(memory.from))
    return Status::size_mismatch;
  params_ = p;
  memory_ = memory;
  cell_m_ = cell_mm / 1000.0;
  const double least = std::min((p.radius_m + p.margin_m) / cell_m_, kReach - 1.0);
  const double easy = std::min((p.radius_m + p.comfort_m) / cell_m_, static_cast<double>(kReach));
  closed2_ = static_cast<int>(std::floor(least * least));
  for (int d2 = 0; d2 < static_cast<int>(price_.size()); ++d2) {
    const double short_of = std::clamp((easy - std::sqrt(d2)) / std::max(easy - least, 0.01), 0.0, 1.0);
    price_[static_cast<std::size_t>(d2)] =
        static_cast<std::uint8_t>(kOpen + std::lround(kTight * short_of * short_of));
  }
  reset();
  return Status::ok;
}

// Squared distance of every cell to the nearest obstacle cell, up to kReach.
void RoutePlanner::measure_distances() {
  constexpr auto kNone = static_cast<std::uint8_t>(kReach * kReach + 1);
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
      const int x0 = std::max(x - kReach, 0);
      const int x1 = std::min(x + kReach, kRouteSide - 1);
      for (int v = std::max(y - kReach, 0); v <= std::min(y + kReach, kRouteSide - 1); ++v) {
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

void RoutePlanner::remember_place(double x, double y) {
  const Point here{x_begin_ + static_cast<std::int64_t>(x), y_begin_ + static_cast<std::int64_t>(y)};
  if (trail_count_ > 0) {
    const Point& last = trail_[static_cast<std::size_t>((trail_count_ - 1) % kRouteTrail)];
    if (last.x == here.x && last.y == here.y) return;
  }
  trail_[static_cast<std::size_t>(trail_count_ % kRouteTrail)] = here;
  if (++trail_count_ == 2 * kRouteTrail) trail_count_ = kRouteTrail;
}

// What stands within kSunkCells of where the vehicle has been was not there then.
void RoutePlanner::open_trail() {
  for (int k = 0; k < std::min(trail_count_, kRouteTrail); ++k) {
    const Point& p = trail_[static_cast<std::size_t>(k)];
    const auto u = static_cast<int>(p.x - x_begin_);
    const auto v = static_cast<int>(p.y - y_begin_);
    if (!inside(u, v)) continue;
    std::uint8_t& distance2 = memory_.distance2[static_cast<std::size_t>(index(u, v))];
    if (distance2 >= kSunkCells * kSunkCells) distance2 = std::max(distance2, static_cast<std::uint8_t>(closed2_));
  }
}

void RoutePlanner::price_cells(const Pose& pose, double x, double y) {
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
        factor = way_out ? factor + kEscape : kClosed;
      } else if (memory_.type[i] != kCellUnoccupied) {
        const double dx = u + 0.5 - x;
        const double dy = v + 0.5 - y;
        const double r2 = dx * dx + dy * dy;
        const bool should_be_seen =
            r2 > blind2 && r2 < near2 && std::abs(wrap_angle(std::atan2(dy, dx) - pose.yaw)) < params_.view;
        factor += should_be_seen ? kUnknownNear : kUnknown;
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
    if (factor != kClosed) factor = static_cast<std::uint8_t>(std::max<long>(1, std::lround(kKept * factor)));
  }
}

void RoutePlanner::push(int cell, std::int32_t cost) {
  const auto i = static_cast<std::size_t>(cell);
  std::int32_t& head = bucket_[static_cast<std::size_t>(cost % kBuckets)];
  memory_.cost[i] = cost;
  memory_.previous[i] = -1;
  memory_.next[i] = head;
  if (head >= 0) memory_.previous[static_cast<std::size_t>(head)] = cell;
  head = cell;
}

void RoutePlanner::remove(int cell) {
  const auto i = static_cast<std::size_t>(cell);
  const std::int32_t before = memory_.previous[i];
  const std::int32_t after = memory_.next[i];
  if (before >= 0) {
    memory_.next[static_cast<std::size_t>(before)] = after;
  } else {
    bucket_[static_cast<std::size_t>(memory_.cost[i] % kBuckets)] = after;
  }
  if (after >= 0) memory_.previous[static_cast<std::size_t>(after)] = before;
}

// Dijkstra's, with a bucket for each cost (Dial 1969); ends when `goal` (-1: none) is settled.
void RoutePlanner::search(int start, int goal) {
  std::ranges::fill(memory_.cost, kFar);
  bucket_.fill(-1);
  push(start, 0);
  int waiting = 1;
  for (std::int32_t cost = 0; waiting > 0; ++cost) {
    std::int32_t& head = bucket_[static_cast<std::size_t>(cost % kBuckets)];
    while (head >= 0) {
      const int cell = head;
      remove(cell);
      --waiting;
      if (cell == goal) return;
      const int x = cell % kRouteSide;
      const int y = cell / kRouteSide;
      for (std::size_t k = 0; k < kSteps.size(); ++k) {
        const Step& step = kSteps[k];
        if (!inside(x + step.x, y + step.y)) continue;
        const int to = index(x + step.x, y + step.y);
        const auto i = static_cast<std::size_t>(to);
        const int factor = memory_.factor[i];
        if (factor == kClosed) continue;
        const std::int32_t reached = cost + step.length * factor;
        if (reached >= memory_.cost[i]) continue;
        if (memory_.cost[i] == kFar) {
          ++waiting;
        } else {
          remove(to);
        }
        memory_.from[i] = static_cast<std::uint8_t>(k);
        push(to, reached);
      }
    }
  }
}

// The target's cell; where it lies outside, the cell of the border with the least cost and distance left. What cannot be reached is
// replaced by what is nearest to the target.
int RoutePlanner::choose_end(double goal_x, double goal_y) const {
  const bool is_inside = inside(static_cast<int>(std::floor(goal_x)), static_cast<int>(std::floor(goal_y)));
  if (is_inside) {
    const int goal = index(static_cast<int>(goal_x), static_cast<int>(goal_y));
    if (memory_.cost[static_cast<std::size_t>(goal)] != kFar) return goal;
  }
  int best = -1;
  double best_cost = std::numeric_limits<double>::infinity();
  for (int y = 0; y < kRouteSide; ++y) {
    for (int x = 0; x < kRouteSide; ++x) {
      const bool border = x == 0 || y == 0 || x == kRouteSide - 1 || y == kRouteSide - 1;
      if (!is_inside && !border) continue;
      const std::int32_t cost = memory_.cost[static_cast<std::size_t>(index(x, y))];
      if (cost == kFar) continue;
      const double left = std::hypot(x + 0.5 - goal_x, y + 0.5 - goal_y);
      const double total = is_inside ? 1e6 * std::floor(left) + cost : cost + kBorderWeight * left;
      if (total >= best_cost) continue;
      best_cost = total;
      best = index(x, y);
    }
  }
  if (best >= 0) return best;
  for (int cell = 0; cell < kRouteCells; ++cell) {
    if (memory_.cost[static_cast<std::size_t>(cell)] == kFar) continue;
    const double left = std::hypot(cell % kRouteSide + 0.5 - goal_x, cell / kRouteSide + 0.5 - goal_y);
    if (left < best_cost) {
      best_cost = left;
      best = cell;
    }
  }
  return best;
}

// The points of the way, nearest first; a way of more than kRouteMostPoints cells is kept from its begin.
void RoutePlanner::follow_back(int end) {
  int length = 0;
  for (int cell = end; cell != start_; ++length) {
    const Step& step = kSteps[memory_.from[static_cast<std::size_t>(cell)]];
    cell = index(cell % kRouteSide - step.x, cell / kRouteSide - step.y);
  }
  count_ = std::min(length, kRouteMostPoints);
  for (int cell = end, k = length - 1; cell != start_; --k) {
    if (k < kRouteMostPoints)
      points_[static_cast<std::size_t>(k)] = {x_begin_ + cell % kRouteSide, y_begin_ + cell / kRouteSide};
    const Step& step = kSteps[memory_.from[static_cast<std::size_t>(cell)]];
    cell = index(cell % kRouteSide - step.x, cell / kRouteSide - step.y);
  }
}

bool RoutePlanner::straight_is_free(double x, double y, double to_x, double to_y, int least_distance2) const {
  const double length = std::hypot(to_x - x, to_y - y);
  const int steps = static_cast<int>(std::ceil(2 * length));
  for (int k = 1; k <= steps; ++k) {
    const double t = static_cast<double>(k) / steps;
    const int u = static_cast<int>(std::floor(x + t * (to_x - x)));
    const int v = static_cast<int>(std::floor(y + t * (to_y - y)));
    if (!inside(u, v)) return false;
    const auto i = static_cast<std::size_t>(index(u, v));
    if (memory_.distance2[i] < least_distance2 || memory_.factor[i] == kClosed) return false;
  }
  return true;
}

// Along a straight line of the turning centre: to the obstacle before which the vehicle's side comes too near to one (nearer than it
// is already, where it is too near), or to the first cell that is not known to be free. Such cells of the blind zone are passed over
// where a free one follows in it or right behind it: floor that begins where it can be seen began before, too, and where none is
// seen there may be a wall that shows nothing to match.
ClearDistance RoutePlanner::clear_along(double x, double y, double angle) const {
  const double dx = std::cos(angle) / 2;
  const double dy = std::sin(angle) / 2;
  const int least2 =
      std::min<int>(kStopShare * closed2_ / 100, memory_.distance2[static_cast<std::size_t>(start_)]);
  const double blind = params_.blind_m / cell_m_ + kSeenBehind;
  double unknown = 0;  // where the unknown cells begin that no free one has followed yet
  for (int k = 1;; ++k) {
    const int u = static_cast<int>(std::floor(x + k * dx));
    const int v = static_cast<int>(std::floor(y + k * dy));
    const double length = k / 2.0;
    if (!inside(u, v)) return {length * cell_m_, ClearEnd::unknown};
    const auto i = static_cast<std::size_t>(index(u, v));
    if (memory_.distance2[i] < least2) return {length * cell_m_ + params_.radius_m, ClearEnd::obstacle};
    if (memory_.type[i] != kCellUnknown) {
      unknown = 0;
    } else {
      if (unknown == 0) unknown = length;
      if (length > blind) return {unknown * cell_m_, ClearEnd::unknown};
    }
  }
}

void RoutePlanner::aim(const Pose& pose, double x, double y, Route& route) const {
  const double reach = params_.reach_m / cell_m_;
  int least2 = std::numeric_limits<int>::max();
  double aim_x = x + std::cos(pose.yaw);
  double aim_y = y + std::sin(pose.yaw);
  for (int k = 0; k < count_; ++k) {
    const Point& p = points_[static_cast<std::size_t>(k)];
    const auto u = static_cast<int>(p.x - x_begin_);
    const auto v = static_cast<int>(p.y - y_begin_);
    least2 = std::min<int>(least2, memory_.distance2[static_cast<std::size_t>(index(u, v))]);
    const double to_x = u + 0.5;
    const double to_y = v + 0.5;
    // A straight line may cut a corner of the way, but not come much nearer to obstacles.
    const int allowed2 = std::max(closed2_, kCorner * least2 / 100);
    const bool begins = k == 0;  // no straight line may lead farther than to the next cell
    if (!begins && (std::hypot(to_x - x, to_y - y) > reach || !straight_is_free(x, y, to_x, to_y, allowed2))) break;
    aim_x = to_x;
    aim_y = to_y;
  }
  route.direction = wrap_angle(std::atan2(aim_y - y, aim_x - x) - pose.yaw);
  route.straight_m = std::hypot(aim_x - x, aim_y - y) * cell_m_;
}

Status RoutePlanner::plan(const RollingMap& map, const Pose& pose, double target_east_m, double target_north_m,
                          double turning, Route& route) {
  if (!std::isfinite(target_east_m) || !std::isfinite(target_north_m)) return Status::bad_argument;
  route = {};
  x_begin_ = cell_of(pose.east_m, cell_m_) - kRouteSide / 2;
  y_begin_ = cell_of(pose.north_m, cell_m_) - kRouteSide / 2;
  const Status looked = map.window(x_begin_, y_begin_, {memory_.type.data(), kRouteSide, kRouteSide});
  if (looked != Status::ok) return looked;
  const double x = pose.east_m / cell_m_ - static_cast<double>(x_begin_);
  const double y = pose.north_m / cell_m_ - static_cast<double>(y_begin_);
  const double goal_x = target_east_m / cell_m_ - static_cast<double>(x_begin_);
  const double goal_y = target_north_m / cell_m_ - static_cast<double>(y_begin_);
  measure_distances();
  remember_place(x, y);
  open_trail();
  price_cells(pose, x, y);
  start_ = index(static_cast<int>(x), static_cast<int>(y));
  search(start_, -1);
  const int end = choose_end(goal_x, goal_y);
  if (end < 0 || end == start_) {
    count_ = 0;
    return Status::ok;
  }
  follow_back(end);
  route.found = count_ > 0;
  route.cost_m = memory_.cost[static_cast<std::size_t>(end)] * cell_m_ / (kStraight * kOpen);
  route.reaches_target = std::hypot(end % kRouteSide + 0.5 - goal_x, end / kRouteSide + 0.5 - goal_y) <= 1;
  aim(pose, x, y, route);
  const ClearDistance clear = clear_along(x, y, pose.yaw + route.direction);
  route.clear_m = clear.metres;
  route.clear_end = clear.end;
  route.swept_m = std::numeric_limits<double>::infinity();
  for (const double swept : {0.0, route.direction / 2, turning})
    route.swept_m = std::min(route.swept_m, clear_along(x, y, pose.yaw + swept).metres);
  return Status::ok;
}

}  // namespace lakshya

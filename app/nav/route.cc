#include "app/nav/route.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/nav/map_cells.h"
#include "app/nav/route_cells.h"
#include "app/nav/sectors.h"
#include "kernels/base/units.h"

namespace lakshya {
namespace {

constexpr int kTight = 120;           // what a cell at the margin costs more than a free one, tenths
constexpr double kCutCells = 0.5;     // by which a straight line may come nearer to obstacles than the way does
constexpr double kEasyCells = 1.5;    // ... it need not keep more than this from what is closed
constexpr int kStopShare = 82;        // of the squared distance that a way keeps: nearer the vehicle stops, percent
constexpr double kUnsureCells = 1.5;  // by which floor may seem to go on into a wall that shows nothing
constexpr double kSeenBehind = 3;     // cells behind the blind zone in which its floor may begin to show
constexpr double kDear = 2;           // times the straight line
constexpr double kWorthALook = 50.0 * kRouteStraight * kRouteOpen;  // cells that a doubted gap would save
constexpr int kMostStray = 2;  // ... of floor within it, from far away, which say nothing about what is before them

bool in(double value, double least, double most) {
  return value >= least && value <= most;
}

}  // namespace

Status RoutePlanner::configure(const RouteParams& p, std::int32_t cell_mm, const RouteMemory& memory) {
  if (!in(p.radius_m, 0, 100) || !in(p.margin_m, 0, 100) || !in(p.comfort_m, 0, 100) ||
      !in(p.reach_m, 0.01, 1000) || !in(p.blind_m, 0, 1000) || !in(p.view, 0, 4) ||
      !in(p.unknown_near_m, 0, 1000) || !in(p.first_look, 0, 1.6) || cell_mm < 1)
    return Status::bad_argument;
  const auto fits = [](const auto& span) { return span.size() == kRouteCells; };
  if (!fits(memory.type) || !fits(memory.distance2) || !fits(memory.factor) || !fits(memory.cost) ||
      !fits(memory.next) || !fits(memory.previous) || !fits(memory.from))
    return Status::size_mismatch;
  params_ = p;
  memory_ = memory;
  cell_m_ = cell_mm / 1000.0;
  const double least = std::min((p.radius_m + p.margin_m) / cell_m_, kRouteReach - 1.0);
  const double easy = std::min((p.radius_m + p.comfort_m) / cell_m_, static_cast<double>(kRouteReach));
  closed2_ = static_cast<int>(std::floor(least * least));
  for (int d2 = 0; d2 < static_cast<int>(price_.size()); ++d2) {
    const double short_of = std::clamp((easy - std::sqrt(d2)) / std::max(easy - least, 0.01), 0.0, 1.0);
    price_[static_cast<std::size_t>(d2)] =
        static_cast<std::uint8_t>(kRouteOpen + std::lround(kTight * short_of * short_of));
  }
  reset();
  return Status::ok;
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
    if (memory_.distance2[i] < least_distance2 || memory_.factor[i] == kRouteClosed) return false;
  }
  return true;
}

// Where the unknown cells begin that no floor follows on a line until right behind the blind zone; infinity if there are none: floor that
// begins where it can be seen began before, too, and where none is seen there may be a wall that shows nothing to match. An obstacle
// counts as floor does where the floor before it is seen, and beside the way: the way keeps off it.
double RoutePlanner::unseen_from(double x, double y, double dx, double dy, bool beside) const {
  const double blind = params_.blind_m / cell_m_;
  double unknown = std::numeric_limits<double>::infinity();
  int floor = 0;  // half cells in a row
  for (int k = 1; k / 2.0 <= blind + kSeenBehind; ++k) {
    const int u = static_cast<int>(std::floor(x + k * dx));
    const int v = static_cast<int>(std::floor(y + k * dy));
    if (!inside(u, v)) return unknown;
    const std::uint8_t type = memory_.type[static_cast<std::size_t>(index(u, v))];
    const bool known = type == kCellObstacle && (beside || floor > 0);
    floor = type == kCellUnoccupied ? floor + 1 : 0;
    if (known || floor > (k / 2.0 > blind ? 0 : 2 * kMostStray)) unknown = std::numeric_limits<double>::infinity();
    if (type == kCellUnknown) unknown = std::min(unknown, k / 2.0);
  }
  return unknown;
}

// Along a straight line of the turning centre: to the obstacle before which the vehicle's side comes too near to one (nearer than it
// is already, where it is too near), or to the first cell that is not known to be free; in the blind zone to that of the vehicle's
// middle and both its sides.
ClearDistance RoutePlanner::clear_along(double x, double y, double angle) const {
  const double dx = std::cos(angle) / 2;
  const double dy = std::sin(angle) / 2;
  const int least2 =
      std::min<int>(kStopShare * closed2_ / 100, memory_.distance2[static_cast<std::size_t>(start_)]);
  const double blind = params_.blind_m / cell_m_ + kSeenBehind;
  double unseen = std::numeric_limits<double>::infinity();
  for (const double side : {-1.0, 0.0, 1.0}) {
    const double off = 2 * side * params_.radius_m / cell_m_;
    unseen = std::min(unseen, unseen_from(x - off * dy, y + off * dx, dx, dy, side != 0));
  }
  for (int k = 1;; ++k) {
    const int u = static_cast<int>(std::floor(x + k * dx));
    const int v = static_cast<int>(std::floor(y + k * dy));
    const double length = k / 2.0;
    const double known_m = std::max(length - kUnsureCells, 0.0) * cell_m_;
    if (!inside(u, v) || length >= unseen) return {known_m, ClearEnd::unknown};
    const auto i = static_cast<std::size_t>(index(u, v));
    if (memory_.distance2[i] < least2) return {length * cell_m_ + params_.radius_m, ClearEnd::obstacle};
    if (memory_.type[i] == kCellUnknown && length > blind) return {known_m, ClearEnd::unknown};
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
    const double keeps = std::min(std::sqrt(least2) - kCutCells, std::sqrt(closed2_) + kEasyCells);
    const int allowed2 = std::max(closed2_, static_cast<int>(std::ceil(keeps * std::max(keeps, 0.0))));
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
  x_begin_ = cell_of(pose.east_m / cell_m_) - kRouteSide / 2;
  y_begin_ = cell_of(pose.north_m / cell_m_) - kRouteSide / 2;
  const Status looked = map.window(x_begin_, y_begin_, {memory_.type.data(), kRouteSide, kRouteSide});
  if (looked != Status::ok) return looked;
  const double x = pose.east_m / cell_m_ - static_cast<double>(x_begin_);
  const double y = pose.north_m / cell_m_ - static_cast<double>(y_begin_);
  const double goal_x = target_east_m / cell_m_ - static_cast<double>(x_begin_);
  const double goal_y = target_north_m / cell_m_ - static_cast<double>(y_begin_);
  if (look_round(pose, target_east_m, target_north_m, route)) return Status::ok;
  close_blank_walls(map);
  measure_distances();
  price_cells(map, pose, x, y);
  start_ = index(static_cast<int>(x), static_cast<int>(y));
  search();
  int end = choose_end(goal_x, goal_y);
  const bool leads = reaches(end, goal_x, goal_y);
  const double cost = leads ? cost_to_goal(end, goal_x, goal_y) : std::numeric_limits<double>::infinity();
  dear_ = cost - kWorthALook;
  if (cost < kDear * kRouteStraight * kRouteOpen * std::hypot(goal_x - x, goal_y - y)) {
    looked_at_count_ = looks_ = doubts_ = plans_ = 0;
  } else {
    ++plans_;
    const int nearest = end;
    end = look_again(map, pose, x, y, goal_x, goal_y, route);
    if (route.looks) {
      count_ = 0;
      return Status::ok;
    }
    if (end < 0) end = nearest;
  }
  if (end < 0 || end == start_) {
    count_ = 0;
    return Status::ok;
  }
  follow_back(end);
  route.found = count_ > 0;
  route.cost_m = memory_.cost[static_cast<std::size_t>(end)] * cell_m_ / (kRouteStraight * kRouteOpen);
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

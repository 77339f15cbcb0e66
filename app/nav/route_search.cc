// Dijkstra's search on the window's cells, its end and its way.
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/nav/route_cells.h"

namespace lakshya {
namespace {

constexpr double kBorderWeight =
    1.0 * kRouteStraight * kRouteOpen;  // of what is left to go beyond the window, per cell

}  // namespace

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

// Dijkstra's, with a bucket for each cost (Dial 1969), from the vehicle's cell to all.
void RoutePlanner::search() {
  std::ranges::fill(memory_.cost, kRouteFar);
  bucket_.fill(-1);
  push(start_, 0);
  int waiting = 1;
  for (std::int32_t cost = 0; waiting > 0; ++cost) {
    std::int32_t& head = bucket_[static_cast<std::size_t>(cost % kBuckets)];
    while (head >= 0) {
      const int cell = head;
      remove(cell);
      --waiting;
      const int x = cell % kRouteSide;
      const int y = cell / kRouteSide;
      for (std::size_t k = 0; k < kRouteSteps.size(); ++k) {
        const RouteStep& step = kRouteSteps[k];
        if (!inside(x + step.x, y + step.y)) continue;
        const int to = index(x + step.x, y + step.y);
        const auto i = static_cast<std::size_t>(to);
        const int factor = memory_.factor[i];
        if (factor == kRouteClosed) continue;
        const std::int32_t reached = cost + step.length * factor;
        if (reached >= memory_.cost[i]) continue;
        if (memory_.cost[i] == kRouteFar) {
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
    if (memory_.cost[static_cast<std::size_t>(goal)] != kRouteFar) return goal;
  }
  int best = -1;
  double best_cost = std::numeric_limits<double>::infinity();
  for (int y = 0; y < kRouteSide; ++y) {
    for (int x = 0; x < kRouteSide; ++x) {
      const bool border = x == 0 || y == 0 || x == kRouteSide - 1 || y == kRouteSide - 1;
      if (!is_inside && !border) continue;
      const std::int32_t cost = memory_.cost[static_cast<std::size_t>(index(x, y))];
      if (cost == kRouteFar) continue;
      const double left = std::hypot(x + 0.5 - goal_x, y + 0.5 - goal_y);
      const double total = is_inside ? 1e6 * std::floor(left) + cost : cost + kBorderWeight * left;
      if (total >= best_cost) continue;
      best_cost = total;
      best = index(x, y);
    }
  }
  if (best >= 0) return best;
  for (int cell = 0; cell < kRouteCells; ++cell) {
    if (memory_.cost[static_cast<std::size_t>(cell)] == kRouteFar) continue;
    const double left = std::hypot(cell % kRouteSide + 0.5 - goal_x, cell / kRouteSide + 0.5 - goal_y);
    if (left < best_cost) {
      best_cost = left;
      best = cell;
    }
  }
  return best;
}

// Of a way that ends there, with the straight line that is left.
double RoutePlanner::cost_to_goal(int end, double goal_x, double goal_y) const {
  const double left = std::hypot(end % kRouteSide + 0.5 - goal_x, end / kRouteSide + 0.5 - goal_y);
  return memory_.cost[static_cast<std::size_t>(end)] + kBorderWeight * left;
}

// Whether a way that ends there leads on: to the target, or out of the window towards it.
bool RoutePlanner::reaches(int end, double goal_x, double goal_y) const {
  if (end < 0) return false;
  const int x = end % kRouteSide;
  const int y = end / kRouteSide;
  if (!inside(static_cast<int>(std::floor(goal_x)), static_cast<int>(std::floor(goal_y))))
    return x == 0 || y == 0 || x == kRouteSide - 1 || y == kRouteSide - 1;
  return std::hypot(x + 0.5 - goal_x, y + 0.5 - goal_y) <= kRouteNear;
}

// On the way from the vehicle to a cell that the search has reached.
int RoutePlanner::cell_before(int cell) const {
  const RouteStep& step = kRouteSteps[memory_.from[static_cast<std::size_t>(cell)]];
  return index(cell % kRouteSide - step.x, cell / kRouteSide - step.y);
}

// The points of the way, nearest first; a way of more than kRouteMostPoints cells is kept from its begin.
void RoutePlanner::follow_back(int end) {
  int length = 0;
  for (int cell = end; cell != start_; cell = cell_before(cell))
    ++length;
  count_ = std::min(length, kRouteMostPoints);
  for (int cell = end, k = length - 1; cell != start_; cell = cell_before(cell), --k) {
    if (k < kRouteMostPoints)
      points_[static_cast<std::size_t>(k)] = {x_begin_ + cell % kRouteSide, y_begin_ + cell / kRouteSide};
  }
}

}  // namespace lakshya

// Where no way leads to the target: which closed place is most likely to be open after all, and where to look at it from.
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "app/nav/route_cells.h"
#include "app/nav/sectors.h"
#include "kernels/base/units.h"

namespace lakshya {
namespace {

// Factors of closed cells for the question which of them the way would lead through, by what is left of the vehicle's radius.
constexpr std::uint8_t kThrough = 255;
constexpr std::uint8_t kHardly = 200;
constexpr std::uint8_t kNearly = 100;
constexpr int kHardly2 = 4;  // squared distances to the nearest obstacle cell, from which on
constexpr int kNearly2 = 9;

constexpr double kLeastWay = 12;  // cells between the vehicle that looks and the place
constexpr double kMostWay = 18;
constexpr double kArrived = 2;   // cells
constexpr double kFaces = 0.25;  // rad
constexpr double kBeyond =
    0.5;  // rad that it aims farther than it turns, so that it does not slow down before it has
constexpr double kJump = 0.4;     // rad from plan to plan: the heading has only been found now
constexpr int kFirstPlans = 80;   // at most, for both sides
constexpr int kLooks = 8;         // plans for which it faces the place
constexpr int kLeaves = 40;       // plans for which it leaves a place alone, for each time that it has looked at it
constexpr int kLeavesLong = 200;  // ... while there is another way
constexpr int kSeldom = 5;        // plans after which it looks for a better way than that again
constexpr int kInsists = 4;       // times that it looks at a gap before it looks at what is none
constexpr int kDoubtedFor = 100;  // plans after which it gives up going there
constexpr double kSamePlace = 10;   // cells
constexpr double kPlaceItself = 6;  // cells before it that may hide it: they are what is doubted

}  // namespace

bool RoutePlanner::is_same_place(const Point& place, double u, double v) const {
  const double du = static_cast<double>(place.x - x_begin_) - u;
  const double dv = static_cast<double>(place.y - y_begin_) - v;
  return du * du + dv * dv < kSamePlace * kSamePlace;
}

// ... not long ago, or too often.
bool RoutePlanner::has_been_looked_at(double u, double v) const {
  for (int k = 0; k < looked_at_count_; ++k) {
    const LookedAt& was = looked_at_[static_cast<std::size_t>(k)];
    const bool leaves = plans_ < was.until && was.times >= insists_;
    if (leaves && is_same_place(was.place, u, v)) return true;
  }
  return false;
}

// Lets the search through closed cells, at a price; through obstacle cells only if `all`. What has been looked at stays closed.
void RoutePlanner::open_closed_cells(bool all) {
  for (int cell = 0; cell < kRouteCells; ++cell) {
    const auto i = static_cast<std::size_t>(cell);
    const int d2 = memory_.distance2[i];
    if (memory_.factor[i] != kRouteClosed || (d2 == 0 && !all)) continue;
    if (looked_at_count_ > 0 && has_been_looked_at(cell % kRouteSide, cell / kRouteSide)) continue;
    memory_.type[i] |= kRouteShut;
    memory_.factor[i] = d2 < kHardly2 ? kThrough : (d2 < kNearly2 ? kHardly : kNearly);
  }
}

// Lets the search through where nothing would be too near but for obstacles on ground that was free before.
void RoutePlanner::open_where_ground_was_free(const RollingMap& map) {
  for (int cell = 0; cell < kRouteCells; ++cell) {
    std::uint8_t& type = memory_.type[static_cast<std::size_t>(cell)];
    const int u = cell % kRouteSide;
    const int v = cell / kRouteSide;
    if (type != kCellObstacle || !map.was_free(x_begin_ + u, y_begin_ + v)) continue;
    if (!has_been_looked_at(u, v)) type |= kRouteCame;
  }
  measure_distances();
  for (std::size_t i = 0; i < memory_.type.size(); ++i) {
    if (memory_.factor[i] != kRouteClosed || memory_.distance2[i] < closed2_) continue;
    memory_.type[i] |= kRouteShut;
    memory_.factor[i] = kNearly;
  }
}

void RoutePlanner::close_again(Through what) {
  for (std::size_t i = 0; i < memory_.type.size(); ++i) {
    if ((memory_.type[i] & kRouteShut) != 0) memory_.factor[i] = kRouteClosed;
    memory_.type[i] = static_cast<std::uint8_t>(memory_.type[i] & ~(kRouteShut | kRouteCame));
  }
  if (what == Through::comers) measure_distances();
}

// The first closed cell of the cheapest way that goes through closed cells; -1: none.
int RoutePlanner::place_on_the_way(const RollingMap& map, Through what, double goal_x, double goal_y) {
  if (what == Through::comers) {
    open_where_ground_was_free(map);
  } else {
    open_closed_cells(what == Through::all);
  }
  search();
  const int end = choose_end(goal_x, goal_y);
  int place = -1;
  if (reaches(end, goal_x, goal_y) && cost_to_goal(end, goal_x, goal_y) < dear_) {
    for (int cell = end; cell != start_; cell = cell_before(cell)) {
      if ((memory_.type[static_cast<std::size_t>(cell)] & kRouteShut) != 0) place = cell;
    }
  }
  close_again(what);
  return place;
}

// The place to look at: where something has come to ground that was free, or a gap, that it did not look at not long ago; else one at
// which it did, for somebody may stand there who will go on; else where the way is barred by least. When all were looked at, the same
// once more. -1: none. Leaves the factors as they were, and the costs of the search from the vehicle through what is open.
int RoutePlanner::doubtful_place(const RollingMap& map, double goal_x, double goal_y) {
  const auto find = [&](int insists, std::initializer_list<Through> ways) {
    insists_ = insists;
    int place = -1;
    for (auto what = ways.begin(); place < 0 && what != ways.end(); ++what)
      place = place_on_the_way(map, *what, goal_x, goal_y);
    insists_ = 0;
    return place;
  };
  int place = find(0, {Through::comers, Through::gaps});
  if (std::isfinite(dear_)) {
    search();
    return place;
  }
  const bool has_looked = looked_at_count_ > 0;  // else the same searches would find the same
  if (place < 0 && has_looked) place = find(2 * kInsists, {Through::comers});
  if (place < 0 && has_looked) place = find(kInsists, {Through::gaps});
  if (place < 0) place = find(0, {Through::all});
  if (place < 0 && has_looked) {
    looked_at_count_ = 0;
    place = find(0, {Through::comers, Through::gaps, Through::all});
  }
  search();
  return place;
}

bool RoutePlanner::sees(double x, double y, double place_x, double place_y) const {
  const double length = std::hypot(place_x - x, place_y - y);
  const int steps = static_cast<int>(2 * (length - kPlaceItself));
  for (int k = 1; k <= steps; ++k) {
    const double t = k / (2 * length);
    const auto u = static_cast<int>(x + t * (place_x - x));
    const auto v = static_cast<int>(y + t * (place_y - y));
    if (memory_.distance2[static_cast<std::size_t>(index(u, v))] == 0) return false;
  }
  return true;
}

// The cell from which the place is in view at a good distance that costs least; -1: none.
int RoutePlanner::view_point(int place) const {
  const int px = place % kRouteSide;
  const int py = place / kRouteSide;
  const int reach = static_cast<int>(kMostWay);
  int best = -1;
  for (int v = std::max(py - reach, 0); v <= std::min(py + reach, kRouteSide - 1); ++v) {
    for (int u = std::max(px - reach, 0); u <= std::min(px + reach, kRouteSide - 1); ++u) {
      const double way = std::hypot(u - px, v - py);
      const std::int32_t cost = memory_.cost[static_cast<std::size_t>(index(u, v))];
      if (way < kLeastWay || way > kMostWay || cost == kRouteFar) continue;
      if (best >= 0 && cost >= memory_.cost[static_cast<std::size_t>(best)]) continue;
      if (sees(u + 0.5, v + 0.5, px + 0.5, py + 0.5)) best = index(u, v);
    }
  }
  return best;
}

// Somebody may have stood in the only gap: what is the best way but for one place is looked at again before all others have been, each
// time later.
void RoutePlanner::note_looked_at() {
  looks_ = doubts_ = 0;
  const auto u = static_cast<double>(doubted_.x - x_begin_);
  const auto v = static_cast<double>(doubted_.y - y_begin_);
  int k = 0;
  while (k < looked_at_count_ && !is_same_place(looked_at_[static_cast<std::size_t>(k)].place, u, v))
    ++k;
  if (k == looked_at_count_) {
    if (k == kRouteLooks) k = looked_at_count_ = 0;  // all once more
    looked_at_[static_cast<std::size_t>(k)] = {};
    ++looked_at_count_;
  }
  LookedAt& now = looked_at_[static_cast<std::size_t>(k)];
  now.place = doubted_;
  now.until = plans_ + (std::isfinite(dear_) ? kLeavesLong : kLeaves) * ++now.times;
}

bool RoutePlanner::is_closed(const Point& place) const {
  const auto u = static_cast<int>(place.x - x_begin_);
  const auto v = static_cast<int>(place.y - y_begin_);
  return inside(u, v) && memory_.factor[static_cast<std::size_t>(index(u, v))] == kRouteClosed;
}

// The place that was chosen stays the one, while it is closed and not for ever: which way is the cheapest changes with every frame, and
// the vehicle would turn to and fro between two of them.
bool RoutePlanner::choose_doubt(const RollingMap& map, double goal_x, double goal_y) {
  if (doubts_ > 0 && is_closed(doubted_)) {
    if (--doubts_ > 0) return true;
    note_looked_at();
  }
  doubts_ = looks_ = 0;
  if (std::isfinite(dear_) && plans_ % kSeldom != 1) return false;
  const int place = doubtful_place(map, goal_x, goal_y);
  if (place < 0) return false;
  doubted_ = {x_begin_ + place % kRouteSide, y_begin_ + place / kRouteSide};
  doubts_ = kDoubtedFor;
  return true;
}

// To the side where the target is not, then to the other; true while it does. One that cannot turn gives up.
bool RoutePlanner::look_round(const Pose& pose, double target_east_m, double target_north_m, Route& route) {
  if (params_.first_look <= 0 || first_looks_ >= 2) return false;
  const bool jumped = std::abs(wrap_angle(pose.yaw - last_yaw_)) > kJump;
  last_yaw_ = pose.yaw;
  if (first_plans_ == 0 || jumped) {
    first_looks_ = 0;
    first_yaw_ = pose.yaw;
    const double to_target = std::atan2(target_north_m - pose.north_m, target_east_m - pose.east_m);
    first_side_ = wrap_angle(to_target - pose.yaw) > 0 ? -1 : 1;
  }
  const double side = first_looks_ == 0 ? first_side_ : -first_side_;
  const double left = wrap_angle(first_yaw_ + side * params_.first_look - pose.yaw);
  if (side * left <= 0) ++first_looks_;
  route.direction = wrap_angle(left + side * kBeyond);
  if (++first_plans_ >= kFirstPlans) first_looks_ = 2;
  route.found = true;
  route.looks = true;
  return true;
}

int RoutePlanner::look_again(const RollingMap& map, const Pose& pose, double x, double y, double goal_x,
                             double goal_y, Route& route) {
  if (!choose_doubt(map, goal_x, goal_y)) return -1;
  const auto u = static_cast<int>(doubted_.x - x_begin_);
  const auto v = static_cast<int>(doubted_.y - y_begin_);
  const double dx = u + 0.5 - x;
  const double dy = v + 0.5 - y;
  const double way = std::hypot(dx, dy);
  const bool stands_well = way > kLeastWay - kArrived && way < kMostWay + kArrived && sees(x, y, u + 0.5, v + 0.5);
  if (!stands_well) {
    looks_ = 0;
    const int from = view_point(index(u, v));
    if (from < 0) note_looked_at();
    return from;
  }
  route.found = true;
  route.looks = true;
  route.direction = wrap_angle(std::atan2(dy, dx) - pose.yaw);
  if (std::abs(route.direction) > kFaces) return start_;
  if (++looks_ >= kLooks) note_looked_at();
  return start_;
}

}  // namespace lakshya

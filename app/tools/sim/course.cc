#include "app/tools/sim/course.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/tools/sim/world_generator.h"

namespace lakshya::sim {
namespace {

constexpr double kStartClearM = 0.92;
constexpr double kGoalClearM = 0.82;
constexpr double kLeastGapM = 2 * kWayRadiusM;
constexpr double kMostGapM = 1.75;     // 2.5 vehicle widths: wider and nobody needs to steer
constexpr double kAgainstWallM = 0.3;  // no one tries to get through there

}  // namespace

void Course::name(Thing& thing) {
  thing.name = thing.kind + " " + std::to_string(++count_[thing.kind]);
}

void Course::add_boundary(Thing thing) {
  name(thing);
  boundary_.push_back(footprint_of(thing));
  world_.things.push_back(std::move(thing));
}

void Course::add(Thing thing) {
  name(thing);
  world_.things.push_back(std::move(thing));
}

bool Course::reserve(const Rect& rect, bool driven) {
  const Footprint footprint = footprint_of(rect);
  if (!fits(footprint, false, kNothing)) return false;
  things_.push_back({footprint, kNothing, driven});
  return true;
}

bool Course::begin(double cell_m) {
  Rect all = rooms_.front();
  area_m2_ = 0;
  for (const Rect& r : rooms_) {
    all = {std::min(all.x0, r.x0), std::min(all.y0, r.y0), std::max(all.x1, r.x1), std::max(all.y1, r.y1)};
    area_m2_ += (r.x1 - r.x0) * (r.y1 - r.y0);
  }
  space_.emplace(world_.ground, all, cell_m, kWayRadiusM + 0.02);
  for (const Thing& thing : world_.things)
    space_->add(thing);
  way_ = space_->path(start(), world_.goals.front(), kWayRadiusM);
  return !way_.empty();
}

bool Course::fits(const Footprint& footprint, bool close, int beside) {
  if (footprint.empty()) return false;
  if (std::none_of(rooms_.begin(), rooms_.end(), [&](const Rect& r) { return inside(footprint, r); })) return false;
  if (distance_to(footprint, start()) < kStartClearM) return false;
  if (distance_to(footprint, world_.goals.front()) < kGoalClearM) return false;
  for (const Clear& c : clear_) {
    if (distance_to(footprint, c.point) < c.radius_m) return false;
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (const Known& known : things_) {
    if (beside >= 0 && known.thing == beside) continue;
    const double gap = gap_between(footprint, known.footprint);
    if (gap < kLeastGapM) return false;
    nearest = std::min(nearest, gap);
  }
  // Few gaps to a wall are neither a way nor closed.
  const bool any_gap = random_.chance(0.15);
  for (const Footprint& wall : boundary_) {
    const double gap = gap_between(footprint, wall);
    if (gap <= 0 || (!any_gap && gap > kAgainstWallM && gap < kLeastGapM)) return false;
    nearest = std::min(nearest, gap);
  }
  return !close || nearest <= kMostGapM;
}

bool Course::is_on_way(const Footprint& footprint) const {
  constexpr int kPieces = 20;  // of each leg
  for (std::size_t i = 1; i < way_.size(); ++i) {
    const Eigen::Vector2d leg = way_[i] - way_[i - 1];
    for (int k = 0; k <= kPieces; ++k) {
      if (distance_to(footprint, way_[i - 1] + leg * (static_cast<double>(k) / kPieces)) < kWayRadiusM + 0.15)
        return true;
    }
  }
  return false;
}

bool Course::place(Thing thing, bool close, int beside) {
  const Footprint footprint = footprint_of(thing);
  if (!fits(footprint, close, beside)) return false;
  FreeSpace with = *space_;
  with.add(thing);
  if (!with.connected(start(), world_.goals.front(), kWayRadiusM)) return false;
  space_ = std::move(with);
  if (is_on_way(footprint)) way_ = space_->path(start(), world_.goals.front(), kWayRadiusM);
  things_.push_back({footprint, static_cast<int>(world_.things.size()), false});
  add(std::move(thing));
  return true;
}

Eigen::Vector2d Course::anywhere() {
  double at = random_.uniform(0, area_m2_);
  for (const Rect& r : rooms_) {
    const double area = (r.x1 - r.x0) * (r.y1 - r.y0);
    if (at < area) return {random_.uniform(r.x0, r.x1), random_.uniform(r.y0, r.y1)};
    at -= area;
  }
  return start();
}

Eigen::Vector2d Course::on_the_way(double aside) {
  double length = 0;
  for (std::size_t i = 1; i < way_.size(); ++i)
    length += (way_[i] - way_[i - 1]).norm();
  double along = random_.uniform(0.12, 0.9) * length;
  for (std::size_t i = 1; i < way_.size(); ++i) {
    const Eigen::Vector2d step = way_[i] - way_[i - 1];
    const double step_length = step.norm();
    if (along <= step_length) {
      const Eigen::Vector2d across = Eigen::Vector2d(-step.y(), step.x()) / step_length;
      return way_[i - 1] + step * (along / step_length) + across * random_.uniform(-aside, aside);
    }
    along -= step_length;
  }
  return way_.back();
}

std::optional<Walk> Course::crossing_walk() {
  constexpr double kRoomM = 0.4;  // he keeps this from things
  for (int attempt = 0; attempt < 60; ++attempt) {
    const Eigen::Vector2d middle = on_the_way(0);
    const double angle = random_.uniform(0, 2 * std::numbers::pi);
    const Eigen::Vector2d along{std::cos(angle), std::sin(angle)};
    const auto may_be = [&](const Eigen::Vector2d& p) {
      return space_->fits(p.x(), p.y(), kRoomM) && (p - start()).norm() > 2.2 &&
             (p - world_.goals.front()).norm() > 1.5;
    };
    if (!may_be(middle)) continue;
    std::array<double, 2> reach{0, 0};
    for (std::size_t side = 0; side < 2; ++side) {
      const double sign = side == 0 ? -1 : 1;
      while (reach[side] < 2.5 && may_be(middle + sign * (reach[side] + 0.05) * along))
        reach[side] += 0.05;
    }
    if (reach[0] + reach[1] < 1.8) continue;
    Walk walk;
    walk.points = {middle - reach[0] * along, middle + reach[1] * along};
    walk.speed_mps = random_.uniform(0.4, 1.0);
    walk.start_m = random_.uniform(0, 2 * (reach[0] + reach[1]));
    return walk;
  }
  return std::nullopt;
}

int Course::on_the_straight_line() const {
  int count = 0;
  const Eigen::Vector2d line = world_.goals.front() - start();
  for (const Known& known : things_) {
    if (known.driven) continue;
    for (int k = 0; k <= 200; ++k) {
      if (distance_to(known.footprint, start() + line * (k / 200.0)) < kRobotRadiusM) {
        ++count;
        break;
      }
    }
  }
  return count;
}

}  // namespace lakshya::sim

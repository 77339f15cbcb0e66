#include "app/tools/sim/walk.h"

#include <cmath>

namespace lakshya::sim {
namespace {

constexpr double kBodyM = 0.3;  // radius of a person
constexpr double kSeesCosine =
    0.35;  // of the largest angle from his direction at which he minds a vehicle: 70 degrees
constexpr double kTurnsRoundAfterS = 2.0;  // of standing before it

double length_of(const Walk& walk) {
  double length = 0;
  for (std::size_t i = 1; i < walk.points.size(); ++i)
    length += (walk.points[i] - walk.points[i - 1]).norm();
  return length;
}

// The time at which he is at the same place and goes the other way.
double turned_round(const Walk& walk, double time_s) {
  const double along = walk.start_m + walk.speed_mps * time_s;
  return (2 * length_of(walk) - along - walk.start_m) / walk.speed_mps;
}

}  // namespace

Place place_on_walk(const Walk& walk, double time_s) {
  if (walk.points.empty()) return {};
  const double length = length_of(walk);
  if (!(length > 0)) return {walk.points.front().x(), walk.points.front().y(), 0};

  double along = std::fmod(walk.start_m + walk.speed_mps * time_s, 2 * length);
  if (along < 0) along += 2 * length;
  const bool back = along >= length;
  double rest = back ? 2 * length - along : along;
  for (std::size_t i = 1; i < walk.points.size(); ++i) {
    const Eigen::Vector2d step = walk.points[i] - walk.points[i - 1];
    const double step_length = step.norm();
    if (step_length <= 0) continue;
    // On the way back a corner belongs to the leg that comes next there, which is the one before it.
    if (rest < step_length || (back && rest <= step_length) || i + 1 == walk.points.size()) {
      const Eigen::Vector2d at = walk.points[i - 1] + step * (rest / step_length);
      const Eigen::Vector2d facing =
          back ? Eigen::Vector2d(walk.points[i - 1] - walk.points[i]) : step;  // no -0: west is +pi
      return {at.x(), at.y(), std::atan2(facing.y(), facing.x())};
    }
    rest -= step_length;
  }
  return {walk.points.back().x(), walk.points.back().y(), 0};
}

Walkers::Walkers(const World& world)
    : world_(&world), own_s_(world.things.size(), 0), halted_(world.things.size(), 0) {}

void Walkers::step(double time_s, double x, double y, double vehicle_radius_m) {
  const double dt = time_s - time_s_;
  if (!(dt > 0)) return;
  time_s_ = time_s;
  for (std::size_t i = 0; i < own_s_.size(); ++i) {
    const Thing& thing = world_->things[i];
    if (!thing.walk) continue;
    const Place at = place_on_walk(*thing.walk, own_s_[i]);
    const double away = std::hypot(x - at.x, y - at.y);
    const double ahead = (x - at.x) * std::cos(at.yaw) + (y - at.y) * std::sin(at.yaw);
    const double halts_m = thing.walk->halts_m;
    const bool in_his_way = halts_m > 0 && away - vehicle_radius_m - kBodyM < halts_m && ahead > kSeesCosine * away;
    if (!in_his_way) {
      halted_[i] = 0;
      own_s_[i] += dt;
      continue;
    }
    halted_[i] += dt;
    if (halted_[i] < kTurnsRoundAfterS || !(thing.walk->speed_mps > 0)) continue;
    halted_[i] = 0;
    own_s_[i] = turned_round(*thing.walk, own_s_[i]);
  }
}

}  // namespace lakshya::sim

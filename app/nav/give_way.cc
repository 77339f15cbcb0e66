#include "app/nav/give_way.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/nav/sectors.h"
#include "app/nav/steering.h"

namespace lakshya {
namespace {

constexpr double kStepS = 0.1;
constexpr int kSteps = 20;          // of a way that is driven
constexpr int kStandingSteps = 12;  // of a vehicle that stands: it only has to end a turn
constexpr int kTurnRoundSteps = 9;
constexpr double kUnsureMps = 0.15;  // who is out of view may be this much elsewhere
constexpr double kMostUnsureM = 0.4;
constexpr double kHurriedUnseenS = 0.3;  // who was not seen for so long is nobody to a vehicle in a hurry
constexpr double kTurnedUnseenS = 0.3;   // who was not seen for so long may have turned round
constexpr std::array<double, 4> kShares{1.0, 0.7, 0.45, 0.2};

// A mover relative to the vehicle as it stands now.
struct Walker {
  double x, y, vx, vy;
  double radius_m;
};

Walker seen_from(const Pose& pose, const Mover& m) {
  const double c = std::cos(pose.yaw);
  const double s = std::sin(pose.yaw);
  const double east = m.east_m - pose.east_m;
  const double north = m.north_m - pose.north_m;
  Walker w{east * c + north * s, north * c - east * s, m.east_mps * c + m.north_mps * s,
           m.north_mps * c - m.east_mps * s, kMoverRadiusM + std::min(kUnsureMps * m.unseen_s, kMostUnsureM)};
  if (!m.lost_way) return w;
  // Nobody knows where he goes: towards the vehicle is the worst.
  const double pace = std::hypot(w.vx, w.vy);
  const double away = std::max(std::hypot(w.x, w.y), 0.01);
  w.vx = -pace * w.x / away;
  w.vy = -pace * w.y / away;
  return w;
}

// He who has turned round when he was last seen.
Walker turned_round(const Walker& w, double unseen_s) {
  return {w.x - 2 * w.vx * unseen_s, w.y - 2 * w.vy * unseen_s, -w.vx, -w.vy, w.radius_m};
}

class Rollout {
 public:
  Rollout(const VehicleParams& params, const Intention& intention, double speed_mps)
      : p_(params), direction_(intention.direction), wanted_mps_(speed_mps), v_(intention.now_mps) {}

  void step(int k) {
    if (k * kStepS > p_.latency_s) {
      const double up = p_.acceleration_mps2 * kStepS;
      const double down = p_.deceleration_mps2 * kStepS;
      v_ += std::clamp(wanted_mps_ - v_, -down, up);
    }
    yaw_ += turn_rate(direction_ - yaw_, p_.steering_gain, radians(p_.max_turn_rate_dps)) * kStepS;
    x += v_ * kStepS * std::cos(yaw_);
    y += v_ * kStepS * std::sin(yaw_);
  }

  double x = 0, y = 0;

 private:
  const VehicleParams& p_;
  const double direction_;
  const double wanted_mps_;
  double v_;
  double yaw_ = 0;
};

bool near(const Walker& w, double t_s, double x, double y, double least_m) {
  const double dx = w.x + w.vx * t_s - x;
  const double dy = w.y + w.vy * t_s - y;
  return dx * dx + dy * dy < least_m * least_m;
}

bool goes_well(const VehicleParams& params, std::span<const Walker> walkers, const Intention& intention,
               double speed_mps, int steps) {
  const double margin_m = params.radius_m + kGiveWayMarginM;
  Rollout vehicle(params, intention, speed_mps);
  for (int k = 0; k <= steps; ++k) {
    if (k > 0) vehicle.step(k);
    for (const Walker& w : walkers) {
      const double least_m = margin_m + (intention.hurries ? kMoverRadiusM : w.radius_m);
      if (near(w, k * kStepS, vehicle.x, vehicle.y, least_m)) return false;
      if (!intention.hurries && k <= kTurnRoundSteps && near(w, -k * kStepS, vehicle.x, vehicle.y, least_m))
        return false;
    }
  }
  return true;
}

}  // namespace

GiveWay give_way(const VehicleParams& vehicle, std::span<const Mover> movers, const Pose& pose,
                 const Intention& intention) {
  std::array<Walker, 2 * kMostMovers> all{};
  const std::size_t count = std::min<std::size_t>(movers.size(), kMostMovers);
  std::size_t known = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Mover& m = movers[i];
    if (intention.hurries && m.unseen_s >= kHurriedUnseenS) continue;
    const Walker walker = seen_from(pose, m);
    all[known++] = walker;
    const bool may_have_turned = !intention.hurries && !m.lost_way && m.unseen_s > kTurnedUnseenS;
    if (may_have_turned) all[known++] = turned_round(walker, m.unseen_s);
  }
  const std::span<const Walker> walkers(all.data(), known);
  if (known == 0) return {.speed_mps = intention.speed_mps};
  if (intention.speed_mps > 0) {
    for (const double share : kShares) {
      const double speed = share * intention.speed_mps;
      if (goes_well(vehicle, walkers, intention, speed, kSteps)) return {.speed_mps = speed};
    }
  }
  return {.speed_mps = 0, .stands = !goes_well(vehicle, walkers, intention, 0, kStandingSteps)};
}

void limit_plan(const VehicleParams& vehicle, std::span<const Mover> movers, const Pose& pose, double now_mps,
                Patience& patience, Plan& plan) {
  const bool hurries = patience.hurries > 0;
  patience.hurries -= hurries ? 1 : 0;
  if (movers.empty()) {
    patience.waited = 0;
    return;
  }
  const GiveWay allowed = give_way(vehicle, movers, pose, {now_mps, plan.speed_mps, plan.direction, hurries});
  patience.waited = allowed.stands || allowed.speed_mps < plan.speed_mps ? patience.waited + 1 : 0;
  if (patience.waited > Patience::kWaits) patience = {.waited = 0, .hurries = Patience::kHurries};
  plan.yields = allowed.stands;
  plan.speed_mps = allowed.speed_mps;
  if (allowed.stands) plan.turn_rate_rps = 0;
  plan.wheels = wheel_speeds(plan.speed_mps, plan.turn_rate_rps, vehicle.track_m);
}

}  // namespace lakshya

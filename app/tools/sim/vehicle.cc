#include "app/tools/sim/vehicle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hal/angle.h"

namespace lakshya::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr double kStepSeconds = 0.001;
constexpr double kWanderTime = 1.0;  // s, of the slip
constexpr double kShakeTime = 0.05;  // s
constexpr double kShakeSpeed = 0.5;  // m/s, at which the body shakes in full
constexpr Nanoseconds kJumpLength = kSecond / 2;

// Ornstein and Uhlenbeck: stays about `mean` with the standard deviation given.
double wandered(double value, double mean, double deviation, double time_s, double normal) {
  const double keep = std::exp(-kStepSeconds / time_s);
  return mean + (value - mean) * keep + deviation * std::sqrt(1 - keep * keep) * normal;
}

}  // namespace

Vehicle::Vehicle(const VehicleSettings& settings, const World& world, std::uint64_t seed, Nanoseconds time)
    : settings_(settings),
      world_(&world),
      slips_(seed ^ 0x5117'0000'0000ULL),
      readings_(seed ^ 0xC0'0000'0000ULL),
      time_(time),
      slip_{settings.slip, settings.slip} {
  bias_ = settings.heading_bias_deg * kRadians * readings_.normal();
  state_.x = world.start.x;
  state_.y = world.start.y;
  state_.yaw = wrapped_angle(world.start.yaw);
  settle_on_ground();
}

Status Vehicle::command(Nanoseconds time, const WheelVelocities& wanted) {
  (void)at(time);
  if (count_ == kMostWaiting) return Status::refused;
  const Nanoseconds latency = std::llround(settings_.command_latency_s * static_cast<double>(kSecond));
  waiting_[(first_ + count_++) % kMostWaiting] = {time + latency, wanted};
  return Status::ok;
}

Status Vehicle::travel(Nanoseconds time, WheelTravel& travel) {
  (void)at(time);
  const auto counted = [&](double way_m) {
    return std::floor(way_m / settings_.encoder_step_m) * settings_.encoder_step_m;
  };
  travel.left_m = counted(wheel_m_[0]);
  travel.right_m = counted(wheel_m_[1]);
  travel.measured = true;
  return Status::ok;
}

Status Vehicle::heading(Nanoseconds time, HeadingSample& sample) {
  const VehicleState& s = at(time);
  constexpr double kReadingsPerSecond = 20;
  if (time >= jump_until_) {
    jump_ = 0;
    if (readings_.chance(settings_.heading_jumps_per_s / kReadingsPerSecond)) {
      const double size = readings_.uniform(5, 15) * kRadians;
      jump_ = readings_.chance(0.5) ? size : -size;
      jump_until_ = time + kJumpLength;
    }
  }
  const double noise = settings_.heading_noise_deg * kRadians;
  sample.yaw = wrapped_angle(s.yaw + bias_ + jump_ + noise * readings_.normal());
  sample.pitch = s.pitch;
  sample.roll = s.roll;
  return Status::ok;
}

const VehicleState& Vehicle::at(Nanoseconds time) {
  while (time_ + kStep <= time)
    step();
  return state_;
}

void Vehicle::step() {
  time_ += kStep;
  while (count_ > 0 && waiting_[first_].due <= time_) {
    wanted_ = waiting_[first_].wanted;
    first_ = (first_ + 1) % kMostWaiting;
    --count_;
  }
  const std::array<double, 2> wanted{wanted_.left_mps, wanted_.right_mps};
  const double most = settings_.most_acceleration_mps2 * kStepSeconds;
  std::array<double, 2> ground{};
  const bool turns = std::abs(wheel_mps_[1] - wheel_mps_[0]) > 0.1;
  for (std::size_t i = 0; i < 2; ++i) {
    const double lagged = (wanted[i] - wheel_mps_[i]) * kStepSeconds / settings_.motor_time_s;
    wheel_mps_[i] += std::clamp(lagged, -most, most);
    if (wanted[i] == 0 && std::abs(wheel_mps_[i]) < 1e-4) wheel_mps_[i] = 0;  // friction
    wheel_m_[i] += wheel_mps_[i] * kStepSeconds;
    slip_[i] = wandered(slip_[i], settings_.slip, settings_.slip_wander, kWanderTime, slips_.normal());
    ground[i] = wheel_mps_[i] * (1 - slip_[i] * (turns ? 2 : 1));
  }
  state_.speed_mps = (ground[0] + ground[1]) / 2;
  state_.turn_rate_rps = (ground[1] - ground[0]) / settings_.track_m;
  const double half_turn = state_.turn_rate_rps * kStepSeconds / 2;
  const double way = state_.speed_mps * kStepSeconds * std::cos(state_.pitch);
  state_.x += way * std::cos(state_.yaw + half_turn);
  state_.y += way * std::sin(state_.yaw + half_turn);
  state_.yaw = wrapped_angle(state_.yaw + 2 * half_turn);
  state_.path_m += std::abs(way);
  const double shake = settings_.shake_deg * kRadians *
                       std::min(1.0, (std::abs(wheel_mps_[0]) + std::abs(wheel_mps_[1])) / 2 / kShakeSpeed);
  for (double& angle : shake_)
    angle = wandered(angle, 0, shake, kShakeTime, slips_.normal());
  settle_on_ground();
}

// On the slope below it: the ground under nose, tail and wheels.
void Vehicle::settle_on_ground() {
  const double reach = settings_.track_m / 2;
  const double c = std::cos(state_.yaw) * reach;
  const double s = std::sin(state_.yaw) * reach;
  const auto height = [&](double dx, double dy) {
    return ground_height(world_->ground, state_.x + dx, state_.y + dy);
  };
  const double front = height(c, s);
  const double back = height(-c, -s);
  const double left = height(-s, c);
  const double right = height(s, -c);
  state_.z = height(0, 0);
  state_.pitch = std::atan2(front - back, 2 * reach) + shake_[0];
  state_.roll = std::atan2(left - right, 2 * reach) + shake_[1];
}

}  // namespace lakshya::sim

#include "hal/odometry/wheel_odometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hal/angle.h"

namespace lakshya {
namespace {

enum CounterIndex : std::size_t { kTravelJumps, kHeadingJumps };

constexpr double kPi = std::numbers::pi;

double seconds(Nanoseconds duration) {
  return static_cast<double>(duration) / static_cast<double>(kSecond);
}

// sin(a) / a
double chord_of_arc(double a) {
  return std::abs(a) < 1e-6 ? 1 : std::sin(a) / a;
}

}  // namespace

Status WheelOdometry::add(const WheelTravel& travel) {
  if (!last_travel_) {
    last_travel_ = travel;
    pose_.time = std::max(pose_.time, travel.time);
    return Status::ok;
  }
  const Nanoseconds duration = travel.time - last_travel_->time;
  if (duration <= 0) return Status::ok;
  const double left = travel.left_m - last_travel_->left_m;
  const double right = travel.right_m - last_travel_->right_m;
  last_travel_ = travel;
  // Where a compass says what is ahead, way before its first word has no direction.
  if (settings_.has_compass && !last_heading_) return Status::ok;
  // A centimetre is for the grain of a coarse encoder.
  const double possible = settings_.max_speed_mps * seconds(duration) + 0.01;
  if (!(std::abs(left) <= possible && std::abs(right) <= possible)) {
    ++counters_[kTravelJumps].value;
    return Status::bad_data;
  }
  pose_.time = std::max(pose_.time, travel.time);
  const double turn = (right - left) / settings_.track_m;
  const double way = (left + right) / 2 * chord_of_arc(turn / 2);
  const double direction = pose_.yaw + turn / 2;
  pose_.east_m += way * std::cos(direction);
  pose_.north_m += way * std::sin(direction);
  pose_.yaw = wrapped_angle(pose_.yaw + turn);
  return Status::ok;
}

Status WheelOdometry::add(const HeadingSample& heading) {
  if (!std::isfinite(heading.yaw)) return Status::bad_data;
  if (!last_heading_) {
    last_heading_ = heading.time;
    pose_.yaw = wrapped_angle(heading.yaw);
    pose_.time = std::max(pose_.time, heading.time);
    return Status::ok;
  }
  const Nanoseconds duration = heading.time - *last_heading_;
  if (duration <= 0) return Status::ok;
  last_heading_ = heading.time;
  const double error = wrapped_angle(heading.yaw - pose_.yaw);
  if (std::abs(error) > settings_.heading_jump_deg * kPi / 180) {
    ++counters_[kHeadingJumps].value;
    if (!jumped_since_) jumped_since_ = heading.time;
    if (seconds(heading.time - *jumped_since_) < settings_.jump_hold_s) return Status::bad_data;
    // It is the wheels that are wrong: the vehicle slipped, or was turned by hand.
    pose_.yaw = wrapped_angle(heading.yaw);
  } else {
    pose_.yaw = wrapped_angle(pose_.yaw + error * (1 - std::exp(-seconds(duration) / settings_.heading_time_s)));
  }
  jumped_since_.reset();
  pose_.time = std::max(pose_.time, heading.time);
  return Status::ok;
}

Status WheelOdometry::pose(PoseSample& sample) const {
  if (!last_travel_ || (settings_.has_compass && !last_heading_)) return Status::timeout;
  sample = pose_;
  return Status::ok;
}

}  // namespace lakshya

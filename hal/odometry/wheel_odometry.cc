#include "hal/odometry/wheel_odometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hal/angle.h"

namespace lakshya {
namespace {

enum CounterIndex : std::size_t { kTravelJumps, kHeadingJumps };

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;

// What the wheels' heading may be wrong by besides k, variances: two wheels that slip by 1 % more or less for a second each.
constexpr double kPerRadian = 6e-4;    // rad^2
constexpr double kPerMetre = 4e-4;     // rad^2
constexpr double kScale = 0.05;        // k at the start, standard deviation
constexpr double kScaleChange = 2e-5;  // ... and its variance for each radian: other ground
constexpr double kLeastScale = 0.7;
constexpr double kMostScale = 1.3;
constexpr double kSpeed = 0.5;            // m/s, at which heading_time_s is meant
constexpr double kReading = 2 * kDegree;  // a compass between iron things, standard deviation
constexpr double kDoubtful = 3;           // standard deviations
constexpr double kMostAhead = 0.1;        // s, that a turn is taken to go on evenly

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
  const double rolled = (right - left) / settings_.track_m;
  const double turn = scale_ * rolled;
  const double way = (left + right) / 2 * chord_of_arc(turn / 2);
  const double direction = pose_.yaw + turn / 2;
  pose_.east_m += way * std::cos(direction);
  pose_.north_m += way * std::sin(direction);
  pose_.yaw = wrapped_angle(pose_.yaw + turn);
  turn_rate_rps_ = turn / seconds(duration);
  grow_errors(rolled, (left + right) / 2);
  return Status::ok;
}

void WheelOdometry::grow_errors(double turned, double way) {
  yaw_variance_ += 2 * turned * covariance_ + turned * turned * scale_variance_ + kPerRadian * std::abs(turned) +
                   kPerMetre * std::abs(way);
  covariance_ += turned * scale_variance_;
  scale_variance_ = std::min(scale_variance_ + kScaleChange * std::abs(turned), kScale * kScale);
}

// By a heading that is off by `error` and has that variance.
void WheelOdometry::correct(double error, double variance) {
  const double yaw_gain = yaw_variance_ / (yaw_variance_ + variance);
  const double scale_gain = covariance_ / (yaw_variance_ + variance);
  pose_.yaw = wrapped_angle(pose_.yaw + yaw_gain * error);
  scale_ = std::clamp(scale_ + scale_gain * error, kLeastScale, kMostScale);
  scale_variance_ -= scale_gain * covariance_;
  covariance_ *= 1 - yaw_gain;
  yaw_variance_ *= 1 - yaw_gain;
}

Status WheelOdometry::add(const HeadingSample& heading) {
  if (!std::isfinite(heading.yaw)) return Status::bad_data;
  if (!last_heading_) {
    last_heading_ = heading.time;
    pose_.yaw = wrapped_angle(heading.yaw);
    yaw_variance_ = kReading * kReading;
    scale_variance_ = kScale * kScale;
    return Status::ok;
  }
  const Nanoseconds duration = heading.time - *last_heading_;
  if (duration <= 0) return Status::ok;
  last_heading_ = heading.time;
  const double ahead_s =
      last_travel_ ? std::clamp(seconds(heading.time - last_travel_->time), -kMostAhead, kMostAhead) : 0;
  const double error = wrapped_angle(heading.yaw - pose_.yaw - turn_rate_rps_ * ahead_s);
  const bool jumps = std::abs(error) > settings_.heading_jump_deg * kDegree;
  const double likely = kDoubtful * std::sqrt(yaw_variance_ + kReading * kReading);
  if (jumps || std::abs(error) > likely) {
    if (jumps) ++counters_[kHeadingJumps].value;
    if (!jumped_since_) jumped_since_ = heading.time;
    if (seconds(heading.time - *jumped_since_) < settings_.jump_hold_s)
      return jumps ? Status::bad_data : Status::ok;
    // It is the wheels that are wrong: the vehicle slipped, or was turned by hand.
    pose_.yaw = wrapped_angle(pose_.yaw + error);
    yaw_variance_ = kReading * kReading;
    covariance_ = 0;
  } else {
    const double nominal = settings_.heading_time_s * settings_.heading_time_s * kPerMetre * kSpeed;
    correct(error, nominal / seconds(duration));
  }
  jumped_since_.reset();
  return Status::ok;
}

Status WheelOdometry::pose(PoseSample& sample) const {
  if (!last_travel_ || (settings_.has_compass && !last_heading_)) return Status::timeout;
  sample = pose_;
  return Status::ok;
}

}  // namespace lakshya

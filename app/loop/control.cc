#include "app/loop/control.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/core/devices.h"
#include "hal/angle.h"

namespace lakshya {
namespace {

// What a drive may take to confirm a command; its driver says so (hal/servo/quicksilver.h).
constexpr Nanoseconds kDriveTime = 25 * kMillisecond;

constexpr Nanoseconds kOldestTravel = 100 * kMillisecond;

Nanoseconds nanoseconds(double seconds) {
  return std::llround(seconds * static_cast<double>(kSecond));
}

bool is_zero(const WheelVelocities& wheels) {
  return wheels.left_mps == 0 && wheels.right_mps == 0;
}

// Both slower by the same factor, so that the curve stays, until neither is above the limit.
WheelVelocities not_faster(const WheelVelocities& wheels, double limit_mps) {
  const double most = std::max(std::abs(wheels.left_mps), std::abs(wheels.right_mps));
  if (most <= limit_mps) return wheels;
  const double factor = limit_mps / most;
  return {wheels.left_mps * factor, wheels.right_mps * factor};
}

}  // namespace

Control::Control(const VehicleConfig& config, std::vector<WayPoint> way_points, const ControlDevices& devices,
                 Clock& clock, Exchange& exchange)
    : config_(config),
      way_points_(std::move(way_points)),
      devices_(devices),
      clock_(&clock),
      exchange_(&exchange),
      machine_(nanoseconds(config.safety.recover_s)),
      odometry_(odometry_settings(config)),
      schedule_(kControlPeriod),
      target_(config.mission.direction_deg * kRadiansPerDegree) {}

void Control::read_compass(Nanoseconds now) {
  if (devices_.compass == nullptr) return;
  // Several may have come since the last turn; more than a few are somebody's fault and must not hold the turn up.
  constexpr int kMost = 8;
  for (int i = 0; i < kMost; ++i) {
    HeadingSample sample;
    const Status status = devices_.compass->read(now, sample);
    faults_.set(Event::compass_gone, status == Status::disconnected);
    if (status != Status::ok) break;
    heading_time_ = sample.time;
    faults_.set(Event::compass_jumped, odometry_.add(sample) != Status::ok);
    const double limit = config_.safety.tilt_deg * kRadiansPerDegree;
    faults_.set(Event::tipping, std::abs(sample.pitch) > limit || std::abs(sample.roll) > limit);
  }
  faults_.set(Event::compass_silent,
              !heading_time_ || now - *heading_time_ > nanoseconds(config_.safety.compass_silent_s));
}

void Control::read_estop() {
  if (devices_.estop == nullptr) return;
  bool pressed = true;
  if (devices_.estop->read(pressed) != Status::ok) pressed = true;
  faults_.set(Event::emergency_stop, pressed);
}

void Control::judge_camera(Nanoseconds now) {
  const SafetyConfig& s = config_.safety;
  const bool has_frame = frame_.count > 0;
  faults_.set(Event::camera_silent, !has_frame || now - frame_.arrived > nanoseconds(s.camera_silent_s));
  faults_.set(Event::camera_gone, frame_.status == Status::disconnected);
  faults_.set(Event::camera_dark, has_frame && frame_.dark >= s.dark_share);
  faults_.set(Event::camera_bright, has_frame && frame_.bright >= s.bright_share);
  faults_.set(Event::camera_skewed, frame_.skew > nanoseconds(s.skew_s));
  faults_.set(Event::camera_frozen,
              frame_.same >= s.frozen_pairs - 1 && way_m_ - same_since_m_ >= s.frozen_travel_m);
}

void Control::take_frame(Nanoseconds now) {
  if (exchange_->frame.take()) {
    frame_ = exchange_->frame.reading();
    faults_.set(Event::camera_damaged, frame_.damaged != damaged_);
    damaged_ = frame_.damaged;
    if (frame_.same == 0) same_since_m_ = way_m_;
  }
  judge_camera(now);
}

void Control::take_plan() {
  const PlanNote& plan = exchange_->plan.reading();
  faults_.set(Event::perception_failed, plan.status != Status::ok);
  if (plan.status == Status::ok) plan_ = plan;
  ++plans_;
}

void Control::judge_plan(Nanoseconds now) {
  faults_.set(Event::plan_old, !plan_ || now - plan_->taken > nanoseconds(config_.safety.plan_age_s));
  const Nanoseconds since = exchange_->working_since.load(std::memory_order_acquire);
  faults_.set(Event::perception_late, since != 0 && now - since > nanoseconds(config_.safety.perception_s));
}

bool Control::find_goal() {
  if (way_points_.empty()) return true;
  const Pose pose{pose_.east_m, pose_.north_m, pose_.yaw};
  way_point_ = next_way_point(way_points_, way_point_, pose, config_.mission.arrival_m);
  if (way_point_ >= way_points_.size()) return false;
  target_ = view_way_point(pose, way_points_[way_point_]).direction;
  return true;
}

Conditions Control::judge(Nanoseconds now, Nanoseconds due) {
  const Nanoseconds late = std::max<Nanoseconds>(now - due, 0);
  counts_.lateness.add(late);
  faults_.set(Event::control_late, late > nanoseconds(config_.safety.control_late_s));
  const bool stops = config_.safety.recording_failed == "stop";
  const bool failed = exchange_->recording_failed.load(std::memory_order_acquire);
  faults_.set(stops ? Event::recording_failed : Event::recording_lost, failed);
  faults_.set(Event::watchdog_failed, exchange_->watchdog_failed.load(std::memory_order_acquire));
  return {.faults = faults_,
          .has_goal = has_goal_,
          .reset = exchange_->reset.exchange(false, std::memory_order_acq_rel),
          .terminate = exchange_->terminate.load(std::memory_order_acquire)};
}

double Control::direction_now() const {
  return plan_ ? wrapped_angle(plan_->direction - (pose_.yaw - plan_->pose.yaw)) : 0;
}

WheelVelocities Control::wanted(Action action) const {
  if ((action != Action::drive && action != Action::drive_slowly) || !plan_) return {};
  const VehicleParams& v = config_.vehicle;
  double speed = plan_->speed_mps;
  double rate = 0;
  if (plan_->blocked) {
    // A turn on the spot sweeps no new ground, but only a vehicle that stands turns on the spot.
    const bool stands = wheels_.left_mps + wheels_.right_mps == 0;
    rate = stands ? config_.loop.recovery_turn_dps * kRadiansPerDegree : 0;
    if (plan_->recovery == Side::right) rate = -rate;
  } else {
    rate = turn_rate(direction_now(), v.steering_gain, v.max_turn_rate_dps * kRadiansPerDegree);
  }
  if (action == Action::drive_slowly) speed = std::min(speed, config_.safety.degraded_speed_mps);
  const WheelSpeeds wheels = wheel_speeds(speed, rate, v.track_m);
  const WheelLimits limits{v.acceleration_mps2, v.deceleration_mps2};
  const double period_s = static_cast<double>(kControlPeriod) / static_cast<double>(kSecond);
  const WheelSpeeds next = limit_acceleration(wheels, {wheels_.left_mps, wheels_.right_mps}, limits, period_s);
  return not_faster({next.left_mps, next.right_mps}, devices_.servo->max_speed_mps());
}

// Both exchanges with the drives must go well. A reading of the travel that was lost is not missed before the next but one.
void Control::judge_drive() {
  const bool old_travel = clock_->now() - travel_.time > kOldestTravel;
  const Status travel = travel_status_ == Status::timeout && !old_travel ? Status::ok : travel_status_;
  const auto either = [&](Status status) { return command_status_ == status || travel == status; };
  faults_.set(Event::drive_silent, either(Status::timeout));
  faults_.set(Event::drive_refused, either(Status::refused) || either(Status::unsupported));
  faults_.set(Event::drive_garbled, either(Status::bad_data) || either(Status::bad_argument));
  faults_.set(Event::drive_gone, either(Status::disconnected));
}

void Control::command(Action action, Nanoseconds now, Nanoseconds due) {
  const WheelVelocities wheels = wanted(action);
  const bool halts = is_zero(wheels) && !is_zero(wheels_);
  schedule_.begin(halts || action == Action::zero_and_end);
  wheels_ = wheels;
  if (!schedule_.commands()) return;
  const Nanoseconds deadline = std::max(now, due) + kDriveTime;
  // A stop is as fast as the drives can, zero by drive() keeps those that are supervised from stopping by themselves.
  const bool stops = halts || action == Action::zero_and_end || action == Action::zero_now;
  command_status_ = stops ? devices_.servo->stop(deadline) : devices_.servo->drive(wheels, deadline);
  judge_drive();
  if (command_status_ != Status::ok && !stops) {
    wheels_ = {};
    (void)devices_.servo->stop(clock_->now() + kDriveTime);
  }
  schedule_.commanded(clock_->now() - now);
}

void Control::read_travel(Nanoseconds now, Nanoseconds due) {
  if (!schedule_.reads()) return;
  const Nanoseconds begin = clock_->now();
  WheelTravel travel;
  travel_status_ = devices_.servo->read_travel(std::max(now, due) + kDriveTime, travel);
  schedule_.has_read(clock_->now() - begin);
  judge_drive();
  if (travel_status_ != Status::ok) return;
  way_m_ += (std::abs(travel.left_m - travel_.left_m) + std::abs(travel.right_m - travel_.right_m)) / 2;
  travel_ = travel;
  (void)odometry_.add(travel);
  (void)odometry_.pose(pose_);
}

void Control::tell(Nanoseconds now, bool has_new_plan) {
  exchange_->nav.writing() = {pose_, target_};
  (void)exchange_->nav.publish();
  for (const StateNote& note : machine_.notes())
    (void)exchange_->notes.push(note);
  StatusNote& status = exchange_->status.writing();
  status = {.time = now,
            .turns = counts_.turns,
            .state = machine_.state(),
            .reason = machine_.reason(),
            .pose = pose_,
            .wheels = wheels_,
            .direction = direction_now(),
            .frames = frame_.count,
            .way_point = way_point_};
  if (plan_) {
    status.clear_m = plan_->clear_m;
    status.nearest_m = plan_->nearest_m;
    status.plan_age = now - plan_->taken;
    status.frame_time = plan_->took;
  }
  (void)exchange_->status.publish();
  if (!has_new_plan) return;
  (void)exchange_->decisions.push({.plan = exchange_->plan.reading(),
                                   .time = now,
                                   .state = machine_.state(),
                                   .reason = machine_.reason(),
                                   .pose = pose_,
                                   .wheels = wheels_});
}

bool Control::turn(Nanoseconds due) {
  const Nanoseconds now = clock_->now();
  ++counts_.turns;
  read_compass(now);
  read_estop();
  take_frame(now);
  const bool has_new_plan = exchange_->plan.take();
  if (has_new_plan) take_plan();
  judge_plan(now);
  has_goal_ = find_goal();
  const Action action = machine_.step(now, judge(now, due));
  for (const StateNote& note : machine_.notes())
    ++counts_.faults[static_cast<std::size_t>(note.event)];
  command(action, now, due);
  tell(now, has_new_plan);
  if (machine_.state() == State::end) {
    exchange_->ended.store(true, std::memory_order_release);
    return false;
  }
  read_travel(now, due);
  const Nanoseconds took = clock_->now() - now;
  counts_.took.add(took);
  if (took > kControlPeriod) ++counts_.overruns;
  return true;
}

}  // namespace lakshya

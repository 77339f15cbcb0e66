#include "app/loop/control.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/core/devices.h"
#include "hal/angle.h"

namespace lakshya {
namespace {

// Older news of the drives are as good as none: several exchanges on the slowest line.
constexpr Nanoseconds kOldestNews = 150 * kMillisecond;
// Turns after which the last zero is taken as said although the drives have not confirmed it.
constexpr std::uint64_t kLastTurns = 8;

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
      target_(config.mission.direction_deg * kRadiansPerDegree) {}

void Control::take_headings(Nanoseconds now) {
  if (!devices_.has_compass) return;
  const double limit = config_.safety.tilt_deg * kRadiansPerDegree;
  bool any = false;
  bool any_heading = false;
  EventSet seen;  // one bad heading among several of a turn counts
  for (HeadingNote note; exchange_->headings.pop(note);) {
    any = true;
    if (note.status == Status::disconnected) seen.set(Event::compass_gone);
    if (note.status != Status::ok) continue;
    any_heading = true;
    const HeadingSample& heading = note.sample;
    heading_time_ = heading.time;
    if (odometry_.add(heading) != Status::ok) seen.set(Event::compass_jumped);
    if (std::abs(heading.pitch) > limit || std::abs(heading.roll) > limit) seen.set(Event::tipping);
  }
  if (any) faults_.set(Event::compass_gone, seen.has(Event::compass_gone));
  for (const Event event : {Event::compass_jumped, Event::tipping}) {
    if (any_heading) faults_.set(event, seen.has(event));
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

bool Control::take_plan() {
  if (!exchange_->plans.pop(newest_plan_)) return false;
  faults_.set(Event::perception_failed, newest_plan_.status != Status::ok);
  if (newest_plan_.status == Status::ok) plan_ = newest_plan_;
  ++plans_;
  return true;
}

void Control::judge_plan(Nanoseconds now) {
  faults_.set(Event::plan_old, !plan_ || now - plan_->taken > nanoseconds(config_.safety.plan_age_s));
  const Nanoseconds limit = nanoseconds(config_.safety.perception_s);
  const Nanoseconds since = exchange_->working_since.load(std::memory_order_acquire);
  // A pair that nobody looks at is as late as one that is looked at for ever.
  if (frame_.count <= exchange_->looked_at.load(std::memory_order_acquire)) {
    waiting_since_.reset();
  } else if (!waiting_since_) {
    waiting_since_ = now;
  }
  const bool waits = waiting_since_ && now - *waiting_since_ > limit;
  faults_.set(Event::perception_late, waits || (since != 0 && now - since > limit));
}

bool Control::find_goal() {
  if (way_points_.empty()) return true;
  const Pose pose{pose_.east_m, pose_.north_m, pose_.yaw};
  way_point_ = next_way_point(way_points_, way_point_, pose, config_.mission.arrival_m);
  if (way_point_ >= way_points_.size()) return false;
  const WayPointView view = view_way_point(pose, way_points_[way_point_]);
  target_ = view.direction;
  target_m_ = view.distance_m;
  return true;
}

Conditions Control::judge(Nanoseconds now, Nanoseconds due) {
  counts_.lateness.add(now - due);
  // Turns that were missed are left out, so that the gap says more than the lateness.
  const Nanoseconds gap = last_turn_ ? now - *last_turn_ - kControlPeriod : 0;
  const Nanoseconds late = std::max(now - due, gap);
  if (last_turn_) {
    counts_.in_state[static_cast<std::size_t>(machine_.state())] += now - *last_turn_;
    counts_.overruns += static_cast<std::uint64_t>(std::max<Nanoseconds>(gap, 0) / kControlPeriod);
  }
  last_turn_ = now;
  faults_.set(Event::control_late, late > nanoseconds(config_.safety.control_late_s));
  const bool stops = config_.safety.recording_failed == "stop";
  const bool reset = exchange_->reset.exchange(false, std::memory_order_acq_rel);
  if (reset) {
    exchange_->fault_before.store(false, std::memory_order_release);
    lost_decisions_ = exchange_->decisions.lost();
  }
  faults_.set(Event::fault_before, exchange_->fault_before.load(std::memory_order_acquire));
  // Who does not read them any more does not write them down either.
  const bool lost =
      exchange_->records.load(std::memory_order_acquire) && exchange_->decisions.lost() > lost_decisions_;
  const bool failed = lost || exchange_->recording_failed.load(std::memory_order_acquire);
  faults_.set(stops ? Event::recording_failed : Event::recording_lost, failed);
  faults_.set(Event::watchdog_failed, exchange_->watchdog_failed.load(std::memory_order_acquire));
  return {.faults = faults_,
          .has_goal = has_goal_,
          .reset = reset,
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
  if (plan_->yields) {
    speed = 0;
  } else if (plan_->blocked) {
    // A turn on the spot sweeps no new ground, but only a vehicle that stands turns on the spot.
    const bool stands = wheels_.left_mps + wheels_.right_mps == 0;
    rate = stands && !plan_->hemmed_in ? config_.loop.recovery_turn_dps * kRadiansPerDegree : 0;
    if (plan_->recovery == Side::right) rate = -rate;
  } else {
    rate = turn_rate(direction_now(), v.steering_gain, v.max_turn_rate_dps * kRadiansPerDegree);
  }
  if (action == Action::drive_slowly) speed = std::min(speed, config_.safety.degraded_speed_mps);
  const WheelSpeeds wheels = wheel_speeds(speed, rate, v.track_m);
  const WheelLimits limits{v.acceleration_mps2, v.deceleration_mps2};
  const double period_s = static_cast<double>(kControlPeriod) / static_cast<double>(kSecond);
  const WheelSpeeds next = limit_acceleration(wheels, {wheels_.left_mps, wheels_.right_mps}, limits, period_s);
  return not_faster({next.left_mps, next.right_mps}, devices_.max_speed_mps);
}

// Command and reading must both go well. A reading that was lost is not missed as long as the one before is young.
void Control::take_drive(Nanoseconds now) {
  if (exchange_->drive.take()) {
    const WheelTravel before = drive_.travel;
    drive_ = exchange_->drive.reading();
    const WheelTravel& travel = drive_.travel;
    if (travel.time != before.time) {
      way_m_ += (std::abs(travel.left_m - before.left_m) + std::abs(travel.right_m - before.right_m)) / 2;
      (void)odometry_.add(travel);
      if (odometry_.pose(pose_) == Status::ok) history_.add(pose_);
    }
  }
  const bool has_travel = now - drive_.travel.time <= kOldestNews;
  const Status travel = drive_.travel_status == Status::timeout && has_travel ? Status::ok : drive_.travel_status;
  const auto either = [&](Status status) { return drive_.command_status == status || travel == status; };
  faults_.set(Event::drive_silent, either(Status::timeout) || now - drive_.time > kOldestNews);
  faults_.set(Event::drive_refused, either(Status::refused) || either(Status::unsupported));
  faults_.set(Event::drive_garbled, either(Status::bad_data) || either(Status::bad_argument));
  faults_.set(Event::drive_gone, either(Status::disconnected));
}

void Control::command(Action action, Nanoseconds now) {
  const WheelVelocities wheels = wanted(action);
  const bool halts = is_zero(wheels) && !is_zero(wheels_);
  wheels_ = wheels;
  DriveCommand& command = exchange_->drive_command.writing();
  command.wheels = wheels;
  command.stops = halts || action == Action::zero_and_end || action == Action::zero_now;
  command.time = now;
  command.number = ++commands_;
  // A stop that driving has not taken yet is not replaced by a plain zero.
  const bool waits = exchange_->drive_command.is_unread() && last_command_stops_ && is_zero(wheels);
  command.stops = command.stops || waits;
  last_command_stops_ = command.stops;
  exchange_->drive_is_urgent.store(command.stops, std::memory_order_release);
  (void)exchange_->drive_command.publish();
}

// The drives have confirmed the last zero, or had their time.
bool Control::has_ended() const {
  if (machine_.state() != State::end) return false;
  const bool confirmed = drive_.number >= end_command_ && drive_.command_status == Status::ok;
  return (end_turns_ > 1 && confirmed) || end_turns_ >= kLastTurns;
}

void Control::tell(Nanoseconds now) {
  exchange_->nav.writing() = {pose_, target_, history_, target_m_};
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
    status.blocked = plan_->blocked;
    status.clear_m = plan_->clear_m;
    status.nearest_m = plan_->nearest_m;
    status.plan_age = now - plan_->taken;
    status.frame_time = plan_->took;
  }
  (void)exchange_->status.publish();
}

void Control::write_down(const PlanNote& plan, Nanoseconds now) {
  (void)exchange_->decisions.push({.plan = plan,
                                   .time = now,
                                   .state = machine_.state(),
                                   .reason = machine_.reason(),
                                   .pose = pose_,
                                   .wheels = wheels_});
}

// Before everything has been heard of for the first time, something is always missing; and at the end of a recording.
void Control::count_faults() {
  const bool has_been_heard_of = machine_.state() != State::init && machine_.state() != State::end;
  for (std::size_t i = 0; i < kEvents; ++i) {
    const auto event = static_cast<Event>(i);
    const bool begins = faults_.has(event) && !counted_.has(event);
    if (begins && has_been_heard_of) ++counts_.faults[i];
  }
  counted_ = faults_;
}

bool Control::turn(Nanoseconds due) {
  const Nanoseconds now = clock_->now();
  ++counts_.turns;
  take_headings(now);
  read_estop();
  take_frame(now);
  // Of several plans the newest counts; the others have a line of their own as they go.
  bool has_new_plan = take_plan();
  for (PlanNote older = newest_plan_; has_new_plan && take_plan(); older = newest_plan_)
    write_down(older, now);
  judge_plan(now);
  take_drive(now);
  has_goal_ = find_goal();
  const Action action = machine_.step(now, judge(now, due));
  count_faults();
  command(action, now);
  tell(now);
  if (has_new_plan) write_down(newest_plan_, now);
  counts_.took.add(clock_->now() - now);
  if (machine_.state() == State::end && end_turns_++ == 0) end_command_ = commands_;
  if (!has_ended()) return true;
  exchange_->ended.store(true, std::memory_order_release);
  return false;
}

}  // namespace lakshya

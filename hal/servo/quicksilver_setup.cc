// How the drives are found, set up and seen to be supervised.
#include <algorithm>
#include <cmath>

#include "hal/servo/quicksilver.h"

namespace lakshya {

using quicksilver::Command;

namespace {

constexpr Nanoseconds kTryEvery = 200 * kMillisecond;
constexpr Nanoseconds kOpenTime = 2 * kSecond;
constexpr int kOpenTries = 3;  // a reply may get lost
constexpr Nanoseconds kCloseTime = 100 * kMillisecond;
constexpr std::int32_t kTrialVelocity = 1;  // units; no wheel moves by it
// A drive without a heartbeat that was away longer may have started anew.
constexpr Nanoseconds kUnsupervisedPause = kSecond;
constexpr double kCatchUpTime = 2;      // s; in less no drive starts and is where it was
constexpr double kFewBeats = 0.5;       // of those that a program makes that goes on
constexpr double kTrialPatience = 1.5;  // the program's rounds make its time a little longer

}  // namespace

Status QuickSilver::open() {
  close();
  Status status = check_settings(settings_, problem_);
  if (status != Status::ok) return status;
  for (std::size_t d = 0; d < drives_.size(); ++d) {
    drives_[d] = {};
    QuickSilverTravel& travel = drives_[d].travel;
    if (settings_.supervised) {
      travel.start(metres_per_count(wheel(d)), settings_.max_speed_mps);
    } else {
      travel.start(metres_per_count(wheel(d)), settings_.max_speed_mps, kUnsupervisedPause);
    }
    const double rpm_per_s = settings_.max_acceleration_mps2 * std::abs(motor_rpm_per_mps(wheel(d)));
    status = quicksilver::acceleration_units(rpm_per_s / 60, drives_[d].acceleration);
    if (status != Status::ok) return status;
  }
  start_over();
  next_try_ = 0;
  status = link_.open();
  if (status != Status::ok) return status;
  opened_ = true;
  const Nanoseconds deadline = clock_->now() + kOpenTime;
  for (int tries = 0; tries < kOpenTries; ++tries) {
    status = set_up(deadline);
    if (status != Status::timeout && status != Status::bad_data) break;
  }
  if (status == Status::ok) return status;
  const Problem why = problem_;
  close();
  problem_ = why;
  return status;
}

void QuickSilver::close() {
  if (!opened_) return;
  opened_ = false;
  const Nanoseconds deadline = clock_->now() + kCloseTime;
  const Status stopped = link_.is_open() ? stop_both(0, deadline) : Status::disconnected;
  // Nothing else stops a drive under VMI: a port that has gone may be back.
  if (stopped == Status::disconnected && !settings_.supervised && link_.open() == Status::ok)
    (void)stop_both(0, deadline);
  link_.close();
}

void QuickSilver::start_over() {
  step_ = Step::stop;
  step_drive_ = 0;
}

Status QuickSilver::reopen() {
  start_over();
  const Status opened = link_.open();
  if (opened != Status::ok) next_try_ = clock_->now() + kTryEvery;
  return opened;
}

Status QuickSilver::be_ready(Nanoseconds deadline) {
  if (!opened_) {
    problem_.set("drives: not open");
    return Status::disconnected;
  }
  if (link_.is_open() && step_ == Step::done) return Status::ok;
  if (clock_->now() < next_try_) return last_try_;
  last_try_ = link_.is_open() ? Status::ok : reopen();
  if (last_try_ != Status::ok) return last_try_;
  last_try_ = set_up(deadline);
  if (last_try_ == Status::ok || last_try_ == Status::timeout) return last_try_;
  start_over();
  next_try_ = clock_->now() + kTryEvery;
  return last_try_;
}

// Both drives have confirmed velocity 0, and then that of the trial, by which nothing moves. To write 0 now would make the trial
// look passed, and to begin again would let a host that stops whenever drive() fails wait for ever.
bool QuickSilver::trial_is_on() const {
  return link_.is_open() && (step_ == Step::trial || step_ == Step::heartbeat_again || step_ == Step::trial_again);
}

// As many steps as there is time for; the next call goes on.
Status QuickSilver::set_up(Nanoseconds deadline) {
  while (step_ != Step::done) {
    const bool wait = step_ == Step::heartbeat_again && step_drive_ == 0;
    const Nanoseconds begin = wait ? std::max(trial_end_, clock_->now()) : clock_->now();
    if (begin + QuickSilverLink::kCommandTime > deadline) {
      problem_.set("drives: are being set up");
      return Status::timeout;
    }
    clock_->sleep_until(begin);
    const bool look_first = step_ == Step::position && is_unknown(step_drive_);
    const Status status = look_first ? see_heartbeat_move(step_drive_, deadline) : take_step(step_drive_, deadline);
    if (status != Status::ok) return status;
    if (!look_first) finish_step();
  }
  return Status::ok;
}

void QuickSilver::finish_step() {
  step_drive_ = 1 - step_drive_;
  if (step_drive_ != 0) return;
  if (settings_.supervised) {
    step_ = static_cast<Step>(static_cast<int>(step_) + 1);
  } else {
    step_ = step_ == Step::stop ? Step::position : Step::done;
  }
}

Status QuickSilver::take_step(std::size_t drive, Nanoseconds deadline) {
  std::int64_t beats = 0;
  switch (step_) {
    case Step::stop:
      return stop_drive(drive, deadline);
    case Step::signature:
      return see_signature(drive, deadline);
    case Step::position:
      return see_position(drive, deadline);
    case Step::acceleration:
      return link_.command(
          drive, to(drive, Command::write_register, {settings_.velocity_register - 1, drives_[drive].acceleration}),
          deadline);
    case Step::acceleration_again:
      return see_acceleration(drive, deadline);
    case Step::heartbeat:
      return see_heartbeat(drive, deadline, beats);
    case Step::trial:
      drives_[drive].told_to_stop = false;
      trial_end_ = clock_->now() + as_nanoseconds(kTrialPatience * settings_.watchdog_s);
      return link_.command(drive, to(drive, Command::write_register, {settings_.velocity_register, kTrialVelocity}),
                           deadline);
    case Step::heartbeat_again:
      return see_heartbeat_move(drive, deadline);
    case Step::trial_again:
      return see_velocity_zeroed(drive, deadline);
    case Step::done:
      break;
  }
  return Status::ok;
}

Status QuickSilver::see_signature(std::size_t drive, Nanoseconds deadline) {
  std::int32_t signature = 0;
  const Status status = link_.read_register(drive, settings_.signature_register, deadline, signature);
  if (status != Status::ok || signature == kQuickSilverSignature) return status;
  rebase(drive);
  counters_.add(QuickSilverCounters::dead_programs);
  problem_.set("drive %d: no resident program: signature register %d holds %d instead of %d", wheel(drive).address,
               settings_.signature_register, signature, kQuickSilverSignature);
  return Status::refused;
}

void QuickSilver::rebase(std::size_t drive) {
  QuickSilverTravel& travel = drives_[drive].travel;
  if (travel.has_position()) counters_.add(QuickSilverCounters::position_jumps);
  travel.rebase();
}

Status QuickSilver::see_position(std::size_t drive, Nanoseconds deadline) {
  std::int32_t position = 0;
  const Status status = link_.read_register(drive, quicksilver::kPositionRegister, deadline, position);
  if (status != Status::ok) return status;
  QuickSilverTravel& travel = drives_[drive].travel;
  if (travel.take(position, clock_->now()) != QuickSilverTravel::Verdict::believed) {
    rebase(drive);
    (void)travel.take(position, clock_->now());
  }
  drives_[drive].known_at = clock_->now();
  return status;
}

Status QuickSilver::see_acceleration(std::size_t drive, Nanoseconds deadline) {
  std::int32_t acceleration = 0;
  const Status status = link_.read_register(drive, settings_.velocity_register - 1, deadline, acceleration);
  if (status != Status::ok || acceleration == drives_[drive].acceleration) return status;
  problem_.set("drive %d: register %d holds %d instead of the acceleration %d", wheel(drive).address,
               settings_.velocity_register - 1, acceleration, drives_[drive].acceleration);
  return Status::refused;
}

// A heartbeat that grew too little in a long time has begun again and caught up with where it was.
Status QuickSilver::see_heartbeat(std::size_t drive, Nanoseconds deadline, std::int64_t& beats) {
  Drive& d = drives_[drive];
  std::int32_t heartbeat = 0;
  beats = 0;
  const Status status = link_.read_register(drive, settings_.heartbeat_register, deadline, heartbeat);
  if (status != Status::ok) return status;
  const Nanoseconds now = clock_->now();
  if (d.heartbeat_time > 0) {
    const double seconds = static_cast<double>(now - d.heartbeat_time) / kSecond;
    beats = quicksilver::counts_between(d.heartbeat, heartbeat);
    const bool caught_up =
        seconds > kCatchUpTime && static_cast<double>(beats) < kFewBeats * d.beats_per_s * seconds;
    if (beats > 0 && caught_up) beats = -1;
    if (step_ == Step::heartbeat_again) d.beats_per_s = static_cast<double>(beats) / seconds;
    if (beats < 0) rebase(drive);
  }
  d.heartbeat = heartbeat;
  d.heartbeat_time = now;
  return status;
}

Status QuickSilver::see_heartbeat_move(std::size_t drive, Nanoseconds deadline) {
  std::int64_t beats = 0;
  const Status status = see_heartbeat(drive, deadline, beats);
  if (status != Status::ok) return status;
  drives_[drive].known_at = clock_->now();
  if (beats == 0) return program_is_dead(drive, "its heartbeat stands still");
  return beats > 0 ? Status::ok : program_is_dead(drive, "it has started anew");
}

Status QuickSilver::see_velocity_zeroed(std::size_t drive, Nanoseconds deadline) {
  std::int32_t velocity = 0;
  const Status status = link_.read_register(drive, settings_.velocity_register, deadline, velocity);
  if (status != Status::ok || velocity == 0) return status;
  return program_is_dead(drive, "it does not zero a velocity that nobody keeps alive");
}

Status QuickSilver::program_is_dead(std::size_t drive, const char* why) {
  counters_.add(QuickSilverCounters::dead_programs);
  problem_.set("drive %d: resident program: %s", wheel(drive).address, why);
  return Status::refused;
}

}  // namespace lakshya

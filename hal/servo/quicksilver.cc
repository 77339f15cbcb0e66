#include "hal/servo/quicksilver.h"

#include <algorithm>

#include "hal/servo/speed_guard.h"

namespace lakshya {

using quicksilver::Command;
using quicksilver::CommandText;

namespace {

constexpr Nanoseconds kStopTime = 5 * kMillisecond;  // of one drive; kept back for it while the other is spoken to
constexpr Nanoseconds kDriveTime = 18 * kMillisecond;
constexpr Nanoseconds kTravelTime = 13 * kMillisecond;
constexpr Nanoseconds kWatchEvery = kSecond;
constexpr Nanoseconds kLongestPause = 200 * kMillisecond;  // no drive starts in less
constexpr int kMissedChecks = 5;
constexpr std::int32_t kCounterEnd = 10;  // one digit is the shortest to write; two in turn would do

}  // namespace

QuickSilver::QuickSilver(const QuickSilverSettings& settings, SerialPort& port, Clock& clock)
    : settings_(settings),
      clock_(&clock),
      link_(port, clock, {settings.left.address, settings.right.address},
            {.answer = as_nanoseconds(settings.answer_timeout_s), .quiet = as_nanoseconds(settings.quiet_s)},
            counters_, problem_) {}

QuickSilver::~QuickSilver() {
  QuickSilver::close();
}

double QuickSilver::max_speed_mps() const {
  return speed_limit(settings_.max_speed_mps, settings_.supervised, settings_.v_unsupervised_mps);
}

CommandText QuickSilver::to(std::size_t drive, Command command,
                            std::initializer_list<std::int32_t> parameters) const {
  return {wheel(drive).address, command, parameters};
}

// ---- drive and stop

Status QuickSilver::refuse(Nanoseconds deadline) {
  counters_.add(QuickSilverCounters::refused_commands);
  const Problem why = problem_;
  (void)stop(deadline);
  problem_ = why;
  return Status::refused;
}

Status QuickSilver::drive(const WheelVelocities& wanted, Nanoseconds deadline) {
  const std::array<double, 2> speeds = {wanted.left_mps, wanted.right_mps};
  if (!speeds_allowed(wanted, *this, problem_)) return refuse(deadline);
  const Status ready = be_ready(deadline);
  if (ready != Status::ok) return ready;
  const Nanoseconds left = std::max<Nanoseconds>(deadline - clock_->now(), 0);
  const Nanoseconds velocities_by = deadline - std::min(kStopTime, left / 2);
  const Status settled = link_.settle_both(velocities_by, kDriveTime);
  if (settled != Status::ok) {
    // Both told, and no time left: one more command could only end in the next debt, and so for ever.
    const bool both_told = drives_[0].told_to_stop && drives_[1].told_to_stop;
    return both_told ? settled : stop_after(settled, 0, deadline);
  }
  for (std::size_t d = 0; d < drives_.size(); ++d) {
    const Status status = set_velocity(d, speeds[d], velocities_by);
    if (status != Status::ok) return stop_after(status, 1 - d, deadline);
  }
  if (!settings_.supervised) return Status::ok;
  counter_ = (counter_ + 1) % kCounterEnd;
  for (std::size_t d = 0; d < drives_.size(); ++d) {
    const Status status = feed(d, deadline);
    if (status != Status::ok) return stop_after(status, 1 - d, deadline);
  }
  return Status::ok;
}

Status QuickSilver::stop_after(Status failure, std::size_t first, Nanoseconds deadline) {
  const Problem why = problem_;
  if (failure != Status::disconnected) (void)stop_both(first, deadline);
  problem_ = why;
  return failure;
}

Status QuickSilver::set_velocity(std::size_t drive, double speed_mps, Nanoseconds deadline) {
  drives_[drive].told_to_stop = false;
  std::int32_t units = 0;
  const Status status = quicksilver::velocity_units(speed_mps * motor_rpm_per_mps(wheel(drive)), units);
  if (status != Status::ok) return status;
  if (settings_.supervised)
    return link_.command(drive, to(drive, Command::write_register, {settings_.velocity_register, units}), deadline);
  return link_.command(drive, to(drive, Command::velocity, {drives_[drive].acceleration, units, 0, 0}), deadline);
}

Status QuickSilver::feed(std::size_t drive, Nanoseconds deadline) {
  return link_.command(drive, to(drive, Command::write_register, {settings_.counter_register, counter_}), deadline);
}

Status QuickSilver::stop(Nanoseconds deadline) {
  if (!opened_) {
    problem_.set("drives: not open");
    return Status::disconnected;
  }
  if (!link_.is_open()) {
    if (clock_->now() < next_try_) return Status::disconnected;
    last_try_ = reopen();
    if (last_try_ != Status::ok) return last_try_;
  }
  if (trial_is_on()) return Status::ok;
  return stop_both(0, deadline);
}

Status QuickSilver::stop_both(std::size_t first, Nanoseconds deadline) {
  const Nanoseconds now = clock_->now();
  const Status first_status = stop_drive(first, now + (deadline - now) / 2);
  const Problem why = problem_;
  const Status second_status = stop_drive(1 - first, deadline);
  if (first_status == Status::ok) return second_status;
  problem_ = why;
  return first_status;
}

// A drive that owes a reply is told before it is asked: waiting for the reply could take all the time there is. It is told
// once: each time more would be one more reply to wait for.
Status QuickSilver::stop_drive(std::size_t drive, Nanoseconds deadline) {
  const CommandText stop_text = settings_.supervised
                                    ? to(drive, Command::write_register, {settings_.velocity_register, 0})
                                    : to(drive, Command::stop, {0});
  const bool owed = link_.owes_reply(drive);
  if (owed && !drives_[drive].told_to_stop) link_.send_blindly(drive, stop_text, deadline);
  drives_[drive].told_to_stop = true;
  const Nanoseconds half = clock_->now() + (deadline - clock_->now()) / 2;
  Status status = link_.command(drive, stop_text, half);
  // Busy passes, and HLT, which a drive that is busy may take, would end its program until somebody switches it off and on.
  while (status == Status::refused && link_.was_busy() && clock_->now() + kStopTime <= deadline)
    status = link_.command(drive, stop_text, deadline);
  if (status == Status::ok || status == Status::disconnected) return status;
  if (status != Status::refused) {
    if (!owed) link_.send_blindly(drive, stop_text, deadline);
    return status;
  }
  if (link_.was_busy()) return status;
  // It listens, but will not stop this way. HLT ends a resident program, so what the drive was is to be seen anew.
  start_over();
  return link_.command(drive, to(drive, Command::halt, {}), deadline) == Status::ok ? Status::ok : status;
}

// ---- travel

Status QuickSilver::read_travel(Nanoseconds deadline, WheelTravel& travel) {
  const Status ready = be_ready(deadline);
  if (ready != Status::ok) return ready;
  const Status settled = link_.settle_both(deadline, kTravelTime);
  if (settled != Status::ok) return settled;
  const Nanoseconds begin = clock_->now();
  std::array<std::int32_t, 2> positions{};
  for (std::size_t d = 0; d < drives_.size(); ++d) {
    const Status status = link_.read_register(d, quicksilver::kPositionRegister, deadline, positions[d]);
    if (status != Status::ok) return status;
  }
  const Nanoseconds time = begin + (clock_->now() - begin) / 2;
  const Status known = see_unknown_ones(positions, deadline);
  if (known != Status::ok) return known;
  const Status believed = take_positions(positions, time, deadline);
  travel = {
      .left_m = drives_[0].travel.metres(), .right_m = drives_[1].travel.metres(), .measured = true, .time = time};
  const Status programs = watch_programs(deadline);
  return programs != Status::ok ? programs : believed;
}

Status QuickSilver::take_positions(const std::array<std::int32_t, 2>& positions, Nanoseconds time,
                                   Nanoseconds deadline) {
  using Verdict = QuickSilverTravel::Verdict;
  Status status = Status::ok;
  for (std::size_t d = 0; d < drives_.size(); ++d) {
    const Verdict verdict = drives_[d].travel.take(positions[d], time);
    if (verdict == Verdict::believed) {
      drives_[d].known_at = time;
      continue;
    }
    status = Status::bad_data;
    problem_.set("drive %d: position %d is further than its wheel can have gone", wheel(d).address, positions[d]);
    if (verdict == Verdict::doubted) continue;
    // A drive that started anew has lost its settings.
    counters_.add(QuickSilverCounters::position_jumps);
    problem_.set("drive %d: has started anew at position %d", wheel(d).address, positions[d]);
    start_over();
  }
  return step_ == Step::done ? status : stop_after(status, 0, deadline);
}

// A drive that was silent may have been without power.
bool QuickSilver::is_unknown(std::size_t drive) const {
  const Drive& d = drives_[drive];
  return settings_.supervised && d.travel.has_position() && d.heartbeat_time > 0 &&
         clock_->now() - d.known_at > kLongestPause;
}

// Before a position is believed that is not where the wheel was. Where there is no time for both drives, the next call goes on.
Status QuickSilver::see_unknown_ones(const std::array<std::int32_t, 2>& positions, Nanoseconds deadline) {
  for (std::size_t d = 0; d < drives_.size(); ++d) {
    if (!is_unknown(d) || drives_[d].travel.is_where_it_was(positions[d])) continue;
    if (clock_->now() + QuickSilverLink::kCommandTime > deadline) {
      problem_.set("drive %d: no time left to see whether it has started anew", wheel(d).address);
      return Status::timeout;
    }
    const Status status = see_heartbeat_move(d, deadline);
    if (status == Status::refused) {
      start_over();
      return stop_after(status, d, deadline);
    }
    if (status != Status::ok) return status;
  }
  return Status::ok;
}

// One of them in a call, when it is time and there is time.
Status QuickSilver::watch_programs(Nanoseconds deadline) {
  if (!settings_.supervised || step_ != Step::done) return Status::ok;
  const std::size_t d = drives_[0].heartbeat_time <= drives_[1].heartbeat_time ? 0 : 1;
  const Nanoseconds now = clock_->now();
  if (now < drives_[d].heartbeat_time + kWatchEvery || now + QuickSilverLink::kCommandTime > deadline)
    return Status::ok;
  Status status = see_heartbeat_move(d, deadline);
  if (status == Status::ok) drives_[d].missed_checks = 0;
  if (status == Status::ok || status == Status::disconnected) return status;
  if (status != Status::refused) {
    if (++drives_[d].missed_checks < kMissedChecks) return Status::ok;
    status = program_is_dead(d, "its heartbeat cannot be read");
  }
  start_over();
  return stop_after(status, d, deadline);
}

}  // namespace lakshya

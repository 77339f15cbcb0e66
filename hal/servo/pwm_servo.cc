#include "hal/servo/pwm_servo.h"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

#include "hal/servo/speed_guard.h"

namespace lakshya {
namespace {

enum CounterIndex : std::size_t { kRefused, kWriteFailures, kDisconnections };

constexpr int kNanosecondsPerMicrosecond = 1000;
constexpr Nanoseconds kExportTime = kSecond / 2;
constexpr Nanoseconds kExportPoll = 10 * kMillisecond;
constexpr Nanoseconds kLongestStep = 100 * kMillisecond;  // a pause between calls is no leave for a jump

bool is_direction(int d) {
  return d == 1 || d == -1;
}

// A chip that is gone matters more than one that will not.
Status worse(Status a, Status b) {
  return a == Status::ok || b == Status::disconnected ? b : a;
}

double towards(double now, double wanted, double step) {
  return now + std::clamp(wanted - now, -step, step);
}

}  // namespace

PwmServo::PwmServo(PwmServoSettings settings, Clock& clock, SystemCalls& system)
    : settings_(std::move(settings)), clock_(&clock), system_(&system) {}

PwmServo::~PwmServo() {
  PwmServo::close();
}

double PwmServo::max_speed_mps() const {
  return speed_limit(settings_.max_speed_mps, settings_.supervised, settings_.unsupervised_mps);
}

bool PwmServo::settings_ok() {
  const PwmServoSettings& s = settings_;
  const int longest = std::max(s.center_us[0], s.center_us[1]) + s.span_us;
  const int shortest = std::min(s.center_us[0], s.center_us[1]) - s.span_us;
  if (s.span_us < 1 || shortest < 300 || longest > 2700 || longest >= s.period_us) {
    problem_.set("pulses of %d to %d us every %d us: not what such drives take", shortest, longest, s.period_us);
  } else if (s.chip < 0 || s.channel[0] < 0 || s.channel[1] < 0 || s.channel[0] == s.channel[1]) {
    problem_.set("channels %d and %d of chip %d: no two channels", s.channel[0], s.channel[1], s.chip);
  } else if (!is_direction(s.direction[0]) || !is_direction(s.direction[1])) {
    problem_.set("directions %d and %d: 1 or -1", s.direction[0], s.direction[1]);
  } else if (!(s.full_speed_mps > 0 && s.max_speed_mps > 0 && s.max_speed_mps <= s.full_speed_mps &&
               s.slew_mps2 > 0 && s.unsupervised_mps >= 0)) {
    problem_.set("speeds of at most %g m/s where full speed is %g m/s, slew %g m/s^2: not possible",
                 s.max_speed_mps, s.full_speed_mps, s.slew_mps2);
  } else {
    return true;
  }
  return false;
}

Status PwmServo::open() {
  close();
  if (!settings_ok()) return Status::bad_argument;
  for (int side = 0; side < 2; ++side) {
    const Status status = open_channel(side, clock_->now() + kExportTime);
    if (status != Status::ok) {
      release();
      return status;
    }
  }
  wanted_open_ = true;
  pulses_since_ = clock_->now();
  travel_.start(pulses_since_);
  return Status::ok;
}

Status PwmServo::open_channel(int side, Nanoseconds deadline) {
  const auto s = static_cast<std::size_t>(side);
  char path[160];
  char channel[16];
  (void)std::snprintf(path, sizeof path, "%s/pwmchip%d/export", settings_.root.c_str(), settings_.chip);
  const int length = std::snprintf(channel, sizeof channel, "%d", settings_.channel[s]);
  const int fd = system_->open(path, O_WRONLY);
  if (fd < 0) {
    problem_.set("%s: %s", path, strerrordesc_np(-fd));
    return Status::disconnected;
  }
  const long exported = system_->write_at_start(fd, {channel, static_cast<std::size_t>(length)});
  (void)system_->close(fd);
  // Busy: exported before, by us or by whoever set the machine up.
  if (exported < 0 && exported != -EBUSY) {
    problem_.set("%s: channel %s: %s", path, channel, strerrordesc_np(static_cast<int>(-exported)));
    return exported == -ENODEV || exported == -EINVAL ? Status::bad_argument : Status::refused;
  }
  // The files come at once, their permissions when udev has seen to them.
  while ((duty_fd_[s] = open_attribute(side, "duty_cycle")) < 0) {
    if (clock_->now() >= deadline) return Status::disconnected;
    clock_->sleep_until(std::min(clock_->now() + kExportPoll, deadline));
  }
  // A period may not be shorter than the pulse that is set, nor a pulse longer than the period: pulse 0 goes between.
  for (const auto& [name, value] : {std::pair{"duty_cycle", 0},
                                    {"period", settings_.period_us * kNanosecondsPerMicrosecond},
                                    {"duty_cycle", settings_.center_us[s] * kNanosecondsPerMicrosecond},
                                    {"enable", 1}}) {
    const Status status = write_attribute(side, name, value);
    if (status != Status::ok) return status;
  }
  return Status::ok;
}

int PwmServo::open_attribute(int side, const char* name) {
  char path[160];
  (void)std::snprintf(path, sizeof path, "%s/pwmchip%d/pwm%d/%s", settings_.root.c_str(), settings_.chip,
                      settings_.channel[static_cast<std::size_t>(side)], name);
  const int fd = system_->open(path, O_WRONLY);
  if (fd < 0) problem_.set("%s: %s", path, strerrordesc_np(-fd));
  return fd;
}

Status PwmServo::write_attribute(int side, const char* name, int value) {
  const int fd = open_attribute(side, name);
  if (fd < 0) return Status::disconnected;
  const Status status = write_number(fd, side, name, value);
  (void)system_->close(fd);
  return status;
}

Status PwmServo::write_number(int fd, int side, const char* name, int value) {
  char text[16];
  const int length = std::snprintf(text, sizeof text, "%d", value);
  const long written = system_->write_at_start(fd, {text, static_cast<std::size_t>(length)});
  if (written == length) return Status::ok;
  ++counters_[kWriteFailures].value;
  problem_.set("pwmchip%d, channel %d: %s %s: %s", settings_.chip,
               settings_.channel[static_cast<std::size_t>(side)], name, text,
               written < 0 ? strerrordesc_np(static_cast<int>(-written)) : "cut short");
  return written == -EINVAL || written == -EBUSY ? Status::refused : Status::disconnected;
}

void PwmServo::release() {
  for (int& fd : duty_fd_) {
    if (fd >= 0) (void)system_->close(fd);
    fd = -1;
  }
}

void PwmServo::close() {
  if (!wanted_open_) return;
  (void)rest();
  for (int side = 0; side < 2; ++side)
    (void)write_attribute(side, "enable", 0);
  release();
  wanted_open_ = false;
}

// By name where the file is not held: a chip that answered badly once may well take this.
Status PwmServo::rest() {
  Status result = Status::ok;
  for (int side = 0; side < 2; ++side) {
    const auto s = static_cast<std::size_t>(side);
    const int pulse = settings_.center_us[s] * kNanosecondsPerMicrosecond;
    const Status status = duty_fd_[s] >= 0 ? write_number(duty_fd_[s], side, "duty_cycle", pulse)
                                           : write_attribute(side, "duty_cycle", pulse);
    result = worse(result, status);
  }
  pulses_since_ = clock_->now();
  travel_.set({}, pulses_since_);
  return result;
}

Status PwmServo::set_pulses(const WheelVelocities& speeds) {
  const std::array<double, 2> wanted = {speeds.left_mps, speeds.right_mps};
  Status result = Status::ok;
  for (int side = 0; side < 2 && result == Status::ok; ++side) {
    const auto s = static_cast<std::size_t>(side);
    const double share = std::clamp(wanted[s] / settings_.full_speed_mps, -1.0, 1.0) * settings_.direction[s];
    const double pulse_us = settings_.center_us[s] + share * settings_.span_us;
    result = write_number(duty_fd_[s], side, "duty_cycle",
                          static_cast<int>(std::lround(pulse_us * kNanosecondsPerMicrosecond)));
  }
  if (result == Status::ok) {
    pulses_since_ = clock_->now();
    travel_.set(speeds, pulses_since_);
    return result;
  }
  // One wheel alone would turn the vehicle round.
  const Problem why = problem_;
  (void)rest();
  problem_ = why;
  if (result == Status::disconnected) {
    ++counters_[kDisconnections].value;
    release();
  }
  return result;
}

Status PwmServo::reopen_when_due() {
  if (!wanted_open_) return Status::disconnected;
  if (duty_fd_[0] >= 0) return Status::ok;
  if (!retry_.due(clock_->now())) return Status::disconnected;
  // Not open(): the way travelled goes on counting, and nobody waits here for files.
  for (int side = 0; side < 2; ++side) {
    const Status status = open_channel(side, clock_->now());
    if (status == Status::ok) continue;
    release();
    return Status::disconnected;
  }
  pulses_since_ = clock_->now();
  return Status::ok;
}

Status PwmServo::drive(const WheelVelocities& wanted, Nanoseconds /*deadline*/) {
  const Status ready = reopen_when_due();
  if (ready != Status::ok) return ready;
  if (!speeds_allowed(wanted, *this, problem_)) {
    ++counters_[kRefused].value;
    (void)set_pulses({});
    return Status::refused;
  }
  const WheelVelocities& now = travel_.speeds();
  const Nanoseconds since = std::min(clock_->now() - pulses_since_, kLongestStep);
  const double step = settings_.slew_mps2 * static_cast<double>(since) / static_cast<double>(kSecond);
  return set_pulses({towards(now.left_mps, wanted.left_mps, step), towards(now.right_mps, wanted.right_mps, step)});
}

Status PwmServo::read_travel(Nanoseconds /*deadline*/, WheelTravel& travel) {
  if (!wanted_open_ || duty_fd_[0] < 0) return Status::disconnected;
  travel = travel_.until(clock_->now());
  return Status::ok;
}

Status PwmServo::stop(Nanoseconds /*deadline*/) {
  return wanted_open_ ? rest() : Status::disconnected;
}

}  // namespace lakshya

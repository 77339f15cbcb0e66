#include "hal/servo/record_servo.h"

#include <fcntl.h>

#include <cstdio>
#include <cstring>
#include <utility>

#include "hal/servo/speed_guard.h"

namespace lakshya {
namespace {

enum CounterIndex : std::size_t { kCommands, kRefused, kWriteFailures };

}  // namespace

RecordServo::RecordServo(RecordServoSettings settings, Clock& clock, SystemCalls& system)
    : settings_(std::move(settings)), clock_(&clock), system_(&system) {}

RecordServo::~RecordServo() {
  RecordServo::close();
}

Status RecordServo::open() {
  close();
  if (!settings_.path.empty()) {
    fd_ = system_->open(settings_.path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND);
    if (fd_ < 0) {
      problem_.set("%s: cannot be written: %s", settings_.path.c_str(), strerrordesc_np(-fd_));
      return Status::disconnected;
    }
  }
  travel_.start(clock_->now());
  open_ = true;
  return Status::ok;
}

void RecordServo::close() {
  if (!open_) return;
  (void)stop(clock_->now());
  if (fd_ >= 0) (void)system_->close(fd_);
  fd_ = -1;
  open_ = false;
}

Status RecordServo::write_line() {
  if (fd_ < 0) return Status::ok;
  char line[96];
  const double seconds = static_cast<double>(clock_->now()) / static_cast<double>(kSecond);
  const int length =
      std::snprintf(line, sizeof line, "%.6f,%.4f,%.4f\n", seconds, last().left_mps, last().right_mps);
  // The file is open for appending: where it is written does not depend on an offset.
  const long written = system_->write_at_start(fd_, {line, static_cast<std::size_t>(length)});
  if (written == length) return Status::ok;
  ++counters_[kWriteFailures].value;
  problem_.set("%s: cannot be written: %s", settings_.path.c_str(),
               written < 0 ? strerrordesc_np(static_cast<int>(-written)) : "disk full");
  return Status::disconnected;
}

Status RecordServo::drive(const WheelVelocities& wanted, Nanoseconds /*deadline*/) {
  if (!open_) return Status::disconnected;
  const bool allowed = speeds_allowed(wanted, *this, problem_);
  travel_.set(allowed ? wanted : WheelVelocities{}, clock_->now());
  ++counters_[kCommands].value;
  if (!allowed) ++counters_[kRefused].value;
  const Status written = write_line();
  return allowed ? written : Status::refused;
}

Status RecordServo::read_travel(Nanoseconds /*deadline*/, WheelTravel& travel) {
  if (!open_) return Status::disconnected;
  travel = travel_.until(clock_->now());
  return Status::ok;
}

Status RecordServo::stop(Nanoseconds deadline) {
  return drive({}, deadline);
}

}  // namespace lakshya

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
  now_ = {};
  travel_ = {.measured = false, .time = clock_->now()};
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

void RecordServo::advance() {
  const Nanoseconds now = clock_->now();
  const double seconds = static_cast<double>(now - travel_.time) / static_cast<double>(kSecond);
  travel_.left_m += now_.left_mps * seconds;
  travel_.right_m += now_.right_mps * seconds;
  travel_.time = now;
}

Status RecordServo::write_line() {
  if (fd_ < 0) return Status::ok;
  char line[96];
  const double seconds = static_cast<double>(clock_->now()) / static_cast<double>(kSecond);
  const int length = std::snprintf(line, sizeof line, "%.6f,%.4f,%.4f\n", seconds, now_.left_mps, now_.right_mps);
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
  advance();
  const bool allowed = speeds_allowed(wanted, settings_.max_speed_mps);
  now_ = allowed ? wanted : WheelVelocities{};
  ++counters_[kCommands].value;
  const Status written = write_line();
  if (allowed) return written;
  ++counters_[kRefused].value;
  problem_.set("%g, %g m/s: faster than %g m/s; stopped", wanted.left_mps, wanted.right_mps,
               settings_.max_speed_mps);
  return Status::refused;
}

Status RecordServo::read_travel(Nanoseconds /*deadline*/, WheelTravel& travel) {
  if (!open_) return Status::disconnected;
  advance();
  travel = travel_;
  return Status::ok;
}

Status RecordServo::stop(Nanoseconds deadline) {
  return drive({}, deadline);
}

}  // namespace lakshya

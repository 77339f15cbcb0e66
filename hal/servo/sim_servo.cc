#include "hal/servo/sim_servo.h"

#include "hal/servo/speed_guard.h"

namespace lakshya {

Status SimServo::open() {
  open_ = true;
  return stop(clock_->now());
}

void SimServo::close() {
  if (open_) (void)stop(clock_->now());
  open_ = false;
}

Status SimServo::drive(const WheelVelocities& wanted, Nanoseconds /*deadline*/) {
  if (!open_) return Status::disconnected;
  if (speeds_allowed(wanted, *this, problem_)) return producer_->command(clock_->now(), wanted);
  ++counters_[0].value;
  (void)producer_->command(clock_->now(), {});
  return Status::refused;
}

Status SimServo::read_travel(Nanoseconds /*deadline*/, WheelTravel& travel) {
  if (!open_) return Status::disconnected;
  const Nanoseconds now = clock_->now();
  const Status status = producer_->travel(now, travel);
  travel.time = now;
  return status;
}

Status SimServo::stop(Nanoseconds deadline) {
  return drive({}, deadline);
}

}  // namespace lakshya

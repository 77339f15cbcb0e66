#include "app/loop/driving.h"

#include <algorithm>

namespace lakshya {
namespace {

// What the drives may take to confirm: the slowest line needs a quarter of it, the rest is for a busy machine.
constexpr Nanoseconds kDriveTime = 70 * kMillisecond;
// A reading that is lost is made again; what waits may be a stop.
constexpr Nanoseconds kTravelTime = 40 * kMillisecond;
// Control commands every 20 ms. One that has not for so long hangs, and its last command is no longer one: the drives must not be
// kept awake with it.
constexpr Nanoseconds kOldestCommand = 80 * kMillisecond;

}  // namespace

void Driving::command(Nanoseconds limit) {
  (void)exchange_->drive_command.take();
  const DriveCommand& c = exchange_->drive_command.reading();
  const Nanoseconds now = clock_->now();
  const Nanoseconds deadline = std::min(now + kDriveTime, limit);
  const bool stops = c.stops || now - c.time > kOldestCommand;
  // A stop is as fast as the drives can. Zero by drive() keeps supervised ones awake, and shows whether they answer.
  note_.command_status = stops ? servo_->stop(deadline) : servo_->drive(c.wheels, deadline);
  if (note_.command_status != Status::ok && !stops) (void)servo_->stop(std::min(clock_->now() + kDriveTime, limit));
  note_.number = c.number;
  note_.time = clock_->now();
}

void Driving::read_travel(Nanoseconds limit) {
  WheelTravel travel;
  note_.travel_status = servo_->read_travel(std::min(clock_->now() + kTravelTime, limit), travel);
  if (note_.travel_status == Status::ok) note_.travel = travel;
}

void Driving::step(Nanoseconds limit) {
  command(limit);
  if (!exchange_->drive_command.has_new() || !exchange_->drive_is_urgent.load(std::memory_order_acquire))
    read_travel(limit);
  exchange_->drive.writing() = note_;
  (void)exchange_->drive.publish();
}

}  // namespace lakshya

#include "app/loop/driving.h"

namespace lakshya {
namespace {

// What the drives may take to confirm: the slowest line needs a quarter of it, the rest is for a busy machine.
constexpr Nanoseconds kDriveTime = 70 * kMillisecond;

}  // namespace

void Driving::command() {
  (void)exchange_->drive_command.take();
  const DriveCommand& c = exchange_->drive_command.reading();
  const Nanoseconds deadline = clock_->now() + kDriveTime;
  // A stop is as fast as the drives can. Zero by drive() keeps supervised ones awake, and shows whether they answer.
  note_.command_status = c.stops ? servo_->stop(deadline) : servo_->drive(c.wheels, deadline);
  if (note_.command_status != Status::ok && !c.stops) (void)servo_->stop(clock_->now() + kDriveTime);
  note_.number = c.number;
  note_.time = clock_->now();
}

void Driving::read_travel() {
  WheelTravel travel;
  note_.travel_status = servo_->read_travel(clock_->now() + kDriveTime, travel);
  if (note_.travel_status == Status::ok) note_.travel = travel;
}

void Driving::step() {
  command();
  if (!exchange_->drive_command.has_new() || !exchange_->drive_is_urgent.load(std::memory_order_acquire))
    read_travel();
  exchange_->drive.writing() = note_;
  (void)exchange_->drive.publish();
}

}  // namespace lakshya

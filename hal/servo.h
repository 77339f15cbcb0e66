// Two driven wheels, one on each side (differential drive).
#pragma once

#include "hal/clock.h"
#include "hal/device.h"

namespace lakshya {

// Of the wheel's rim over the ground, forward positive.
struct WheelVelocities {
  double left_mps = 0;
  double right_mps = 0;
};

// How far each wheel's rim has gone since open(), forward positive.
struct WheelTravel {
  double left_m = 0;
  double right_m = 0;
  bool measured = true;  // false: the drives measure nothing, this is what was commanded
  Nanoseconds time = 0;  // when it was true
};

class Servo : public Device {
 public:
  // Velocities for both wheels, to hold until the next call. Each must be finite and not faster than max_speed_mps(); else
  // refused, and the wheels are stopped. timeout, bad_data, refused, disconnected: at least one drive may not have obeyed.
  virtual Status drive(const WheelVelocities& wanted, Nanoseconds deadline) = 0;

  virtual Status read_travel(Nanoseconds deadline, WheelTravel& travel) = 0;

  // Zero velocity as fast as the drives can; tried for each drive even if the other fails.
  virtual Status stop(Nanoseconds deadline) = 0;

  // What the drives may be asked for. Less than the configuration says where they would keep turning after this computer has
  // stopped (see is_supervised).
  virtual double max_speed_mps() const = 0;

  // The drives stop by themselves when no command comes.
  virtual bool is_supervised() const = 0;
};

}  // namespace lakshya

// The way of wheels that measure nothing, as if they obeyed at once.
#pragma once

#include "hal/servo.h"

namespace lakshya {

class CommandedTravel {
 public:
  // Wheels at rest at `now`, no way gone.
  void start(Nanoseconds now) {
    speeds_ = {};
    travel_ = {.measured = false, .time = now};
  }

  // From `now` on.
  void set(const WheelVelocities& speeds, Nanoseconds now) {
    (void)until(now);
    speeds_ = speeds;
  }

  const WheelTravel& until(Nanoseconds now) {
    const double seconds = static_cast<double>(now - travel_.time) / static_cast<double>(kSecond);
    travel_.left_m += speeds_.left_mps * seconds;
    travel_.right_m += speeds_.right_mps * seconds;
    travel_.time = now;
    return travel_;
  }

  const WheelVelocities& speeds() const { return speeds_; }

 private:
  WheelVelocities speeds_;
  WheelTravel travel_;
};

}  // namespace lakshya

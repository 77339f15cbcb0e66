// What the driver of two QuickSilver drives (hal/servo/quicksilver.h) wants to know, and what follows from it.
#pragma once

#include <cstdint>

#include "hal/clock.h"
#include "hal/problem.h"
#include "kernels/base/status.h"

namespace lakshya {

struct QuickSilverWheel {
  int address = 16;           // of its drive, 1 to 254
  int direction = 1;          // +1: positive counts are forward; -1: the motor is mounted the other way round
  double radius_m = 0.1;      // 0.01 to 2
  double gear_ratio = 10;     // motor revolutions for one of the wheel, 0.01 to 1000
  int counts_per_rev = 8000;  // of the motor's position, 100 to 1000000; 4000, 8000 and 16000 are common
};

struct QuickSilverSettings {
  QuickSilverWheel left{.address = 16};
  QuickSilverWheel right{.address = 17};
  double max_speed_mps = 1.0;          // of a wheel's rim, above 0; both motors stay below 4000 rpm
  double max_acceleration_mps2 = 0.5;  // of a wheel's rim, above 0; the drives keep to it, also when they stop

  bool supervised = true;           // by the resident program; false: VMI, and v_unsupervised is the limit
  double v_unsupervised_mps = 0.3;  // not below 0; 0: without the program they only stand
  // User registers of the resident program, 11 to 198, all different. The one before velocity_register holds the
  // acceleration, as the maker's command PVC wants it.
  int velocity_register = 30;
  int counter_register = 31;
  int heartbeat_register = 32;
  int signature_register = 33;
  double watchdog_s = 0.2;  // after which the program zeroes the velocity; the program's own number, 0.05 to 1

  double answer_timeout_s = 0.05;  // for one reply, 0.005 to 0.5; an adapter that holds bytes back counts, too
  double quiet_s = 0.05;  // how much later a reply may still come, 0.005 to 0.5 (hal/servo/quicksilver_link.h)
};

// What the resident program keeps in its signature register.
inline constexpr std::int32_t kQuickSilverSignature = 1280004401;  // "LKQ1"

// bad_argument for values outside of what is written above; `problem` says which.
Status check_settings(const QuickSilverSettings& settings, Problem& problem);

// Of a time in seconds that check_settings() has seen; 0 for anything that it refuses.
Nanoseconds as_nanoseconds(double seconds);

// Motor speed (signed as the drive counts) for 1 m/s forward at the rim.
double motor_rpm_per_mps(const QuickSilverWheel& wheel);

// Forward travel of the rim, signed as the drive counts.
double metres_per_count(const QuickSilverWheel& wheel);

}  // namespace lakshya

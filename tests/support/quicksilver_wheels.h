// What the tests of QuickSilver with emulated drives share: the wheels that the driver is told of, and what they really did.
#pragma once

#include <cmath>

#include "hal/servo/quicksilver.h"
#include "tests/emulators/quicksilver_drive.h"
#include "tests/support/quicksilver_rig.h"

namespace lakshya::test {

inline QuickSilverSettings emulated_quicksilver_settings() {
  QuickSilverSettings settings = quicksilver_settings();
  settings.max_acceleration_mps2 = 2;
  return settings;
}

// 8000 counts are 0.06 m. The right motor is mounted the other way round.
inline constexpr double kMetresPerCount = 0.06 / 8000;

inline double left_m(const emulator::QuickSilverState& state) {
  return state.position * kMetresPerCount;
}
inline double right_m(const emulator::QuickSilverState& state) {
  return -state.position * kMetresPerCount;
}
inline double speed_mps(const emulator::QuickSilverState& state) {
  return std::abs(state.velocity_rpm) * 0.06 / 60;
}

}  // namespace lakshya::test

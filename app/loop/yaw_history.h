// Where the vehicle pointed at a moment of the last half second or so: a pair is older than the pose that is known when it is
// processed, and a vehicle that turns at 90 degrees a second has turned by 9 in a tenth of it.
#pragma once

#include <array>
#include <cstddef>

#include "hal/angle.h"
#include "hal/clock.h"

namespace lakshya {

class YawHistory {
 public:
  // In order of time.
  void add(Nanoseconds time, double yaw) {
    if (count_ > 0 && time <= at(count_ - 1).time) return;
    entries_[count_++ % kLength] = {time, yaw};
  }

  // rad in (-pi, pi]; between two entries on the shorter way, before the oldest and after the newest that one's. 0 without any.
  double at_time(Nanoseconds time) const {
    if (count_ == 0) return 0;
    const std::size_t oldest = count_ > kLength ? count_ - kLength : 0;
    for (std::size_t i = count_ - 1; i > oldest; --i) {
      const Entry& before = at(i - 1);
      if (before.time > time) continue;
      const Entry& after = at(i);
      if (after.time <= time) return after.yaw;
      const double share = static_cast<double>(time - before.time) / static_cast<double>(after.time - before.time);
      return wrapped_angle(before.yaw + share * wrapped_angle(after.yaw - before.yaw));
    }
    return at(oldest).yaw;
  }

 private:
  struct Entry {
    Nanoseconds time = 0;
    double yaw = 0;
  };
  static constexpr std::size_t kLength = 32;

  const Entry& at(std::size_t i) const { return entries_[i % kLength]; }

  std::array<Entry, kLength> entries_{};
  std::size_t count_ = 0;
};

}  // namespace lakshya

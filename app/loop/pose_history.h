// Where the vehicle was at a moment of the last half second or so: a pair is older than the pose that is known when it is
// processed, and a vehicle that turns at 90 degrees a second has turned by 9 in a tenth of it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "hal/angle.h"
#include "hal/odometry.h"

namespace lakshya {

class PoseHistory {
 public:
  // In order of time.
  void add(const PoseSample& pose) {
    if (count_ > 0 && pose.time <= at(count_ - 1).time) return;
    entries_[count_++ % kLength] = pose;
  }

  // Between two entries on the straight line and the shorter way round; before the oldest that one's; after the newest as the vehicle
  // went on between the last two, for kMostAhead at most: a pair may come sooner than the drives' next answer. The time is the one
  // asked for. The origin without any.
  PoseSample at_time(Nanoseconds time) const {
    PoseSample pose = near(time);
    pose.time = time;
    return pose;
  }

 private:
  static constexpr std::size_t kLength = 32;
  static constexpr Nanoseconds kMostAhead = 100 * kMillisecond;

  static PoseSample on_line(const PoseSample& before, const PoseSample& after, Nanoseconds time) {
    const double share = static_cast<double>(time - before.time) / static_cast<double>(after.time - before.time);
    return {.east_m = before.east_m + share * (after.east_m - before.east_m),
            .north_m = before.north_m + share * (after.north_m - before.north_m),
            .yaw = wrapped_angle(before.yaw + share * wrapped_angle(after.yaw - before.yaw))};
  }

  PoseSample near(Nanoseconds time) const {
    if (count_ == 0) return {};
    const std::size_t oldest = count_ > kLength ? count_ - kLength : 0;
    for (std::size_t i = count_ - 1; i > oldest; --i) {
      const PoseSample& before = at(i - 1);
      if (before.time > time) continue;
      const PoseSample& after = at(i);
      return on_line(before, after, std::min(time, after.time + kMostAhead));
    }
    return at(oldest);
  }

  const PoseSample& at(std::size_t i) const { return entries_[i % kLength]; }

  std::array<PoseSample, kLength> entries_{};
  std::size_t count_ = 0;
};

}  // namespace lakshya

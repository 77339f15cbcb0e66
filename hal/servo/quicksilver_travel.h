// How far a wheel has gone, from the 32-bit position of its drive.
//
// The protocol has no checksum, and a drive that starts anew counts from zero. So a position that the wheel cannot have
// reached since the last one (faster than 1.5 times the top speed, and 50 mm besides) is not believed. When the next one is
// near it, the drive has started anew, and travel goes on from there; else it was damage on the line, and nothing is lost.
// What a drive does while nobody reads is not seen: the longer the pause, the more is believed, up to `longest_pause`.
#pragma once

#include <cstdint>
#include <limits>

#include "hal/clock.h"

namespace lakshya {

class QuickSilverTravel {
 public:
  enum class Verdict : std::uint8_t {
    believed,
    doubted,   // nothing is changed
    restarted  // two agree with each other and not with the ones before
  };

  // `metres_per_count` is signed: positive travel is forward.
  void start(double metres_per_count, double max_speed_mps,
             Nanoseconds longest_pause = std::numeric_limits<Nanoseconds>::max());

  // The first position after start() is where travel is 0. Differences are right while less than 2^31 counts lie between two.
  Verdict take(std::int32_t position, Nanoseconds time);

  // For a drive that has started anew: the next position is believed and adds no way.
  void rebase();
  bool has_position() const { return last_.exists; }
  // Within 50 mm of the last position.
  bool is_where_it_was(std::int32_t position) const;

  double metres() const { return static_cast<double>(counts_) * metres_per_count_; }

 private:
  struct Reading {
    bool exists = false;
    std::int32_t position = 0;
    Nanoseconds time = 0;
  };
  bool is_near(const Reading& before, const Reading& now) const;

  double metres_per_count_ = 0;
  double max_speed_mps_ = 0;
  Nanoseconds longest_pause_ = 0;
  std::int64_t counts_ = 0;
  Reading last_;
  Reading doubted_;
};

}  // namespace lakshya

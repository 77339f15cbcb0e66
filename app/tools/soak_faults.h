// What the endurance test does to the vehicle's devices: a sequence of faults that depends on a seed alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>

#include "hal/clock.h"

namespace lakshya {

enum class FaultKind : std::uint8_t {
  camera_silent,   // no pair comes
  camera_gone,     // disconnected
  camera_frozen,   // the same pair again and again
  camera_dark,     // one eye or both are black
  camera_bright,   // one eye or both are saturated
  camera_skewed,   // the two images were taken at different times
  camera_torn,     // pairs that nobody can use
  compass_silent,  // no heading comes
  compass_gone,    // disconnected
  compass_jumped,  // a heading that is wrong by 90 degrees
  compass_tipped,  // a roll above the limit
  drive_silent,    // no answer until the deadline
  drive_refused,
  drive_garbled,
  drive_gone,
  emergency_stop,  // pressed
};
inline constexpr std::size_t kFaultKinds = 16;

const char* to_string(FaultKind kind);
// A reset is needed after it.
bool latches(FaultKind kind);

enum class Eyes : std::uint8_t { both, left, right };

struct Fault {
  FaultKind kind = FaultKind::camera_silent;
  std::uint64_t number = 0;  // counted from 1
  Nanoseconds begin = 0;
  Nanoseconds end = 0;
  Eyes eyes = Eyes::both;  // camera_dark, camera_bright
  // When the loop was first given something wrong; -1: not yet. camera_frozen: the first pair that was the same as the one before.
  Nanoseconds felt = -1;
};

struct FaultSettings {
  std::uint64_t seed = 1;
  Nanoseconds recovery = 0;      // a pause this long lets the vehicle recover
  Nanoseconds longest_jump = 0;  // of a heading that shall not be believed
  bool can_freeze = true;        // false: the recording is a single pair, where frozen is not to be told from well
};

// One fault after the other, sometimes two at once, of different devices; mostly with a pause that is long enough to recover,
// sometimes with a shorter one. All kinds come equally often.
class FaultPlan {
 public:
  // The first fault begins some seconds after `start`.
  FaultPlan(const FaultSettings& settings, Nanoseconds start);

  // After every control turn. True: this is the time to reset what has latched.
  bool step(Nanoseconds now);

  // The fault of this kind that there is now; null: none.
  const Fault* active(FaultKind kind, Nanoseconds now) const;
  // The same, and what is about to be given to the loop is wrong because of it.
  const Fault* feel(FaultKind kind, Nanoseconds now);

  // One or two: those that come next, or are there, or have ended since the step before.
  std::span<const Fault> faults() const { return {faults_.data(), count_}; }

 private:
  double share();  // 0 <= share < 1
  Nanoseconds between(Nanoseconds least, Nanoseconds most);
  FaultKind draw_kind();
  FaultKind draw_kind_beside(FaultKind other);
  Fault draw_fault(FaultKind kind, Nanoseconds begin);
  void draw_next(Nanoseconds after);

  const FaultSettings settings_;
  std::mt19937_64 random_;
  std::array<FaultKind, kFaultKinds> deck_{};  // the kinds in a random order; those before next_ were had
  std::size_t next_ = kFaultKinds;
  std::array<Fault, 2> faults_;
  std::size_t count_ = 0;
  std::uint64_t numbers_ = 0;
  Nanoseconds reset_pause_ = 0;
};

}  // namespace lakshya

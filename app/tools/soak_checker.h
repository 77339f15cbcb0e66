// Does the vehicle stop for every fault, soon enough, stay stopped, and drive again afterwards? Is told what happened in every turn
// of the control loop, by the endurance test or by hand.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "app/loop/safety_table.h"
#include "app/tools/soak_faults.h"

namespace lakshya {

struct SoakLimits {
  // From a fault's beginning until the wheels have been told zero; they are not told anything else before its end.
  Nanoseconds reaction = 200 * kMillisecond;
  // From a fault's end (one that latches: from the reset) until the state is RUN.
  Nanoseconds recovery = 1500 * kMillisecond;
  // A frozen camera counts from when the wheels have gone this far since the first pair that was repeated.
  double frozen_travel_m = 0.02;
};

// A control turn that is over.
struct SoakTurn {
  Nanoseconds now = 0;
  State state = State::init;
  bool told_to_turn = false;      // the wheels' newest command, obeyed or not, is not zero
  double way_m = 0;               // that the wheels have gone, without sign
  std::span<const Fault> faults;  // FaultPlan's
};

enum class SoakRule : std::uint8_t { stops_in_time, recovers, waits_for_reset };

struct SoakViolation {
  SoakRule rule = SoakRule::stops_in_time;
  Nanoseconds now = 0;
  Nanoseconds since = 0;  // the fault's beginning, its end, or the beginning of what latched
  FaultKind kind = FaultKind::camera_silent;
  State state = State::init;
};
std::string violation_text(const SoakViolation& violation, Nanoseconds start);

// Of one kind of fault.
struct FaultRecord {
  std::uint64_t times = 0;
  std::uint64_t while_turning = 0;  // how often it began when the wheels were told to turn
  std::uint64_t stopped = 0;        // how often they were told zero because of it, or during it
  Nanoseconds worst_reaction = 0;   // a frozen camera's: 0 where zero came before its limit began to count
  std::uint64_t recovered = 0;      // how often RUN came after it (two at once count for the later end)
  Nanoseconds worst_recovery = 0;
};

class SoakChecker {
 public:
  // The vehicle must be in RUN soon after `start`.
  SoakChecker(const SoakLimits& limits, Nanoseconds start);

  void turn(const SoakTurn& turn);
  // The next turn will hear of a reset.
  void reset(Nanoseconds now);

  const std::array<FaultRecord, kFaultKinds>& records() const { return records_; }
  std::uint64_t faults() const { return faults_; }
  std::uint64_t violations() const { return violation_count_; }
  // The first of them.
  static constexpr std::size_t kMostKept = 20;
  const std::vector<SoakViolation>& first_violations() const { return violations_; }

 private:
  // A fault that was heard of.
  struct Track {
    std::uint64_t number = 0;
    Nanoseconds counts_from = -1;
    bool has_begun = false;
    bool is_over = false;
    bool turning = false;  // the wheels were told to turn in the last turn that counts
    bool told_late = false;
    Nanoseconds reaction = -1;  // until they were told zero for the last time
    double way_when_felt = -1;
  };

  FaultRecord& record(FaultKind kind) { return records_[static_cast<std::size_t>(kind)]; }
  void begin(const Fault& fault, Track& track);
  void watch(const Fault& fault, Track& track, const SoakTurn& turn);
  void finish(const Fault& fault, const Track& track);
  void check_latch(const SoakTurn& turn);
  void check_recovery(const SoakTurn& turn);
  void violate(const SoakViolation& violation);

  const SoakLimits limits_;
  std::array<Track, 2> tracks_;
  std::array<FaultRecord, kFaultKinds> records_{};
  std::uint64_t faults_ = 0;
  std::vector<SoakViolation> violations_;
  std::uint64_t violation_count_ = 0;
  bool told_to_turn_ = false;  // after the turn before
  bool any_fault_ = false;     // there is one now
  bool latched_ = false;
  bool told_latch_ = false;  // its violation is counted
  FaultKind latch_kind_ = FaultKind::emergency_stop;
  Nanoseconds latched_at_ = 0;
  Nanoseconds well_since_;
  FaultKind ended_ = FaultKind::camera_silent;  // the fault that ended last
  bool has_left_run_ = true;
  bool told_recovery_ = false;
  bool has_begun_ = false;  // a fault has ended, ever
};

}  // namespace lakshya

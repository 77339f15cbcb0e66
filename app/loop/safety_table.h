// The states of the vehicle, what can happen to it, and what follows: one table, docs/contract.md section 6. `lakshyad run
// --print-states` prints it; every fault's reaction time is in docs/safety.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace lakshya {

enum class State : std::uint8_t {
  init,      // not everything that is needed has been heard of yet
  ready,     // it has, and there is nowhere to go
  run,       // driving as planned
  degraded,  // driving, at safety.degraded_speed_mps at most
  stop,      // something is wrong that may become well again by itself
  fault,     // something is wrong that a person must look at: only a reset ends it
  end,       // the program is about to end
};
inline constexpr std::size_t kStates = 7;

enum class Event : std::uint8_t {
  // What a state waits for.
  all_well,
  go,
  arrived,
  reset,
  terminate,
  // Driving goes on, slowly.
  camera_damaged,
  recording_lost,
  watchdog_failed,
  // The wheels stop, and may turn again when all has been well for safety.recover_s.
  camera_silent,
  camera_gone,
  camera_frozen,
  camera_dark,
  camera_bright,
  camera_skewed,
  compass_silent,
  compass_gone,
  compass_jumped,
  drive_silent,
  drive_refused,
  drive_garbled,
  drive_gone,
  perception_late,
  perception_failed,
  plan_old,
  control_late,
  // The wheels stop until reset.
  emergency_stop,
  tipping,
  recording_failed,
  fault_before,
};
inline constexpr std::size_t kEvents = 29;

// What kind of thing an event is; the table's rows follow from it.
enum class Kind : std::uint8_t { course, slows, stops, latches };

// What is done about the wheels at once.
enum class Action : std::uint8_t {
  hold_zero,     // the wheels stand and are told so again and again
  zero_now,      // zero speed is commanded in this turn of the control loop
  drive,         // the plan's speeds
  drive_slowly,  // the same, at most safety.degraded_speed_mps
  zero_and_end,  // zero speed, then the devices are closed
};

struct Transition {
  State next = State::fault;
  Action action = Action::zero_now;
};

Transition transition(State state, Event event);
Kind kind_of(Event event);

const char* to_string(State state);
const char* to_string(Event event);
const char* to_string(Action action);
// A sentence for people: "no pair has come for safety.camera_silent_s".
const char* meaning(Event event);
const char* meaning(State state);

// The table as text, a line for every event.
std::string states_text();

constexpr bool may_drive(State state) {
  return state == State::run || state == State::degraded;
}

// Everything has been heard of.
constexpr bool has_been_ready(State state) {
  return state == State::ready || state == State::stop || may_drive(state);
}

// All events that are faults and last, as a set.
class EventSet {
 public:
  void set(Event event, bool on = true) {
    const std::uint64_t bit = std::uint64_t{1} << static_cast<unsigned>(event);
    bits_ = on ? bits_ | bit : bits_ & ~bit;
  }
  bool has(Event event) const { return (bits_ >> static_cast<unsigned>(event) & 1U) != 0; }
  bool any(Kind kind) const;
  bool empty() const { return bits_ == 0; }

 private:
  std::uint64_t bits_ = 0;
};

}  // namespace lakshya

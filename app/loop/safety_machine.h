// Walks through the table of safety_table.h, one step for every turn of the control loop.
#pragma once

#include <array>
#include <span>

#include "app/loop/safety_table.h"
#include "hal/clock.h"

namespace lakshya {

// What is so at this moment.
struct Conditions {
  EventSet faults;
  bool has_goal = false;  // there is somewhere to go
  bool reset = false;     // asked for since the step before
  bool terminate = false;
};

// A line of the log: a state has changed, or a fault has begun in a state that it does not change (from == to).
struct StateNote {
  Nanoseconds time = 0;
  Event event = Event::all_well;
  State from = State::init;
  State to = State::init;
};

class SafetyMachine {
 public:
  explicit SafetyMachine(Nanoseconds recover) : recover_(recover) {}

  // In order of time. What was noted is in notes() until the next step.
  Action step(Nanoseconds now, const Conditions& conditions);

  State state() const { return state_; }
  // Why the vehicle does not drive, or not as it should: the worst fault, of equal ones the first; all_well where nothing is
  // wrong.
  Event reason() const { return reason_; }
  std::span<const StateNote> notes() const { return {notes_.data(), noted_}; }

 private:
  void apply(Event event, Nanoseconds now, bool is_new);
  void note(Event event, State from, Nanoseconds now);
  void proceed(Nanoseconds now, const Conditions& conditions);
  void renew_reason(const EventSet& faults);

  const Nanoseconds recover_;
  State state_ = State::init;
  Event reason_ = Event::all_well;
  EventSet before_;
  Nanoseconds well_since_ = -1;   // no fault that stops; -1: there is one
  Nanoseconds whole_since_ = -1;  // no fault at all
  Action action_ = Action::hold_zero;
  std::array<StateNote, kEvents + 4> notes_;
  std::size_t noted_ = 0;
};

}  // namespace lakshya

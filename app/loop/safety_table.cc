#include "app/loop/safety_table.h"

#include <algorithm>
#include <string_view>

namespace lakshya {
namespace {

using enum State;

struct Row {
  Event event;
  Kind kind;
  const char* name;
  const char* meaning;
  std::array<State, kStates> next;  // from init, ready, run, degraded, stop, fault, end
};

// The rows of one kind are alike: a fault does to a state what its kind does.
constexpr std::array<State, kStates> kSlows{init, ready, degraded, degraded, stop, fault, end};
constexpr std::array<State, kStates> kStops{init, stop, stop, stop, stop, fault, end};
constexpr std::array<State, kStates> kLatches{fault, fault, fault, fault, fault, fault, end};

constexpr std::array<Row, kEvents> kRows{{
    {Event::all_well,
     Kind::course,
     "all_well",
     "nothing has been wrong for safety.recover_s",
     {ready, ready, run, run, ready, fault, end}},
    {Event::go, Kind::course, "go", "there is somewhere to go", {init, run, run, degraded, stop, fault, end}},
    {Event::arrived,
     Kind::course,
     "arrived",
     "the last way point is reached",
     {init, ready, ready, ready, stop, fault, end}},
    {Event::reset,
     Kind::course,
     "reset",
     "a person has asked for a reset (signal SIGUSR1)",
     {init, ready, run, degraded, stop, init, end}},
    {Event::terminate,
     Kind::course,
     "terminate",
     "the program is asked to end, or the recording is over",
     {end, end, end, end, end, end, end}},
    {Event::camera_damaged, Kind::slows, "camera_damaged", "a pair was torn, short or could not be decoded",
     kSlows},
    {Event::recording_lost, Kind::slows, "recording_lost", "the recording cannot be written, and may be lost",
     kSlows},
    {Event::watchdog_failed, Kind::slows, "watchdog_failed", "the machine's watchdog cannot be kicked", kSlows},
    {Event::camera_silent, Kind::stops, "camera_silent", "no pair has come for safety.camera_silent_s", kStops},
    {Event::camera_gone, Kind::stops, "camera_gone", "the camera is no longer there", kStops},
    {Event::camera_frozen, Kind::stops, "camera_frozen", "pairs are the same, byte for byte, while the wheels turn",
     kStops},
    {Event::camera_dark, Kind::stops, "camera_dark", "an image is black", kStops},
    {Event::camera_bright, Kind::stops, "camera_bright", "an image is saturated", kStops},
    {Event::camera_skewed, Kind::stops, "camera_skewed", "the images of a pair were taken at different times",
     kStops},
    {Event::compass_silent, Kind::stops, "compass_silent", "no heading has come for safety.compass_silent_s",
     kStops},
    {Event::compass_gone, Kind::stops, "compass_gone", "the compass is no longer there", kStops},
    {Event::compass_jumped, Kind::stops, "compass_jumped", "the heading does not agree with the wheels'", kStops},
    {Event::drive_silent, Kind::stops, "drive_silent", "a drive did not answer in time", kStops},
    {Event::drive_refused, Kind::stops, "drive_refused", "a drive answered that it will not", kStops},
    {Event::drive_garbled, Kind::stops, "drive_garbled", "what came back was not the drive's answer", kStops},
    {Event::drive_gone, Kind::stops, "drive_gone", "the drives' line is no longer there", kStops},
    {Event::perception_late, Kind::stops, "perception_late", "a pair has been worked on for safety.perception_s",
     kStops},
    {Event::perception_failed, Kind::stops, "perception_failed", "a pair could not be processed", kStops},
    {Event::plan_old, Kind::stops, "plan_old", "the plan is older than safety.plan_age_s", kStops},
    {Event::control_late, Kind::stops, "control_late", "the control loop began a turn safety.control_late_s late",
     kStops},
    {Event::emergency_stop, Kind::latches, "emergency_stop", "the emergency stop is pressed, or cannot be read",
     kLatches},
    {Event::tipping, Kind::latches, "tipping", "pitch or roll is greater than safety.tilt_deg", kLatches},
    {Event::recording_failed, Kind::latches, "recording_failed",
     "the recording cannot be written, and must not be lost", kLatches},
    {Event::fault_before, Kind::latches, "fault_before", "the program was killed, or crashed, in the state FAULT",
     kLatches},
}};

constexpr bool rows_are_in_order() {
  for (std::size_t i = 0; i < kEvents; ++i) {
    if (static_cast<std::size_t>(kRows[i].event) != i) return false;
  }
  return true;
}
static_assert(rows_are_in_order());

const Row& row(Event event) {
  return kRows[static_cast<std::size_t>(event)];
}

// By the state that follows; wheels that turned are told in the same turn.
constexpr Action action_of(State from, State next) {
  switch (next) {
    case run:
      return Action::drive;
    case degraded:
      return Action::drive_slowly;
    case end:
      return Action::zero_and_end;
    case init:
    case ready:
    case stop:
    case fault:
      return from == next ? Action::hold_zero : Action::zero_now;
  }
  return Action::zero_now;
}

struct StateText {
  const char* name;
  const char* meaning;
};
constexpr std::array<StateText, kStates> kStateTexts{{
    {"INIT", "not everything that is needed has been heard of yet"},
    {"READY", "it has, and there is nowhere to go yet"},
    {"RUN", "driving as planned"},
    {"DEGRADED", "driving at safety.degraded_speed_mps at most"},
    {"STOP", "something is wrong that may become well by itself"},
    {"FAULT", "something is wrong that only a reset ends"},
    {"END", "the program is about to end"},
}};

constexpr const char* kRecovery[] = {"", "by itself, after safety.recover_s", "by itself, after safety.recover_s",
                                     "by a reset"};

void pad(std::string& text, std::string_view word, std::size_t width) {
  text += word;
  text.append(std::max(width, word.size() + 1) - word.size(), ' ');
}

}  // namespace

Transition transition(State state, Event event) {
  const State next = row(event).next[static_cast<std::size_t>(state)];
  return {next, action_of(state, next)};
}

Kind kind_of(Event event) {
  return row(event).kind;
}

const char* to_string(State state) {
  return kStateTexts[static_cast<std::size_t>(state)].name;
}
const char* meaning(State state) {
  return kStateTexts[static_cast<std::size_t>(state)].meaning;
}
const char* to_string(Event event) {
  return row(event).name;
}
const char* meaning(Event event) {
  return row(event).meaning;
}

const char* to_string(Action action) {
  constexpr const char* kNames[] = {"hold zero", "zero now", "drive", "drive slowly", "zero and end"};
  return kNames[static_cast<std::size_t>(action)];
}

bool EventSet::any(Kind kind) const {
  return std::ranges::any_of(kRows, [&](const Row& r) { return r.kind == kind && has(r.event); });
}

std::string states_text() {
  std::string text = "States\n";
  for (const StateText& state : kStateTexts) {
    text += "  ";
    pad(text, state.name, 10);
    text.append(state.meaning).append("\n");
  }
  text += "\nWhat follows (state: action); a line is an event, a column the state before\n";
  pad(text, "event", 19);
  for (const StateText& state : kStateTexts)
    pad(text, state.name, 23);
  text += '\n';
  for (const Row& r : kRows) {
    pad(text, r.name, 19);
    for (std::size_t from = 0; from < kStates; ++from) {
      const Transition t = transition(static_cast<State>(from), r.event);
      pad(text, std::string(to_string(t.next)) + ": " + to_string(t.action), 23);
    }
    while (text.back() == ' ')
      text.pop_back();
    text += '\n';
  }
  text += "\nMeaning and end of the events\n";
  for (const Row& r : kRows) {
    pad(text, r.name, 19);
    text += r.meaning;
    if (r.kind != Kind::course) text.append("; ends ").append(kRecovery[static_cast<std::size_t>(r.kind)]);
    text += '\n';
  }
  return text;
}

}  // namespace lakshya

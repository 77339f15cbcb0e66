#include "app/loop/safety_table.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace lakshya {
namespace {

std::vector<State> states() {
  std::vector<State> all;
  for (std::size_t i = 0; i < kStates; ++i)
    all.push_back(static_cast<State>(i));
  return all;
}

std::vector<Event> events() {
  std::vector<Event> all;
  for (std::size_t i = 0; i < kEvents; ++i)
    all.push_back(static_cast<Event>(i));
  return all;
}

bool is_fault(Event event) {
  return kind_of(event) != Kind::course;
}

bool halts(Event event) {
  return kind_of(event) == Kind::stops || kind_of(event) == Kind::latches;
}

bool drives(Action action) {
  return action == Action::drive || action == Action::drive_slowly;
}

void for_all(const std::function<void(State, Event, Transition)>& check) {
  for (const State state : states()) {
    for (const Event event : events()) {
      SCOPED_TRACE(std::string(to_string(state)) + ", " + to_string(event));
      check(state, event, transition(state, event));
    }
  }
}

TEST(SafetyTable, NoFaultMakesThingsBetter) {
  for_all([](State state, Event event, Transition t) {
    if (!is_fault(event)) return;
    if (!may_drive(state)) {
      EXPECT_FALSE(may_drive(t.next));
    }
    if (state == State::degraded) {
      EXPECT_NE(t.next, State::run);
    }
    if (state == State::stop) {
      EXPECT_TRUE(t.next == State::stop || t.next == State::fault);
    }
  });
}

TEST(SafetyTable, WhatIsLatchedIsLeftByAResetOrTheEndOnly) {
  for_all([](State state, Event event, Transition t) {
    if (state != State::fault || event == Event::reset || event == Event::terminate) return;
    EXPECT_EQ(t.next, State::fault);
    EXPECT_EQ(t.action, Action::hold_zero);
  });
  EXPECT_EQ(transition(State::fault, Event::reset).next, State::init);
}

TEST(SafetyTable, AResetIsForFaultsOnly) {
  for (const State state : states()) {
    if (state != State::fault) {
      EXPECT_EQ(transition(state, Event::reset).next, state) << to_string(state);
    }
  }
}

TEST(SafetyTable, TheEndIsNeverLeftAndAlwaysReached) {
  for (const Event event : events()) {
    EXPECT_EQ(transition(State::end, event).next, State::end) << to_string(event);
    EXPECT_EQ(transition(State::end, event).action, Action::zero_and_end) << to_string(event);
  }
  for (const State state : states())
    EXPECT_EQ(transition(state, Event::terminate).next, State::end) << to_string(state);
  for_all([](State state, Event event, Transition t) {
    if (t.next == State::end) {
      EXPECT_TRUE(event == Event::terminate || state == State::end);
    }
  });
}

TEST(SafetyTable, WhatStopsGivesZeroInTheSameTurn) {
  for (const State state : {State::ready, State::run, State::degraded}) {
    for (const Event event : events()) {
      if (!halts(event)) continue;
      const Transition t = transition(state, event);
      EXPECT_EQ(t.next, kind_of(event) == Kind::latches ? State::fault : State::stop) << to_string(event);
      EXPECT_EQ(t.action, Action::zero_now) << to_string(event);
    }
  }
}

TEST(SafetyTable, WhatLatchesDoesSoFromEveryState) {
  for (const State state : states()) {
    for (const Event event : events()) {
      if (kind_of(event) == Kind::latches && state != State::end) {
        EXPECT_EQ(transition(state, event).next, State::fault) << to_string(state) << to_string(event);
      }
    }
  }
}

TEST(SafetyTable, WheelsTurnInTwoStatesOnly) {
  for_all([](State /*state*/, Event /*event*/, Transition t) {
    EXPECT_EQ(drives(t.action), may_drive(t.next));
    EXPECT_EQ(t.action == Action::drive, t.next == State::run);
  });
}

TEST(SafetyTable, EveryDrivingStateBeginsWithReady) {
  for_all([](State state, Event event, Transition t) {
    if (!may_drive(t.next) || may_drive(state)) return;
    EXPECT_EQ(state, State::ready);
    EXPECT_EQ(event, Event::go);
    EXPECT_EQ(t.next, State::run);
  });
}

TEST(SafetyTable, TheCourseOfAnUndisturbedRun) {
  EXPECT_EQ(transition(State::init, Event::all_well).next, State::ready);
  EXPECT_EQ(transition(State::init, Event::go).next, State::init);
  EXPECT_EQ(transition(State::ready, Event::go).next, State::run);
  EXPECT_EQ(transition(State::run, Event::arrived).next, State::ready);
  EXPECT_EQ(transition(State::degraded, Event::arrived).next, State::ready);
  EXPECT_EQ(transition(State::stop, Event::go).next, State::stop);
  EXPECT_EQ(transition(State::stop, Event::all_well).next, State::ready);
  EXPECT_EQ(transition(State::run, Event::camera_damaged).next, State::degraded);
  EXPECT_EQ(transition(State::degraded, Event::all_well).next, State::run);
}

// By hand from the requirements, not from the table.
TEST(SafetyTable, EveryEventIsOfItsKind) {
  const std::set<Event> course{Event::all_well, Event::go, Event::arrived, Event::reset, Event::terminate};
  const std::set<Event> slows{Event::camera_damaged, Event::recording_lost, Event::watchdog_failed};
  const std::set<Event> latches{Event::emergency_stop, Event::tipping, Event::recording_failed,
                                Event::fault_before};
  for (const Event event : events()) {
    const Kind kind = course.contains(event)    ? Kind::course
                      : slows.contains(event)   ? Kind::slows
                      : latches.contains(event) ? Kind::latches
                                                : Kind::stops;
    EXPECT_EQ(kind_of(event), kind) << to_string(event);
  }
}

TEST(SafetyTable, NamesAreTheirOwn) {
  std::set<std::string> names;
  std::set<std::string> meanings;
  for (const State state : states()) {
    names.insert(to_string(state));
    meanings.insert(meaning(state));
  }
  for (const Event event : events()) {
    names.insert(to_string(event));
    meanings.insert(meaning(event));
  }
  EXPECT_EQ(names.size(), kStates + kEvents);
  EXPECT_EQ(meanings.size(), kStates + kEvents);
  EXPECT_FALSE(names.contains(""));
  EXPECT_FALSE(meanings.contains(""));
  std::set<std::string> actions;
  for (const Action action :
       {Action::hold_zero, Action::zero_now, Action::drive, Action::drive_slowly, Action::zero_and_end})
    actions.insert(to_string(action));
  EXPECT_EQ(actions.size(), 5U);
  EXPECT_STREQ(to_string(State::degraded), "DEGRADED");
  EXPECT_STREQ(to_string(Event::recording_failed), "recording_failed");
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

TEST(StatesText, SaysOfEveryEventWhatFollowsFromEveryState) {
  const std::vector<std::string> lines = lines_of(states_text());
  for (const Event event : events()) {
    const std::string name = to_string(event);
    std::vector<std::string> own;
    for (const std::string& line : lines) {
      if (line.starts_with(name + " ")) own.push_back(line);
    }
    ASSERT_EQ(own.size(), 2U) << name;
    std::string cells = own[0].substr(name.size());
    for (const State state : states()) {
      const Transition t = transition(state, event);
      const std::string cell = std::string(to_string(t.next)) + ": " + to_string(t.action);
      const std::size_t at = cells.find_first_not_of(' ');
      ASSERT_NE(at, std::string::npos) << name;
      EXPECT_EQ(cells.substr(at, cell.size()), cell) << name;
      cells = cells.substr(at + cell.size());
    }
    EXPECT_TRUE(cells.empty()) << name;
    EXPECT_NE(own[1].find(meaning(event)), std::string::npos) << name;
    EXPECT_EQ(own[1].find("; ends ") != std::string::npos, is_fault(event)) << name;
    EXPECT_EQ(own[1].ends_with("by a reset"), kind_of(event) == Kind::latches) << name;
  }
}

TEST(StatesText, HasAColumnAndAMeaningForEveryState) {
  const std::vector<std::string> lines = lines_of(states_text());
  std::vector<std::string> head;
  for (const std::string& line : lines) {
    if (line.starts_with("event ")) head.push_back(line);
    EXPECT_FALSE(line.ends_with(' ') && !line.starts_with("event ")) << line;
  }
  ASSERT_EQ(head.size(), 1U);
  std::istringstream columns(head[0]);
  std::string column;
  columns >> column;
  for (const State state : states()) {
    columns >> column;
    EXPECT_EQ(column, to_string(state));
    const std::string begin = std::string("  ") + to_string(state) + " ";
    int found = 0;
    for (const std::string& line : lines) {
      if (line.starts_with(begin) && line.ends_with(meaning(state))) ++found;
    }
    EXPECT_EQ(found, 1) << to_string(state);
  }
}

TEST(EventSet, HoldsEveryEventByItself) {
  for (const Event event : events()) {
    EventSet set;
    EXPECT_TRUE(set.empty());
    set.set(event);
    EXPECT_FALSE(set.empty());
    for (const Event other : events())
      EXPECT_EQ(set.has(other), other == event);
    for (const Kind kind : {Kind::course, Kind::slows, Kind::stops, Kind::latches})
      EXPECT_EQ(set.any(kind), kind == kind_of(event)) << to_string(event);
    set.set(event);  // twice is once
    set.set(event, false);
    EXPECT_TRUE(set.empty());
    set.set(event, false);
    EXPECT_TRUE(set.empty());
  }
}

}  // namespace
}  // namespace lakshya

#include "app/loop/safety_machine.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace lakshya {
namespace {

constexpr Nanoseconds kTurn = 20 * kMillisecond;
constexpr Nanoseconds kRecover = 500 * kMillisecond;
constexpr int kRecoverTurns = 25;

EventSet set_of(std::initializer_list<Event> events) {
  EventSet set;
  for (const Event event : events)
    set.set(event);
  return set;
}

// A machine that is stepped at the control loop's rate and remembers what it noted.
class Walk {
 public:
  Action step(std::initializer_list<Event> faults = {}) {
    now_ += kTurn;
    const Action action =
        machine_.step(now_, {.faults = set_of(faults), .has_goal = goal, .reset = reset, .terminate = terminate});
    reset = false;
    for (const StateNote& note : machine_.notes()) {
      EXPECT_EQ(note.time, now_);
      log += std::string(to_string(note.from)) + " " + to_string(note.event) + " " + to_string(note.to) + "\n";
    }
    return action;
  }
  // Steps until the state is another one, at most `most` times; how many it took.
  int steps_to(State state, int most = 100) {
    for (int i = 0; i < most; ++i) {
      (void)step();
      if (machine_.state() == state) return i + 1;
    }
    return -1;
  }
  void to_run() {
    ASSERT_EQ(steps_to(State::run), kRecoverTurns + 1);
    log.clear();
  }
  State state() const { return machine_.state(); }
  Event reason() const { return machine_.reason(); }

  bool goal = true;
  bool reset = false;
  bool terminate = false;
  std::string log;

 private:
  SafetyMachine machine_{kRecover};
  Nanoseconds now_ = 0;
};

TEST(SafetyMachine, InitWaitsUntilAllHasBeenWellForAWhile) {
  Walk walk;
  EXPECT_EQ(walk.state(), State::init);
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(walk.step({Event::camera_silent}), Action::hold_zero);
  EXPECT_EQ(walk.state(), State::init);
  for (int i = 0; i < kRecoverTurns; ++i) {
    EXPECT_EQ(walk.step(), Action::hold_zero);
    EXPECT_EQ(walk.state(), State::init);
  }
  EXPECT_EQ(walk.step(), Action::drive);
  EXPECT_EQ(walk.state(), State::run);
  EXPECT_EQ(walk.log, "INIT all_well READY\nREADY go RUN\n");  // what was missing before is no news
}

TEST(SafetyMachine, AFaultInInitBeginsTheWaitAnew) {
  Walk walk;
  for (int i = 0; i < kRecoverTurns; ++i)
    (void)walk.step();
  (void)walk.step({Event::plan_old});
  EXPECT_EQ(walk.state(), State::init);
  EXPECT_EQ(walk.steps_to(State::run), kRecoverTurns + 1);
}

TEST(SafetyMachine, ReadyWaitsForAGoalAndComesBackAtTheEndOfTheWay) {
  Walk walk;
  walk.goal = false;
  EXPECT_EQ(walk.steps_to(State::ready), kRecoverTurns + 1);
  EXPECT_EQ(walk.step(), Action::hold_zero);
  walk.goal = true;
  EXPECT_EQ(walk.step(), Action::drive);
  EXPECT_EQ(walk.step(), Action::drive);
  walk.goal = false;
  EXPECT_EQ(walk.step(), Action::zero_now);
  EXPECT_EQ(walk.state(), State::ready);
  EXPECT_EQ(walk.step(), Action::hold_zero);
  EXPECT_EQ(walk.log, "INIT all_well READY\nREADY go RUN\nRUN arrived READY\n");
}

TEST(SafetyMachine, StopEndsByItselfWhenAllHasBeenWellAndNotBefore) {
  Walk walk;
  walk.to_run();
  EXPECT_EQ(walk.step({Event::camera_silent}), Action::zero_now);
  EXPECT_EQ(walk.state(), State::stop);
  EXPECT_EQ(walk.reason(), Event::camera_silent);
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(walk.step({Event::camera_silent}), Action::hold_zero);
  for (int i = 0; i < kRecoverTurns; ++i)
    EXPECT_EQ(walk.step(), Action::hold_zero);
  EXPECT_EQ(walk.state(), State::stop);
  EXPECT_EQ(walk.step(), Action::drive);
  EXPECT_EQ(walk.reason(), Event::all_well);
  EXPECT_EQ(walk.log, "RUN camera_silent STOP\nSTOP all_well READY\nREADY go RUN\n");
}

TEST(SafetyMachine, AFlappingFaultHoldsTheVehicle) {
  Walk walk;
  walk.to_run();
  for (int i = 0; i < 20; ++i) {
    (void)walk.step({i % 2 == 0 ? Event::camera_dark : Event::drive_garbled});
    for (int turn = 0; turn < kRecoverTurns; ++turn)
      EXPECT_EQ(walk.step(), Action::hold_zero);
    EXPECT_EQ(walk.state(), State::stop);
  }
  EXPECT_EQ(walk.step(), Action::drive);
}

TEST(SafetyMachine, AFaultThatFollowsAnotherHoldsItToo) {
  Walk walk;
  walk.to_run();
  (void)walk.step({Event::camera_silent});
  (void)walk.step({Event::camera_silent, Event::plan_old});
  for (int i = 0; i < 2 * kRecoverTurns; ++i)
    EXPECT_EQ(walk.step({Event::plan_old}), Action::hold_zero);
  EXPECT_EQ(walk.steps_to(State::run), kRecoverTurns + 1);
}

TEST(SafetyMachine, FaultNeedsAReset) {
  Walk walk;
  walk.to_run();
  EXPECT_EQ(walk.step({Event::emergency_stop}), Action::zero_now);
  EXPECT_EQ(walk.state(), State::fault);
  for (int i = 0; i < 10 * kRecoverTurns; ++i)
    EXPECT_EQ(walk.step(), Action::hold_zero);
  EXPECT_EQ(walk.state(), State::fault);
  EXPECT_EQ(walk.reason(), Event::emergency_stop);  // although it is no longer pressed
  walk.reset = true;
  (void)walk.step();
  EXPECT_NE(walk.state(), State::fault);
  EXPECT_NE(walk.log.find("FAULT reset INIT\n"), std::string::npos);
}

TEST(SafetyMachine, AResetWithTheFaultStillThereLatchesAgainAtOnce) {
  Walk walk;
  walk.to_run();
  (void)walk.step({Event::tipping});
  walk.log.clear();
  walk.reset = true;
  EXPECT_EQ(walk.step({Event::tipping}), Action::zero_now);
  EXPECT_EQ(walk.state(), State::fault);
  EXPECT_EQ(walk.reason(), Event::tipping);
  EXPECT_EQ(walk.log, "FAULT reset INIT\nINIT tipping FAULT\n");
  for (int i = 0; i < 2 * kRecoverTurns; ++i)
    (void)walk.step();
  EXPECT_EQ(walk.state(), State::fault);  // the reset was used up
}

TEST(SafetyMachine, AfterAResetInitWaitsAgain) {
  Walk walk;
  walk.to_run();
  (void)walk.step({Event::emergency_stop});
  for (int i = 0; i < 10 * kRecoverTurns; ++i)
    (void)walk.step();
  walk.reset = true;
  EXPECT_EQ(walk.step(), Action::zero_now);
  EXPECT_EQ(walk.state(), State::init);
  EXPECT_EQ(walk.steps_to(State::run), kRecoverTurns);
}

TEST(SafetyMachine, DegradedDrivesSlowlyAndComesBack) {
  Walk walk;
  walk.to_run();
  EXPECT_EQ(walk.step({Event::camera_damaged}), Action::drive_slowly);
  EXPECT_EQ(walk.state(), State::degraded);
  EXPECT_EQ(walk.reason(), Event::camera_damaged);
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(walk.step({Event::camera_damaged}), Action::drive_slowly);
  for (int i = 0; i < kRecoverTurns; ++i)
    EXPECT_EQ(walk.step(), Action::drive_slowly);
  EXPECT_EQ(walk.step(), Action::drive);
  EXPECT_EQ(walk.reason(), Event::all_well);
  EXPECT_EQ(walk.log, "RUN camera_damaged DEGRADED\nDEGRADED all_well RUN\n");
}

TEST(SafetyMachine, AStopThatEndsWhileSomethingStillSlowsDrivesSlowlyAtOnce) {
  Walk walk;
  walk.to_run();
  (void)walk.step({Event::recording_lost, Event::compass_silent});
  EXPECT_EQ(walk.state(), State::stop);
  for (int i = 0; i < kRecoverTurns; ++i)
    EXPECT_EQ(walk.step({Event::recording_lost}), Action::hold_zero);
  EXPECT_EQ(walk.step({Event::recording_lost}), Action::drive_slowly);
  EXPECT_EQ(walk.state(), State::degraded);
  EXPECT_EQ(walk.reason(), Event::recording_lost);
}

TEST(SafetyMachine, TerminateEndsEveryState) {
  const std::vector<std::pair<State, std::vector<Event>>> cases{
      {State::run, {}},
      {State::degraded, {Event::camera_damaged}},
      {State::stop, {Event::camera_gone}},
      {State::fault, {Event::emergency_stop}},
  };
  for (const auto& [state, faults] : cases) {
    Walk walk;
    walk.to_run();
    for (const Event fault : faults)
      (void)walk.step({fault});
    ASSERT_EQ(walk.state(), state);
    walk.terminate = true;
    EXPECT_EQ(walk.step({Event::plan_old, Event::tipping}), Action::zero_and_end) << to_string(state);
    EXPECT_EQ(walk.state(), State::end);
    EXPECT_EQ(walk.reason(), Event::terminate);
    walk.reset = true;
    EXPECT_EQ(walk.step(), Action::zero_and_end);
    EXPECT_EQ(walk.state(), State::end);
  }
  Walk init;
  init.terminate = true;
  EXPECT_EQ(init.step(), Action::zero_and_end);
  Walk ready;
  ready.goal = false;
  EXPECT_GT(ready.steps_to(State::ready), 0);
  ready.terminate = true;
  EXPECT_EQ(ready.step(), Action::zero_and_end);
}

TEST(SafetyMachine, TheEndStaysTheEndWhenNobodyAsksForItAnyMore) {
  Walk walk;
  walk.to_run();
  walk.terminate = true;
  (void)walk.step();
  walk.terminate = false;
  EXPECT_EQ(walk.step(), Action::zero_and_end);
  EXPECT_EQ(walk.step({Event::camera_dark}), Action::zero_and_end);
  EXPECT_EQ(walk.reason(), Event::terminate);
}

// Whatever comes when, within all that the table allows.
TEST(SafetyMachine, OnARandomWalkNothingDrivesThatMustNot) {
  SafetyMachine machine(kRecover);
  std::mt19937 random(11);
  const auto chance = [&](unsigned per_mille) { return random() % 1000 < per_mille; };
  EventSet faults;
  Nanoseconds now = 0;
  Nanoseconds halted = 0;  // the last time that something stopped
  std::array<int, kStates> visits{};
  bool goal = true;
  bool latched = false;
  for (int i = 0; i < 100'000; ++i) {
    now += kTurn + static_cast<Nanoseconds>(random() % 1000);
    for (std::size_t e = 0; e < kEvents; ++e) {
      const auto event = static_cast<Event>(e);
      const bool on = faults.has(event);
      if (kind_of(event) != Kind::course && chance(on ? 100 : 1)) faults.set(event, !on);
    }
    if (chance(10)) goal = !goal;
    const bool reset = chance(20);
    const Action action =
        machine.step(now, {.faults = faults, .has_goal = goal, .reset = reset, .terminate = false});
    const bool halts = faults.any(Kind::stops) || faults.any(Kind::latches);
    const bool drives = action == Action::drive || action == Action::drive_slowly;
    if (halts) halted = now;
    latched = faults.any(Kind::latches) || (latched && !reset);
    ASSERT_FALSE(halts && drives) << i;
    ASSERT_FALSE(drives && now - halted < kRecover) << i;
    ASSERT_FALSE(drives && !goal) << i;
    ASSERT_EQ(machine.state() == State::fault, latched) << i;
    ASSERT_EQ(drives, may_drive(machine.state())) << i;
    ASSERT_FALSE(action == Action::drive && !faults.empty()) << i;
    for (const StateNote& note : machine.notes())
      ASSERT_EQ(note.time, now);
    ++visits[static_cast<std::size_t>(machine.state())];
  }
  for (const State state : {State::init, State::ready, State::run, State::degraded, State::stop, State::fault})
    EXPECT_GT(visits[static_cast<std::size_t>(state)], 100) << to_string(state);
}

}  // namespace
}  // namespace lakshya

// What the safety machine tells: which fault it was, once, and why the vehicle stands.
#include <gtest/gtest.h>

#include <string>

#include "app/loop/safety_machine.h"

namespace lakshya {
namespace {

constexpr Nanoseconds kTurn = 20 * kMillisecond;

class Notes : public testing::Test {
 protected:
  // What one step notes.
  std::string step(std::initializer_list<Event> faults = {}, bool reset = false) {
    EventSet set;
    for (const Event event : faults)
      set.set(event);
    now_ += kTurn;
    action_ = machine_.step(now_, {.faults = set, .has_goal = true, .reset = reset, .terminate = false});
    std::string text;
    for (const StateNote& note : machine_.notes())
      text += std::string(to_string(note.from)) + " " + to_string(note.event) + " " + to_string(note.to) + "; ";
    return text;
  }
  void to_run() {
    for (int i = 0; i < 26; ++i)
      (void)step();
    ASSERT_EQ(machine_.state(), State::run);
  }

  SafetyMachine machine_{500 * kMillisecond};
  Nanoseconds now_ = 0;
  Action action_ = Action::hold_zero;
};

TEST_F(Notes, AFaultIsNotedOnceWhileItLasts) {
  to_run();
  EXPECT_EQ(step({Event::camera_silent}), "RUN camera_silent STOP; ");
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(step({Event::camera_silent}), "");
  EXPECT_EQ(step({Event::camera_silent, Event::plan_old}), "STOP plan_old STOP; ");
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(step({Event::camera_silent, Event::plan_old}), "");
}

TEST_F(Notes, AFaultThatComesAgainIsNotedAgain) {
  to_run();
  EXPECT_EQ(step({Event::drive_garbled}), "RUN drive_garbled STOP; ");
  EXPECT_EQ(step(), "");
  EXPECT_EQ(step({Event::drive_garbled}), "STOP drive_garbled STOP; ");
  EXPECT_EQ(step({Event::drive_garbled}), "");
}

TEST_F(Notes, SeveralFaultsInOneStepEndInTheMostSevereState) {
  to_run();
  EXPECT_EQ(step({Event::camera_damaged, Event::camera_silent, Event::tipping}),
            "RUN tipping FAULT; FAULT camera_silent FAULT; FAULT camera_damaged FAULT; ");
  EXPECT_EQ(action_, Action::zero_now);
  EXPECT_EQ(machine_.state(), State::fault);
  EXPECT_EQ(machine_.reason(), Event::tipping);
}

TEST_F(Notes, AStopAndASlowingInOneStepAreAStop) {
  to_run();
  EXPECT_EQ(step({Event::camera_damaged, Event::camera_silent, Event::plan_old}),
            "RUN camera_silent STOP; STOP plan_old STOP; STOP camera_damaged STOP; ");
  EXPECT_EQ(action_, Action::zero_now);
  EXPECT_EQ(machine_.reason(), Event::camera_silent);
}

TEST_F(Notes, EveryFaultAtOnceIsNotedAndIsAFault) {
  to_run();
  EventSet all;
  std::size_t faults = 0;
  for (std::size_t i = 0; i < kEvents; ++i) {
    const auto event = static_cast<Event>(i);
    if (kind_of(event) == Kind::course) continue;
    all.set(event);
    ++faults;
  }
  EXPECT_EQ(machine_.step(now_ + kTurn, {.faults = all, .has_goal = true, .reset = true, .terminate = false}),
            Action::zero_now);
  EXPECT_EQ(machine_.state(), State::fault);
  EXPECT_EQ(machine_.notes().size(), faults);
  EXPECT_EQ(machine_.step(now_ + 2 * kTurn, {.faults = all, .has_goal = true, .reset = true, .terminate = true}),
            Action::zero_and_end);
  EXPECT_EQ(machine_.state(), State::end);
}

TEST_F(Notes, ASmallerFaultDoesNotHideWhyTheVehicleStands) {
  to_run();
  (void)step({Event::emergency_stop});
  EXPECT_EQ(step({Event::emergency_stop, Event::camera_silent}), "FAULT camera_silent FAULT; ");
  EXPECT_EQ(machine_.reason(), Event::emergency_stop);
  EXPECT_EQ(step({Event::camera_damaged}), "FAULT camera_damaged FAULT; ");
  EXPECT_EQ(machine_.reason(), Event::emergency_stop);
}

TEST_F(Notes, WhereTheReasonHasGoneAnotherThatLastsIsTheReason) {
  to_run();
  (void)step({Event::camera_silent});
  (void)step({Event::camera_silent, Event::plan_old, Event::camera_damaged});
  EXPECT_EQ(machine_.reason(), Event::camera_silent);
  (void)step({Event::plan_old, Event::camera_damaged});
  EXPECT_EQ(machine_.reason(), Event::plan_old);
  (void)step();
  EXPECT_EQ(machine_.state(), State::stop);
  EXPECT_EQ(machine_.reason(), Event::plan_old);  // it stands because of what was
}

TEST_F(Notes, WhereNothingIsWrongThereIsNoReason) {
  // Until there is somewhere to go.
  EventSet damaged;
  damaged.set(Event::camera_damaged);
  for (int i = 0; i < 30; ++i)
    (void)machine_.step(now_ += kTurn, {});
  ASSERT_EQ(machine_.state(), State::ready);
  EXPECT_EQ(machine_.reason(), Event::all_well);
  (void)machine_.step(now_ += kTurn, {.faults = damaged});
  EXPECT_EQ(machine_.reason(), Event::camera_damaged);
  (void)machine_.step(now_ += kTurn, {});
  EXPECT_EQ(machine_.reason(), Event::all_well);
}

TEST_F(Notes, InInitTheReasonIsWhatIsStillMissing) {
  EXPECT_EQ(step({Event::camera_silent, Event::compass_silent, Event::plan_old}), "");
  EXPECT_EQ(machine_.reason(), Event::camera_silent);
  (void)step({Event::compass_silent, Event::plan_old});
  EXPECT_EQ(machine_.reason(), Event::compass_silent);
  (void)step({Event::plan_old});
  EXPECT_EQ(machine_.reason(), Event::plan_old);
}

}  // namespace
}  // namespace lakshya

// Every fault of the table of states, injected into the running loop: how long until both drives are told to stand, and how it
// ends. Prints the table that docs/safety.md shows (`./dev safety`).
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/support/emulated.h"
#include "tests/support/loop_rig.h"

namespace lakshya {
namespace {

using test::LoopRig;
using test::RigCamera;

constexpr double kLimitMs = 200;     // the promise
constexpr double kOrphanedMs = 300;  // of drives that nobody reaches: their own program's

class LoopFaults : public ::testing::Test {
 protected:
  void SetUp() override {
    if (is_emulated()) GTEST_SKIP() << "an emulated processor keeps no limit of time";
  }
};

struct Fault {
  const char* what;
  Event event;
  std::function<void(LoopRig&)> begin;
  std::function<void(LoopRig&)> end;
  double limit_ms = kLimitMs;
};

std::function<void(LoopRig&)> camera(RigCamera::Fault fault) {
  return [fault](LoopRig& rig) { rig.camera->fault = fault; };
}

// Turns a knob of an emulated device while its line is held.
template <class Turn>
std::function<void(LoopRig&)> drives(Turn turn) {
  return [turn](LoopRig& rig) {
    const auto lock = rig.drive_terminal.locked();
    turn(rig.drives);
  };
}
template <class Turn>
std::function<void(LoopRig&)> compass(Turn turn) {
  return [turn](LoopRig& rig) {
    const auto lock = rig.compass_terminal.locked();
    turn(rig.compass);
  };
}

const char* end_of(Event event) {
  return kind_of(event) == Kind::latches ? "reset" : "by itself";
}

void tell(const char* what, Event event, double ms, double limit_ms, double back_s) {
  std::printf("| %s | `%s` | %.0f | %.0f | %s | %.1f |\n", what, to_string(event), ms, limit_ms, end_of(event),
              back_s);
}

// Begins with the pair that it hangs on, not with the one before.
void stall_perception(LoopRig& rig) {
  test::rig_perception_stalls = true;
  (void)rig.milliseconds_until([] { return test::rig_perception_is_stalled.load(); }, 1000);
}

std::vector<Fault> faults() {
  using enum RigCamera::Fault;
  return {
      {"camera gives no more pairs", Event::camera_silent, camera(silent), camera(none)},
      {"camera is unplugged", Event::camera_gone, camera(gone), camera(none)},
      {"camera gives the same pair again and again", Event::camera_frozen, camera(frozen), camera(none)},
      {"one eye gives the same image again and again", Event::camera_frozen, camera(half_frozen), camera(none)},
      {"lens is covered", Event::camera_dark, camera(dark), camera(none)},
      {"one eye looks into the sun", Event::camera_bright, camera(bright), camera(none)},
      {"eyes are 30 ms apart", Event::camera_skewed, camera(skewed), camera(none)},
      {"compass falls silent", Event::compass_silent, compass([](auto& c) { c.silent = true; }),
       compass([](auto& c) { c.silent = false; })},
      {"compass jumps by 90 degrees", Event::compass_jumped, compass([](auto& c) { c.heading_deg += 90; }),
       compass([](auto& c) { c.heading_deg -= 90; })},
      {"drives answer busy", Event::drive_refused, drives([](auto& d) { d.nak_every = 1; }),
       drives([](auto& d) { d.nak_every = 0; }), kOrphanedMs},
      {"drives obey and do not answer", Event::drive_silent, drives([](auto& d) { d.silent_every = 1; }),
       drives([](auto& d) { d.silent_every = 0; })},
      {"answers are damaged", Event::drive_garbled, drives([](auto& d) { d.damaged = true; }),
       drives([](auto& d) { d.damaged = false; })},
      {"answers come from a third address", Event::drive_silent, drives([](auto& d) { d.answers_as = 99; }),
       drives([](auto& d) { d.answers_as = 0; })},
      {"one drive loses power", Event::drive_silent, drives([](auto& d) { d.silent_address = 17; }),
       drives([](auto& d) { d.silent_address = 0; }), kOrphanedMs},
      {"perception hangs", Event::perception_late, stall_perception,
       [](LoopRig&) { test::rig_perception_stalls = false; }},
      {"perception fails", Event::perception_failed, [](LoopRig&) { test::rig_perception_fails = true; },
       [](LoopRig&) { test::rig_perception_fails = false; }},
      {"control loop is held up for 120 ms", Event::control_late, [](LoopRig& r) { r.estop->stall_ms = 120; },
       [](LoopRig&) {}},
      {"control loop hangs for 2 s", Event::control_late, [](LoopRig& r) { r.estop->stall_ms = 2000; },
       [](LoopRig&) { std::this_thread::sleep_for(std::chrono::milliseconds(2000)); }},
      {"emergency stop is pressed", Event::emergency_stop, [](LoopRig& r) { r.estop->pressed = true; },
       [](LoopRig& r) { r.estop->pressed = false; }},
      {"emergency stop cannot be read", Event::emergency_stop, [](LoopRig& r) { r.estop->unreadable = true; },
       [](LoopRig& r) { r.estop->unreadable = false; }},
      {"vehicle rolls to 40 degrees", Event::tipping, compass([](auto& c) { c.roll_deg = 40; }),
       compass([](auto& c) { c.roll_deg = 0; })},
      {"recording cannot be written", Event::recording_failed,
       [](LoopRig& r) { r.machinery->exchange().recording_failed = true; },
       [](LoopRig& r) { r.machinery->exchange().recording_failed = false; }},
  };
}

bool has_begun(const LoopRig& rig, Event event) {
  return std::ranges::any_of(rig.notes, [&](const StateNote& n) { return n.event == event; });
}

// True: in time. A second time must be.
bool inject(LoopRig& rig, const Fault& fault, bool is_second) {
  SCOPED_TRACE(fault.what);
  EXPECT_TRUE(rig.drives_again()) << to_string(rig.state) << " " << to_string(rig.reason);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const State expected = kind_of(fault.event) == Kind::latches ? State::fault : State::stop;
  fault.begin(rig);
  const double ms = rig.milliseconds_until([&] { return rig.stands(); }, 2000);
  EXPECT_GE(ms, 0) << "the wheels were never told to stand";
  if (is_second) {
    EXPECT_LE(ms, fault.limit_ms);
  }
  if (fault.event != Event::control_late) {
    EXPECT_GE(rig.milliseconds_until([&] { return rig.state == expected; }, 500), 0) << to_string(rig.state);
    std::this_thread::sleep_for(std::chrono::milliseconds(150));  // it lasts: the wheels stay where they are
    EXPECT_TRUE(rig.stands());
    EXPECT_EQ(rig.state, expected);
  }
  fault.end(rig);
  if (kind_of(fault.event) == Kind::latches) {
    std::this_thread::sleep_for(std::chrono::milliseconds(450));  // longer than safety.recover_s
    EXPECT_EQ(rig.state, State::fault) << "is not latched";
    EXPECT_TRUE(rig.stands());
    rig.machinery->exchange().reset = true;
  }
  const double back_ms = rig.milliseconds_until([&] { return rig.state == State::run && !rig.stands(); }, 5000);
  EXPECT_GE(back_ms, 0) << "did not drive again: " << to_string(rig.state) << " " << to_string(rig.reason);
  tell(fault.what, fault.event, ms, fault.limit_ms, back_ms / 1000);
  return ms <= fault.limit_ms;
}

TEST_F(LoopFaults, EachStopsTheWheelsInTimeAndEndsAsTheTableSays) {
  LoopRig rig;
  rig.start();
  std::printf("| fault | event | wheels told zero after ms | promised ms | ends | driving again after s |\n");
  std::printf("|---|---|---|---|---|---|\n");
  const std::vector<Fault> all = faults();
  for (const Fault& fault : all) {
    // A machine that others use, too, may stand still for a moment: what was late is measured once more.
    if (!inject(rig, fault, false)) (void)inject(rig, fault, true);
    if (HasFailure()) break;
  }
  rig.end();
  const ControlCounts& counts = rig.machinery->control().counts();
  const double late_ms = static_cast<double>(counts.lateness.quantile(990)) / 1e6;
  std::printf("%llu control turns, lateness p99 %.2f ms, longest %.2f ms\n",
              static_cast<unsigned long long>(counts.turns), late_ms,
              static_cast<double>(counts.lateness.max()) / 1e6);
  EXPECT_LT(late_ms, 5);
  for (const Fault& fault : all) {
    if (HasFailure()) break;
    EXPECT_TRUE(has_begun(rig, fault.event)) << to_string(fault.event);
  }
  EXPECT_TRUE(rig.stands());
}

// What cannot be plugged in again, or needs another setting.
void inject_once(LoopRig& rig, const char* what, Event event, double limit_ms, const std::function<void()>& begin) {
  rig.start();
  ASSERT_TRUE(rig.drives_again());
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  begin();
  const double ms = rig.milliseconds_until([&] { return rig.stands(); }, 2000);
  EXPECT_GE(ms, 0);
  EXPECT_LE(ms, limit_ms);
  rig.end();
  EXPECT_TRUE(has_begun(rig, event));
  EXPECT_TRUE(rig.stands());
  std::printf("| %s | `%s` | %.0f | %.0f | %s | |\n", what, to_string(event), ms, limit_ms, end_of(event));
}

TEST_F(LoopFaults, TheCompassIsUnplugged) {
  LoopRig rig;
  inject_once(rig, "compass is unplugged", Event::compass_gone, kLimitMs, [&] { rig.compass_terminal.unplug(); });
}

TEST_F(LoopFaults, TheDrivesAreUnplugged) {
  LoopRig rig;
  inject_once(rig, "drives are unplugged", Event::drive_gone, kOrphanedMs, [&] { rig.drive_terminal.unplug(); });
}

TEST_F(LoopFaults, APlanGetsTooOld) {
  LoopRig rig([](VehicleConfig& c) {
    c.safety.perception_s = 10;
    c.safety.plan_age_s = 0.15;
  });
  inject_once(rig, "no new plan comes", Event::plan_old, kLimitMs, [] { test::rig_perception_stalls = true; });
}

TEST_F(LoopFaults, TheProgramIsAskedToEnd) {
  LoopRig rig;
  inject_once(rig, "program is asked to end", Event::terminate, kLimitMs,
              [&] { rig.machinery->exchange().terminate = true; });
}

class BrokenWatchdog final : public Watchdog {
 public:
  Status open() override { return Status::ok; }
  void close() override {}
  std::span<const Counter> counters() const override { return {}; }
  Status kick() override { return broken ? Status::disconnected : Status::ok; }
  double timeout_s() const override { return 1; }
  std::atomic<bool> broken = false;
};

// Driving goes on, slowly, until it has been whole for a while.
void degrade(LoopRig& rig, const std::function<void()>& begin, const std::function<void()>& end) {
  rig.start();
  ASSERT_TRUE(rig.drives_again());
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  begin();
  EXPECT_GE(rig.milliseconds_until([&] { return rig.state == State::degraded; }, 1000), 0) << to_string(rig.state);
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  EXPECT_EQ(rig.state, State::degraded);
  {
    const auto lock = rig.drive_terminal.locked();
    const double metres_per_turn = 2 * 3.14159265 * 0.1 / 10;
    EXPECT_GT(rig.drives.state(0, emulator::monotonic_ns()).velocity_rpm, 0);
    EXPECT_LT(rig.drives.state(0, emulator::monotonic_ns()).velocity_rpm / 60 * metres_per_turn, 0.36);
  }
  end();
  EXPECT_GE(rig.milliseconds_until([&] { return rig.state == State::run; }, 3000), 0);
  rig.end();
}

TEST_F(LoopFaults, AWatchdogThatCannotBeKickedSlowsDown) {
  BrokenWatchdog watchdog;
  LoopRig rig;
  rig.hooks.watchdogs = {&watchdog};
  degrade(
      rig, [&] { watchdog.broken = true; }, [&] { watchdog.broken = false; });
}

TEST_F(LoopFaults, ALostRecordingSlowsDownWhereItMayBeLost) {
  LoopRig rig([](VehicleConfig& c) { c.safety.recording_failed = "go"; });
  std::atomic<bool>& failed = rig.machinery->exchange().recording_failed;
  degrade(
      rig, [&] { failed = true; }, [&] { failed = false; });
}

TEST_F(LoopFaults, TornPairsSlowDown) {
  LoopRig rig([](VehicleConfig& c) {
    c.safety.camera_silent_s = 5;
    c.safety.plan_age_s = 5;
    c.vehicle.latency_s = 5;
    c.vehicle.stop_margin_m = 0;
    c.vehicle.contact_time_s = 0;
  });
  degrade(
      rig, [&] { rig.camera->fault = RigCamera::Fault::torn; },
      [&] { rig.camera->fault = RigCamera::Fault::none; });
}

}  // namespace
}  // namespace lakshya

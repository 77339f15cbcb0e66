// The driver against emulated drives, on a clock that only moves when somebody waits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include "hal/servo/quicksilver.h"
#include "tests/emulators/quicksilver_drive.h"
#include "tests/support/line_device_port.h"
#include "tests/support/manual_clock.h"
#include "tests/support/quicksilver_wheels.h"

namespace lakshya {
namespace {

using test::left_m;
using test::right_m;
using test::speed_mps;

class QuickSilverEmulatedTest : public testing::Test {
 protected:
  Nanoseconds in_ms(int ms) const { return clock_.now() + ms * kMillisecond; }

  // A period of 60 ms: both calls, each with half of it. Returns how many of the two failed.
  int one_period(const WheelVelocities& wanted) {
    const Nanoseconds end = in_ms(60);
    int failures = 0;
    if (servo_.drive(wanted, in_ms(30)) != Status::ok) ++failures;
    if (servo_.read_travel(in_ms(30), travel_) != Status::ok) ++failures;
    EXPECT_LE(clock_.now(), end);
    clock_.sleep_until(end);
    return failures;
  }

  int drive_for(double seconds, const WheelVelocities& wanted) {
    int failures = 0;
    for (const Nanoseconds end = clock_.now() + static_cast<Nanoseconds>(seconds * kSecond); clock_.now() < end;)
      failures += one_period(wanted);
    return failures;
  }

  emulator::QuickSilverState state(std::size_t index) { return line_.state(index, clock_.now()); }

  void give_power_back() {
    for (std::size_t d = 0; d < line_.drives(); ++d) {
      (void)state(d);
      line_.drive(d).restart();
    }
    line_.has_power = true;
  }

  // The host asks all the time.
  void cut_power_for(double seconds, bool also_the_port) {
    line_.has_power = false;
    port_.unplugged = also_the_port;
    (void)drive_for(seconds, {.left_mps = 0.5, .right_mps = 0.5});
    give_power_back();
    if (!also_the_port) return;
    clock_.advance(kSecond);  // the drives are back before the port is
    port_.unplugged = false;
  }

  void expect_travel_is_true() {
    ASSERT_EQ(servo_.read_travel(in_ms(100), travel_), Status::ok) << servo_.problem();
    const auto left = state(0);
    const auto right = state(1);
    EXPECT_NEAR(travel_.left_m, left_m(left) - left_start_, 0.01 * std::abs(left_m(left) - left_start_) + 0.01);
    EXPECT_NEAR(travel_.right_m, right_m(right) - right_start_,
                0.01 * std::abs(right_m(right) - right_start_) + 0.01);
  }

  ManualClock clock_;
  emulator::QuickSilverLine line_;
  LineDevicePort port_{line_, clock_};
  QuickSilver servo_{test::emulated_quicksilver_settings(), port_, clock_};
  WheelTravel travel_;
  double left_start_ = 0;
  double right_start_ = 0;
};

// 600 s at up to 1 m/s, 133 000 counts a second: the left position crosses the wrap after 75 s, the right one after 200 s.
TEST_F(QuickSilverEmulatedTest, TenMinutesAcrossTheWrap) {
  line_.drive(0).set_position((1LL << 31) - 10'000'000);
  line_.drive(1).set_position(-(1LL << 31) + 10'000'000);
  left_start_ = left_m(state(0));
  right_start_ = right_m(state(1));
  ASSERT_EQ(servo_.open(), Status::ok) << servo_.problem();
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(drive_for(10, {.left_mps = 1, .right_mps = 0.5}), 0) << servo_.problem();
    EXPECT_EQ(drive_for(8, {.left_mps = -0.2, .right_mps = -0.1}), 0) << servo_.problem();
    EXPECT_EQ(drive_for(2, {}), 0) << servo_.problem();
  }
  expect_travel_is_true();
  EXPECT_GT(travel_.left_m, 240);
  EXPECT_GT(travel_.right_m, 120);
  for (const Counter& counter : servo_.counters())
    EXPECT_EQ(counter.value, 0U) << counter.name;
}

// The line times that hal/servo/quicksilver.h states, and 0.5 ms a command that these drives take to begin to answer.
TEST_F(QuickSilverEmulatedTest, TheLineTakesAsLongAsStated) {
  QuickSilverSettings settings = test::emulated_quicksilver_settings();
  settings.max_speed_mps = 3.9;
  QuickSilver servo(settings, port_, clock_);
  ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
  clock_.advance(100 * kMillisecond);
  const auto took_ms = [&](auto&& call) {
    const Nanoseconds begin = clock_.now();
    EXPECT_EQ(call(), Status::ok) << servo.problem();
    return static_cast<double>(clock_.now() - begin) / kMillisecond;
  };
  // -2093796556 units; the right one has no sign, which is a character less.
  EXPECT_NEAR(took_ms([&] { return servo.drive({-3.9, -3.9}, in_ms(50)); }), 16.8 - 0.2 + 4 * 0.5, 0.3);
  EXPECT_NEAR(took_ms([&] { return servo.stop(in_ms(50)); }), 6.5 + 2 * 0.5, 0.2);
  EXPECT_NEAR(took_ms([&] { return servo.read_travel(in_ms(50), travel_); }), 11.1 + 2 * 0.5, 0.2);
}

TEST_F(QuickSilverEmulatedTest, WhenTheHostGoesSilentTheWheelsStand) {
  ASSERT_EQ(servo_.open(), Status::ok) << servo_.problem();
  ASSERT_EQ(drive_for(2, {.left_mps = 0.1, .right_mps = 0.1}), 0);
  EXPECT_NEAR(speed_mps(state(0)), 0.1, 1e-6);
  // 200 ms, a round of the program, and 50 ms to slow down from 0.1 m/s at 2 m/s^2.
  clock_.advance(262 * kMillisecond);
  EXPECT_EQ(speed_mps(state(0)), 0);
  EXPECT_EQ(speed_mps(state(1)), 0);
  EXPECT_TRUE(state(0).tripped && state(1).tripped);
  EXPECT_EQ(drive_for(1, {.left_mps = 0.1, .right_mps = 0.1}), 0) << servo_.problem();
  EXPECT_NEAR(speed_mps(state(0)), 0.1, 1e-6) << "and go on when it is back";
}

TEST_F(QuickSilverEmulatedTest, WithoutResidentProgramsItIsRefused) {
  for (const bool at_power_up : {true, false}) {
    emulator::QuickSilverLine line({16, 17}, {.at_power_up = at_power_up, .zeroes_velocity = false});
    LineDevicePort port(line, clock_);
    QuickSilver servo(test::emulated_quicksilver_settings(), port, clock_);
    EXPECT_EQ(servo.open(), Status::refused);
    EXPECT_NE(std::string(servo.problem()).find("resident program"), std::string::npos) << servo.problem();
  }
}

TEST_F(QuickSilverEmulatedTest, AnUnsupervisedHostThatGoesSilentLeavesThemTurning) {
  QuickSilverSettings settings = test::emulated_quicksilver_settings();
  settings.supervised = false;
  QuickSilver servo(settings, port_, clock_);
  ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
  ASSERT_EQ(servo.drive({.left_mps = 0.3, .right_mps = -0.3}, in_ms(20)), Status::ok) << servo.problem();
  clock_.advance(4 * kSecond);
  EXPECT_NEAR(speed_mps(state(0)), 0.3, 1e-6) << "which is why max_speed_mps() is small";
  ASSERT_EQ(servo.read_travel(in_ms(20), travel_), Status::ok) << servo.problem();
  EXPECT_NEAR(travel_.left_m, 1.2, 0.05);
  EXPECT_NEAR(travel_.right_m, -1.2, 0.05);
  servo.close();
  clock_.advance(kSecond);
  EXPECT_EQ(speed_mps(state(0)), 0);
  EXPECT_EQ(speed_mps(state(1)), 0);
}

// An emergency stop that takes the drives' power: they count from zero when they are back.
TEST_F(QuickSilverEmulatedTest, TravelGoesOnAfterThirtySecondsWithoutPower) {
  for (const bool also_the_port : {false, true}) {
    SCOPED_TRACE(also_the_port);
    ASSERT_EQ(servo_.open(), Status::ok) << servo_.problem();
    ASSERT_EQ(drive_for(17, {.left_mps = 0.5, .right_mps = 0.5}), 0) << servo_.problem();
    ASSERT_GT(travel_.left_m, 8);
    cut_power_for(30, also_the_port);
    const double least = std::min(travel_.left_m, travel_.right_m);
    for (int i = 0; i < 50; ++i) {
      (void)one_period({.left_mps = 0.5, .right_mps = 0.5});
      EXPECT_GE(travel_.left_m, least);
      EXPECT_GE(travel_.right_m, least);
    }
    EXPECT_LT(travel_.left_m, least + 1.5);
    ASSERT_EQ(drive_for(1, {.left_mps = 0.5, .right_mps = 0.5}), 0) << servo_.problem();
    const WheelTravel before = travel_;
    ASSERT_EQ(drive_for(4, {.left_mps = 0.5, .right_mps = 0.25}), 0) << servo_.problem();
    EXPECT_NEAR(travel_.left_m - before.left_m, 2, 0.03);
    EXPECT_NEAR(travel_.right_m - before.right_m, 1, 0.05);
    servo_.close();
  }
}

// Back for longer than it ran before, so that its heartbeat is beyond where it was.
TEST_F(QuickSilverEmulatedTest, AHeartbeatThatHasCaughtUpIsNotTakenForOneThatWentOn) {
  ASSERT_EQ(servo_.open(), Status::ok) << servo_.problem();
  ASSERT_EQ(drive_for(17, {.left_mps = 0.5, .right_mps = 0.5}), 0) << servo_.problem();
  const double least = travel_.left_m;
  cut_power_for(30, true);
  clock_.advance(25 * kSecond);
  for (int i = 0; i < 50; ++i) {
    (void)one_period({.left_mps = 0.5, .right_mps = 0.5});
    EXPECT_GE(travel_.left_m, least);
  }
  EXPECT_EQ(drive_for(1, {.left_mps = 0.5, .right_mps = 0.5}), 0) << servo_.problem();
}

// A port that was away while the drives had power: all the way counts.
TEST_F(QuickSilverEmulatedTest, TravelGoesOnAfterThirtySecondsWithoutThePort) {
  ASSERT_EQ(servo_.open(), Status::ok) << servo_.problem();
  ASSERT_EQ(drive_for(4, {.left_mps = 0.5, .right_mps = 0.25}), 0) << servo_.problem();
  port_.unplugged = true;
  (void)drive_for(30, {.left_mps = 0.5, .right_mps = 0.25});
  port_.unplugged = false;
  (void)drive_for(2, {.left_mps = 0.5, .right_mps = 0.25});
  EXPECT_EQ(drive_for(2, {.left_mps = 0.5, .right_mps = 0.25}), 0) << servo_.problem();
  expect_travel_is_true();
}

TEST_F(QuickSilverEmulatedTest, UnsupervisedTravelGoesOnAfterThirtySecondsWithoutPower) {
  for (const bool also_the_port : {false, true}) {
    SCOPED_TRACE(also_the_port);
    QuickSilverSettings settings = test::emulated_quicksilver_settings();
    settings.supervised = false;
    QuickSilver servo(settings, port_, clock_);
    ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
    double highest = 0;
    const auto run = [&](double seconds) {
      for (const Nanoseconds end = clock_.now() + static_cast<Nanoseconds>(seconds * kSecond);
           clock_.now() < end;) {
        const Nanoseconds next = in_ms(60);
        (void)servo.drive({.left_mps = 0.3, .right_mps = 0.3}, in_ms(30));
        (void)servo.read_travel(in_ms(30), travel_);
        EXPECT_GE(travel_.left_m, highest);
        highest = std::max(highest, travel_.left_m);
        clock_.sleep_until(next);
      }
    };
    run(27);
    ASSERT_GT(highest, 8);
    line_.has_power = false;
    port_.unplugged = also_the_port;
    run(30);
    port_.unplugged = false;
    give_power_back();
    const double before = highest;
    run(5);
    EXPECT_NEAR(highest - before, 1.5, 0.3);
    std::uint64_t jumps = 0;
    for (const Counter& counter : servo.counters()) {
      if (counter.name == std::string("position_jumps")) jumps = counter.value;
    }
    EXPECT_GE(jumps, 1U);
  }
}

// A drive that has lost its power in the middle of a run, and gets it back.
TEST_F(QuickSilverEmulatedTest, ADriveWithoutPowerStopsTheOtherAndComesBack) {
  ASSERT_EQ(servo_.open(), Status::ok) << servo_.problem();
  ASSERT_EQ(drive_for(4, {.left_mps = 0.5, .right_mps = 0.5}), 0);
  line_.silent_address = 17;
  EXPECT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20)), Status::timeout);
  clock_.advance(kSecond);
  EXPECT_EQ(speed_mps(state(0)), 0);
  line_.drive(1).restart();
  line_.silent_address = 0;
  (void)drive_for(4, {.left_mps = 0.5, .right_mps = 0.5});
  EXPECT_EQ(drive_for(2, {.left_mps = 0.5, .right_mps = 0.5}), 0) << servo_.problem();
  EXPECT_NEAR(speed_mps(state(1)), 0.5, 1e-6);
  // The way until it was noticed is lost; what comes after counts.
  const WheelTravel before = travel_;
  ASSERT_EQ(drive_for(4, {.left_mps = 0.5, .right_mps = 0.5}), 0);
  EXPECT_NEAR(travel_.right_m - before.right_m, 2, 0.02);
}

struct Fault {
  const char* name;
  void (*turn)(emulator::QuickSilverLine& line);
  int least_failures;  // of 334 calls; where it is nearly all of them, the drives cannot answer within 30 ms, or will not
  int most_failures;
  int periods;  // after its end until all is well again
};

std::ostream& operator<<(std::ostream& out, const Fault& fault) {
  return out << fault.name;
}

class QuickSilverFaultTest : public QuickSilverEmulatedTest, public testing::WithParamInterface<Fault> {};

// 10 s at 0.5 m/s with a fault that comes again and again: the driver never runs late, the travel that it reports stays true, and
// the wheels never go faster than asked.
TEST_P(QuickSilverFaultTest, TheTravelStaysTrue) {
  ASSERT_EQ(servo_.open(), Status::ok) << servo_.problem();
  GetParam().turn(line_);
  const int failures = drive_for(10, {.left_mps = 0.5, .right_mps = 0.25});
  EXPECT_GE(failures, GetParam().least_failures) << servo_.problem();
  EXPECT_LE(failures, GetParam().most_failures) << servo_.problem();
  EXPECT_LE(speed_mps(state(0)), 0.5 + 1e-6);
  line_.nak_every = line_.silent_every = line_.garbage_every = 0;
  line_.split = line_.merge = line_.checksum_errors = false;
  line_.slow_ns = 0;
  int periods = 0;
  while (periods < 100 && one_period({.left_mps = 0.5, .right_mps = 0.25}) > 0)
    ++periods;
  EXPECT_LE(periods, GetParam().periods) << servo_.problem();
  expect_travel_is_true();
  ASSERT_EQ(drive_for(2, {.left_mps = 0.5, .right_mps = 0.25}), 0) << servo_.problem();
  EXPECT_NEAR(speed_mps(state(0)), 0.5, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    EveryKind, QuickSilverFaultTest,
    testing::Values(Fault{"busy", [](auto& line) { line.nak_every = 10; }, 0, 0, 0},
                    Fault{"refused", [](auto& line) { line.nak_every = 25, line.nak_code = 6; }, 80, 130, 10},
                    Fault{"silent", [](auto& line) { line.silent_every = 40; }, 80, 130, 2},
                    Fault{"garbage", [](auto& line) { line.garbage_every = 7; }, 0, 0, 0},
                    Fault{"split", [](auto& line) { line.split = true; }, 250, 300, 2},
                    Fault{"merged", [](auto& line) { line.merge = true; }, 0, 0, 0},
                    Fault{"slow", [](auto& line) { line.slow_ns = 15 * kMillisecond; }, 334, 334, 2},
                    Fault{"checksums", [](auto& line) { line.checksum_errors = true; }, 334, 334, 12}),
    [](const auto& of) { return std::string(of.param.name); });

TEST_F(QuickSilverEmulatedTest, SlowAndSplitRepliesAreFineWithTimeEnough) {
  line_.split = true;
  line_.slow_ns = 5 * kMillisecond;
  ASSERT_EQ(servo_.open(), Status::ok) << servo_.problem();
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(80)), Status::ok) << servo_.problem();
    EXPECT_EQ(servo_.read_travel(in_ms(80), travel_), Status::ok) << servo_.problem();
  }
  expect_travel_is_true();
}

}  // namespace
}  // namespace lakshya

// Against a folder laid out as the kernel lays out a PWM chip of four channels.
#include "hal/servo/pwm_servo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <vector>

#include "tests/support/count_allocations.h"
#include "tests/support/faulty_system.h"
#include "tests/support/manual_clock.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

class PwmServoTest : public testing::Test {
 protected:
  PwmServoTest() {
    settings_.root = folder_.path("");
    settings_.root.pop_back();
    settings_.supervised = true;
    settings_.slew_mps2 = 1000;
    std::filesystem::create_directories(folder_.path("pwmchip0"));
    (void)folder_.write("pwmchip0/export", std::string());
    for (const char* channel : {"pwm0", "pwm1"}) {
      const std::string name = std::string("pwmchip0/") + channel;
      std::filesystem::create_directories(folder_.path(name));
      for (const char* attribute : {"/period", "/duty_cycle", "/enable"})
        (void)folder_.write(name + attribute, std::string());
    }
  }

  // The last pulses, in us.
  std::vector<double> pulses() {
    std::vector<double> us;
    for (const std::string& write : system_.writes) {
      if (write.starts_with("duty_cycle=")) us.push_back(std::stod(write.substr(11)) / 1000);
    }
    if (us.size() > 2) us.erase(us.begin(), us.end() - 2);
    return us;
  }

  Status drive(PwmServo& servo, double left, double right) {
    clock_.advance(20 * kMillisecond);
    return servo.drive({left, right}, clock_.now());
  }

  TempFolder folder_;
  FaultySystem system_;
  ManualClock clock_;
  PwmServoSettings settings_;
  WheelTravel travel_;
};

using Pulses = std::vector<double>;

TEST_F(PwmServoTest, SetsUpBothChannelsAtRestAndTakesThemDownAgain) {
  PwmServo servo(settings_, clock_, system_);
  ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
  const std::vector<std::string> up = {
      "export=0", "duty_cycle=0", "period=20000000", "duty_cycle=1500000", "enable=1",
      "export=1", "duty_cycle=0", "period=20000000", "duty_cycle=1500000", "enable=1"};
  EXPECT_EQ(system_.writes, up);
  ASSERT_EQ(drive(servo, 1, 1), Status::ok);
  system_.writes.clear();
  servo.close();
  const std::vector<std::string> down = {"duty_cycle=1500000", "duty_cycle=1500000", "enable=0", "enable=0"};
  EXPECT_EQ(system_.writes, down);
  EXPECT_EQ(system_.open_files(), 0U);
}

TEST_F(PwmServoTest, PulsesAreInProportionToTheSpeed) {
  settings_.full_speed_mps = 2;
  settings_.max_speed_mps = 2;
  settings_.direction = {1, -1};
  settings_.center_us = {1500, 1480};
  PwmServo servo(settings_, clock_, system_);
  ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
  ASSERT_EQ(drive(servo, 0.5, 0.5), Status::ok);
  EXPECT_EQ(pulses(), (Pulses{1625, 1355}));
  ASSERT_EQ(drive(servo, -2, 2), Status::ok);
  EXPECT_EQ(pulses(), (Pulses{1000, 980}));
  ASSERT_EQ(servo.stop(clock_.now()), Status::ok);
  EXPECT_EQ(pulses(), (Pulses{1500, 1480}));
}

TEST_F(PwmServoTest, SpeedsChangeNoFasterThanTheSlewButAStopIsAtOnce) {
  settings_.slew_mps2 = 1;
  PwmServo servo(settings_, clock_, system_);
  ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
  ASSERT_EQ(drive(servo, 1, -1), Status::ok);  // after 20 ms
  EXPECT_EQ(pulses(), (Pulses{1510, 1490}));
  clock_.advance(10 * kMillisecond);
  ASSERT_EQ(servo.read_travel(clock_.now(), travel_), Status::ok);  // looking changes nothing
  clock_.advance(50 * kMillisecond);
  ASSERT_EQ(drive(servo, 1, -1), Status::ok);
  EXPECT_EQ(pulses(), (Pulses{1550, 1450}));
  ASSERT_EQ(servo.stop(clock_.now()), Status::ok);
  EXPECT_EQ(pulses(), (Pulses{1500, 1500}));
  clock_.advance(10 * kSecond);  // a pause is no leave for a jump
  ASSERT_EQ(drive(servo, 1, -1), Status::ok);
  EXPECT_EQ(pulses(), (Pulses{1550, 1450}));
}

TEST_F(PwmServoTest, TheWayIsThatOfThePulsesAndSaysThatNobodyMeasuredIt) {
  PwmServo servo(settings_, clock_, system_);
  ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
  ASSERT_EQ(drive(servo, 0.5, -0.25), Status::ok);
  clock_.advance(2 * kSecond);
  ASSERT_EQ(servo.read_travel(clock_.now(), travel_), Status::ok);
  EXPECT_DOUBLE_EQ(travel_.left_m, 1);
  EXPECT_DOUBLE_EQ(travel_.right_m, -0.5);
  EXPECT_FALSE(travel_.measured);
}

TEST_F(PwmServoTest, WhatNothingStopsIsNotDrivenFasterThanWalkingAside) {
  settings_.supervised = false;
  settings_.unsupervised_mps = 0.3;
  PwmServo servo(settings_, clock_, system_);
  EXPECT_EQ(servo.max_speed_mps(), 0.3);
  EXPECT_FALSE(servo.is_supervised());
  ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
  ASSERT_EQ(drive(servo, 0.3, 0.3), Status::ok);
  EXPECT_EQ(pulses(), (Pulses{1650, 1650}));
  EXPECT_EQ(drive(servo, 0.31, 0.3), Status::refused);
  EXPECT_EQ(pulses(), (Pulses{1500, 1500}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(drive(servo, nan, 0), Status::refused);
  EXPECT_EQ(drive(servo, 0, -INFINITY), Status::refused);
  EXPECT_EQ(servo.counters()[0].value, 3U);
}

TEST_F(PwmServoTest, AChipThatGoesIsLookedForAgainAndStartsAtRest) {
  PwmServo servo(settings_, clock_, system_);
  ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
  ASSERT_EQ(drive(servo, 1, 1), Status::ok);
  system_.unplugged = true;
  EXPECT_EQ(drive(servo, 1, 1), Status::disconnected);
  EXPECT_EQ(servo.counters()[2].value, 1U);
  const Nanoseconds before = clock_.now();
  EXPECT_EQ(servo.stop(clock_.now()), Status::disconnected);
  EXPECT_EQ(servo.read_travel(clock_.now(), travel_), Status::disconnected);
  EXPECT_EQ(drive(servo, 1, 1), Status::disconnected);
  EXPECT_EQ(clock_.now() - before, 20 * kMillisecond);  // nobody waited for it
  system_.unplugged = false;
  EXPECT_EQ(drive(servo, 1, 1), Status::disconnected);  // too early to look again
  clock_.advance(200 * kMillisecond);
  system_.writes.clear();
  ASSERT_EQ(drive(servo, 1, 1), Status::ok);
  EXPECT_EQ(pulses(), (Pulses{1500, 1500}));  // no time has passed since they were set up
  ASSERT_EQ(drive(servo, 1, 1), Status::ok);
  EXPECT_EQ(pulses(), (Pulses{2000, 2000}));
}

TEST_F(PwmServoTest, WhenOneChannelFailsOnceBothWheelsAreStopped) {
  for (const int error : {EIO, EINVAL}) {
    for (const char* channel : {"pwm0/", "pwm1/"}) {
      FaultySystem system;
      PwmServo servo(settings_, clock_, system);
      ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
      ASSERT_EQ(drive(servo, 1, 1), Status::ok);
      system.write_error = error;
      system.write_error_at = channel;
      system.write_errors_left = 1;
      system.writes.clear();
      EXPECT_EQ(drive(servo, 0.5, 0.5), error == EIO ? Status::disconnected : Status::refused);
      ASSERT_GE(system.writes.size(), 2U);
      EXPECT_EQ(system.writes[system.writes.size() - 2], "duty_cycle=1500000");
      EXPECT_EQ(system.writes[system.writes.size() - 1], "duty_cycle=1500000");
    }
  }
}

TEST_F(PwmServoTest, ALostChipIsStoppedByCloseIfItIsBack) {
  PwmServo servo(settings_, clock_, system_);
  ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
  ASSERT_EQ(drive(servo, 1, 1), Status::ok);
  system_.unplugged = true;
  EXPECT_EQ(drive(servo, 1, 1), Status::disconnected);
  system_.unplugged = false;
  system_.writes.clear();
  EXPECT_EQ(servo.stop(clock_.now()), Status::ok);  // at once, whatever drive() waits for
  servo.close();
  const std::vector<std::string> down = {"duty_cycle=1500000", "duty_cycle=1500000", "duty_cycle=1500000",
                                         "duty_cycle=1500000", "enable=0",           "enable=0"};
  EXPECT_EQ(system_.writes, down);
  EXPECT_EQ(system_.open_files(), 0U);
}

TEST_F(PwmServoTest, APulseThatTheChipDoesNotTakeIsRefused) {
  PwmServo servo(settings_, clock_, system_);
  ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
  system_.write_error = EINVAL;
  EXPECT_EQ(drive(servo, 1, 1), Status::refused);
  EXPECT_NE(std::string(servo.problem()).find("duty_cycle"), std::string::npos) << servo.problem();
  EXPECT_EQ(servo.counters()[1].value, 3U);  // the left pulse, and both of rest
}

TEST_F(PwmServoTest, ChannelsExportedBeforeAreFineAndThoseThatDoNotComeAreNotWaitedForLong) {
  std::filesystem::remove_all(folder_.path("pwmchip0/pwm1"));
  PwmServo servo(settings_, clock_, system_);
  const Nanoseconds before = clock_.now();
  EXPECT_EQ(servo.open(), Status::disconnected);
  EXPECT_EQ(clock_.now() - before, kSecond / 2);
  EXPECT_NE(std::string(servo.problem()).find("pwmchip0/pwm1"), std::string::npos) << servo.problem();
  EXPECT_EQ(system_.open_files(), 0U);
  EXPECT_EQ(drive(servo, 0, 0), Status::disconnected);

  settings_.chip = 3;
  PwmServo other(settings_, clock_, system_);
  EXPECT_EQ(other.open(), Status::disconnected);
  EXPECT_NE(std::string(other.problem()).find("pwmchip3/export: No such file"), std::string::npos)
      << other.problem();
}

TEST_F(PwmServoTest, AllocatesNothingAfterItWasOpened) {
  PwmServo servo(settings_, clock_);
  ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
  test::allocations = 0;
  EXPECT_EQ(drive(servo, 1, 1), Status::ok);
  EXPECT_EQ(drive(servo, 9, 9), Status::refused);
  EXPECT_EQ(servo.read_travel(clock_.now(), travel_), Status::ok);
  EXPECT_EQ(servo.stop(clock_.now()), Status::ok);
  servo.close();
  EXPECT_EQ(test::allocations, 0);
}

TEST_F(PwmServoTest, ImpossibleSettingsAreRefused) {
  const auto refused = [&](auto change) {
    PwmServoSettings settings = settings_;
    change(settings);
    PwmServo servo(settings, clock_, system_);
    return servo.open() == Status::bad_argument && servo.problem()[0] != 0;
  };
  EXPECT_TRUE(refused([](auto& s) { s.span_us = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.center_us[1] = 200; }));
  EXPECT_TRUE(refused([](auto& s) { s.center_us[0] = 2500; }));
  EXPECT_TRUE(refused([](auto& s) { s.period_us = 1900; }));
  EXPECT_TRUE(refused([](auto& s) { s.channel[1] = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.direction[0] = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.max_speed_mps = 1.5; }));
  EXPECT_TRUE(refused([](auto& s) { s.full_speed_mps = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.slew_mps2 = -1; }));
  EXPECT_TRUE(system_.writes.empty());
}

}  // namespace
}  // namespace lakshya

#include "hal/servo/record_servo.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "tests/support/count_allocations.h"
#include "tests/support/faulty_system.h"
#include "tests/support/manual_clock.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

std::string content(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class RecordServoTest : public testing::Test {
 protected:
  TempFolder folder_;
  std::string path_ = folder_.write("commands.csv", std::string("of yesterday\n"));
  ManualClock clock_;  // begins at 1000 s
  WheelTravel travel_;
};

TEST_F(RecordServoTest, WritesEveryCommandWithItsTimeAndAddsUpTheWay) {
  RecordServo servo({.path = path_, .max_speed_mps = 2}, clock_);
  ASSERT_EQ(servo.open(), Status::ok);
  test::allocations = 0;
  EXPECT_EQ(servo.drive({1, 0.5}, clock_.now()), Status::ok);
  clock_.advance(250 * kMillisecond);
  EXPECT_EQ(servo.drive({-2, 2}, clock_.now()), Status::ok);
  clock_.advance(kSecond);
  EXPECT_EQ(servo.read_travel(clock_.now(), travel_), Status::ok);
  servo.close();
  EXPECT_EQ(test::allocations, 0);
  EXPECT_DOUBLE_EQ(travel_.left_m, 0.25 - 2);
  EXPECT_DOUBLE_EQ(travel_.right_m, 0.125 + 2);
  EXPECT_EQ(travel_.time, clock_.now());
  EXPECT_FALSE(travel_.measured);
  EXPECT_EQ(content(path_), "1000.000000,1.0000,0.5000\n1000.250000,-2.0000,2.0000\n1001.250000,0.0000,0.0000\n");
}

TEST_F(RecordServoTest, WhatIsTooFastOrNoNumberIsRefusedAndStops) {
  RecordServo servo({.path = {}, .max_speed_mps = 1}, clock_);
  ASSERT_EQ(servo.open(), Status::ok);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const WheelVelocities& wanted : {WheelVelocities{1.1, 0}, {0, -1.1}, {nan, 0}, {0, nan}, {INFINITY, 0}}) {
    ASSERT_EQ(servo.drive({1, 1}, clock_.now()), Status::ok);
    EXPECT_EQ(servo.drive(wanted, clock_.now()), Status::refused);
    EXPECT_EQ(servo.last().left_mps, 0);
    EXPECT_EQ(servo.last().right_mps, 0);
  }
  EXPECT_EQ(servo.counters()[1].value, 5U);
}

TEST_F(RecordServoTest, AFullDiskIsToldAndTheCommandHoldsAllTheSame) {
  FaultySystem system;
  RecordServo servo({.path = path_}, clock_, system);
  ASSERT_EQ(servo.open(), Status::ok);
  system.write_error = ENOSPC;
  EXPECT_EQ(servo.drive({1, 1}, clock_.now()), Status::disconnected);
  EXPECT_NE(std::string(servo.problem()).find("No space left"), std::string::npos) << servo.problem();
  EXPECT_EQ(servo.last().left_mps, 1);
  EXPECT_EQ(servo.counters()[2].value, 1U);
  system.write_error = 0;
  EXPECT_EQ(servo.drive({1, 1}, clock_.now()), Status::ok);
  servo.close();
  EXPECT_EQ(system.open_files(), 0U);
}

TEST_F(RecordServoTest, ClosedItDoesNothingAndAPathThatCannotBeIsRefused) {
  RecordServo servo({.path = folder_.path("none/commands.csv")}, clock_);
  EXPECT_EQ(servo.drive({0, 0}, clock_.now()), Status::disconnected);
  EXPECT_EQ(servo.read_travel(clock_.now(), travel_), Status::disconnected);
  EXPECT_EQ(servo.open(), Status::disconnected);
  EXPECT_NE(std::string(servo.problem()).find("No such file"), std::string::npos) << servo.problem();
}

}  // namespace
}  // namespace lakshya

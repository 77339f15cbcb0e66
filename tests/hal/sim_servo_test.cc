#include "hal/servo/sim_servo.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "tests/support/manual_clock.h"

namespace lakshya {
namespace {

class Noted final : public WheelProducer {
 public:
  Status command(Nanoseconds /*time*/, const WheelVelocities& wanted) override {
    commands.emplace_back(wanted.left_mps, wanted.right_mps);
    return Status::ok;
  }
  Status travel(Nanoseconds /*time*/, WheelTravel& travel) override {
    travel = {.left_m = 1, .right_m = 2};
    return Status::ok;
  }
  std::vector<std::pair<double, double>> commands;
};

TEST(SimServo, HandsCommandsOnAndStopsWhatIsTooFast) {
  ManualClock clock;
  Noted wheels;
  SimServo servo(1, wheels, clock);
  WheelTravel travel;
  EXPECT_EQ(servo.drive({0.5, 0.5}, clock.now()), Status::disconnected);
  EXPECT_EQ(servo.read_travel(clock.now(), travel), Status::disconnected);
  ASSERT_EQ(servo.open(), Status::ok);
  EXPECT_EQ(servo.drive({0.5, -1}, clock.now()), Status::ok);
  EXPECT_EQ(servo.drive({2, 0}, clock.now()), Status::refused);
  EXPECT_EQ(servo.drive({std::numeric_limits<double>::quiet_NaN(), 0}, clock.now()), Status::refused);
  EXPECT_EQ(servo.drive({0.25, 0.25}, clock.now()), Status::ok);
  clock.advance(kSecond);
  ASSERT_EQ(servo.read_travel(clock.now(), travel), Status::ok);
  EXPECT_EQ(travel.right_m, 2);
  EXPECT_EQ(travel.time, clock.now());
  servo.close();
  const std::vector<std::pair<double, double>> expected = {{0, 0}, {0.5, -1}, {0, 0}, {0, 0}, {0.25, 0.25}, {0, 0}};
  EXPECT_EQ(wheels.commands, expected);
  EXPECT_EQ(servo.counters()[0].value, 2U);
}

}  // namespace
}  // namespace lakshya

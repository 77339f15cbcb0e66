// QuickSilver without resident programs: settings that say so, slower speeds, VMI.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/quicksilver_rig.h"

namespace lakshya {
namespace {

class QuickSilverUnsupervisedTest : public test::QuickSilverRig {
 protected:
  QuickSilverUnsupervisedTest() { registers_ = {{16, {}}, {17, {}}}; }

  static QuickSilverSettings unsupervised() {
    QuickSilverSettings settings = test::quicksilver_settings();
    settings.supervised = false;
    return settings;
  }

  QuickSilver vmi_{unsupervised(), port_, clock_};
};

TEST_F(QuickSilverUnsupervisedTest, DrivesByVmiAndSlowly) {
  ASSERT_EQ(vmi_.open(), Status::ok) << vmi_.problem();
  EXPECT_FALSE(vmi_.is_supervised());
  EXPECT_EQ(vmi_.max_speed_mps(), 0.3);
  const std::vector<std::string> set_up = {"@16 3 0", "@17 3 0", "@16 12 1", "@17 12 1"};
  EXPECT_EQ(commands_, set_up);
  commands_.clear();
  EXPECT_EQ(vmi_.drive({.left_mps = 0.25, .right_mps = 0.25}, in_ms(20)), Status::ok);
  const std::vector<std::string> driven = {"@16 15 32212 134217728 0 0", "@17 15 32212 -134217728 0 0"};
  EXPECT_EQ(commands_, driven);
  commands_.clear();
  EXPECT_EQ(vmi_.drive({.left_mps = 0.31, .right_mps = 0.25}, in_ms(20)), Status::refused);
  const std::vector<std::string> stopped = {"@16 3 0", "@17 3 0"};
  EXPECT_EQ(commands_, stopped);
}

TEST_F(QuickSilverUnsupervisedTest, TheSlowerLimitHolds) {
  QuickSilverSettings settings = unsupervised();
  settings.max_speed_mps = 0.2;
  EXPECT_EQ(QuickSilver(settings, port_, clock_).max_speed_mps(), 0.2);
}

TEST_F(QuickSilverUnsupervisedTest, WithoutALimitTheWheelsOnlyStand) {
  QuickSilverSettings settings = unsupervised();
  settings.v_unsupervised_mps = 0;
  QuickSilver servo(settings, port_, clock_);
  ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
  EXPECT_EQ(servo.max_speed_mps(), 0);
  EXPECT_EQ(servo.drive({}, in_ms(20)), Status::ok);
  EXPECT_EQ(servo.drive({.left_mps = 0.01, .right_mps = 0}, in_ms(20)), Status::refused);
}

TEST_F(QuickSilverUnsupervisedTest, CloseLooksForAPortThatHasGoneAndStops) {
  const std::vector<std::string> stopped = {"@16 3 0", "@17 3 0"};
  for (const bool was_noticed : {true, false}) {
    ASSERT_EQ(vmi_.open(), Status::ok) << vmi_.problem();
    ASSERT_EQ(vmi_.drive({.left_mps = 0.25, .right_mps = 0.25}, in_ms(20)), Status::ok);
    port_.unplugged = true;
    if (was_noticed) {
      EXPECT_EQ(vmi_.drive({.left_mps = 0.25, .right_mps = 0.25}, in_ms(20)), Status::disconnected);
    } else {
      std::size_t count = 0;
      std::array<std::uint8_t, 1> byte{};
      EXPECT_EQ(port_.read(byte, in_ms(0), count), Status::disconnected);
    }
    port_.unplugged = false;
    commands_.clear();
    vmi_.close();
    EXPECT_EQ(commands_, stopped);
    EXPECT_FALSE(port_.is_open());
  }
}

TEST_F(QuickSilverUnsupervisedTest, CloseDoesNotWaitForAPortThatStaysAway) {
  ASSERT_EQ(vmi_.open(), Status::ok) << vmi_.problem();
  port_.unplugged = true;
  port_.opened = 0;
  const Nanoseconds begin = clock_.now();
  vmi_.close();
  EXPECT_EQ(port_.opened, 1);
  EXPECT_EQ(clock_.now(), begin);
}

TEST_F(QuickSilverUnsupervisedTest, ADriveThatRefusesToStopIsHalted) {
  ASSERT_EQ(vmi_.open(), Status::ok);
  commands_.clear();
  override_answer = [&](const std::string& command) {
    if (command != "@17 3 0") return false;
    port_.say(nak(17, 3, 9), kMillisecond);
    return true;
  };
  EXPECT_EQ(vmi_.stop(in_ms(20)), Status::ok);
  EXPECT_TRUE(was_sent("@17 2"));
  override_answer = [](const std::string& command) { return command.starts_with("@17"); };
  commands_.clear();
  EXPECT_EQ(vmi_.drive({.left_mps = 0.1, .right_mps = 0.1}, in_ms(40)), Status::timeout);
  EXPECT_TRUE(was_sent("@16 3 0"));
}

}  // namespace
}  // namespace lakshya

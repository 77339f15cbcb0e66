// QuickSilver: settings, and what open() sets up and does not believe.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/quicksilver_rig.h"

namespace lakshya {
namespace {

using QuickSilverOpenTest = test::QuickSilverRig;

TEST_F(QuickSilverOpenTest, OpenSetsUpAndSeesTheProgramsAct) {
  const Nanoseconds begin = clock_.now();
  ASSERT_EQ(servo_.open(), Status::ok) << servo_.problem();
  const std::vector<std::string> expected = {
      "@16 11 30 0",     "@17 11 30 0",     "@16 12 33", "@17 12 33", "@16 12 1",  "@17 12 1",
      "@16 11 29 32212", "@17 11 29 32212", "@16 12 29", "@17 12 29", "@16 12 32", "@17 12 32",
      "@16 11 30 1",     "@17 11 30 1",     "@16 12 32", "@17 12 32", "@16 12 30", "@17 12 30"};
  EXPECT_EQ(commands_, expected);
  EXPECT_GE(clock_.now() - begin, 300 * kMillisecond);
  EXPECT_LE(clock_.now() - begin, 400 * kMillisecond);
  EXPECT_TRUE(servo_.is_supervised());
  EXPECT_EQ(servo_.max_speed_mps(), 1.0);
}

TEST_F(QuickSilverOpenTest, WithoutItsSignatureAProgramIsNotBelieved) {
  registers_[17][33] = 0;
  EXPECT_EQ(servo_.open(), Status::refused);
  expect_problem("drive 17: no resident program: signature register 33 holds 0");
  EXPECT_FALSE(port_.is_open());
  EXPECT_EQ(count("dead_programs"), 1U);
  EXPECT_FALSE(was_sent("@17 11 30 1"));
}

TEST_F(QuickSilverOpenTest, AHeartbeatThatStandsStillIsNotBelieved) {
  alive_ = false;
  EXPECT_EQ(servo_.open(), Status::refused);
  expect_problem("drive 16: resident program: its heartbeat stands still");
}

TEST_F(QuickSilverOpenTest, AProgramThatDoesNotZeroTheVelocityIsNotBelieved) {
  acts_ = false;
  EXPECT_EQ(servo_.open(), Status::refused);
  expect_problem("drive 16: resident program: it does not zero");
  EXPECT_EQ(registers_[16][30], 0) << "close() stops";
}

TEST_F(QuickSilverOpenTest, ARegisterThatDoesNotHoldItsValueIsNotBelieved) {
  override_answer = [&](const std::string& command) {
    if (command != "@16 12 29") return false;
    port_.say(data(16, 5), kMillisecond);
    return true;
  };
  EXPECT_EQ(servo_.open(), Status::refused);
  expect_problem("register 29 holds 5 instead of the acceleration 32212");
}

TEST_F(QuickSilverOpenTest, ADriveThatIsNotThereEndsOpen) {
  silence("17");
  const Nanoseconds begin = clock_.now();
  EXPECT_EQ(servo_.open(), Status::timeout);
  expect_problem("drive 17: no reply");
  EXPECT_LE(clock_.now() - begin, 2 * kSecond);
  EXPECT_FALSE(port_.is_open());
}

TEST_F(QuickSilverOpenTest, APortThatIsNotThereEndsOpen) {
  port_.unplugged = true;
  EXPECT_EQ(servo_.open(), Status::disconnected);
  expect_problem("not there");
}

TEST_F(QuickSilverOpenTest, OpenSurvivesALostReply) {
  int lost = 0;
  override_answer = [&](const std::string& command) { return command == "@17 12 33" && lost++ == 0; };
  EXPECT_EQ(servo_.open(), Status::ok) << servo_.problem();
  EXPECT_EQ(count("timeouts"), 1U);
}

TEST_F(QuickSilverOpenTest, ImpossibleSettingsAreRefused) {
  const double nan = std::nan("");
  const std::vector<std::pair<const char*, std::function<void(QuickSilverSettings&)>>> cases = {
      {"address", [](auto& s) { s.left.address = 0; }},
      {"address", [](auto& s) { s.right.address = 255; }},
      {"address of both", [](auto& s) { s.right.address = 16; }},
      {"direction", [](auto& s) { s.left.direction = 0; }},
      {"direction", [](auto& s) { s.left.direction = 2; }},
      {"radius_m", [](auto& s) { s.right.radius_m = 0; }},
      {"radius_m", [&](auto& s) { s.right.radius_m = nan; }},
      {"gear_ratio", [](auto& s) { s.left.gear_ratio = -10; }},
      {"counts_per_rev", [](auto& s) { s.left.counts_per_rev = 0; }},
      {"max_speed_mps", [](auto& s) { s.max_speed_mps = 0; }},
      {"max_speed_mps", [](auto& s) { s.max_speed_mps = 4.01; }},  // 4010 rpm
      {"max_speed_mps", [&](auto& s) { s.max_speed_mps = nan; }},
      {"max_acceleration_mps2", [](auto& s) { s.max_acceleration_mps2 = 0; }},
      {"max_acceleration_mps2", [&](auto& s) { s.max_acceleration_mps2 = nan; }},
      {"v_unsupervised_mps", [](auto& s) { s.v_unsupervised_mps = -0.1; }},
      {"v_unsupervised_mps", [&](auto& s) { s.v_unsupervised_mps = nan; }},
      {"register", [](auto& s) { s.velocity_register = 11; }},  // the one before is 10
      {"register", [](auto& s) { s.counter_register = 199; }},
      {"register used twice", [](auto& s) { s.heartbeat_register = 29; }},
      {"register used twice", [](auto& s) { s.signature_register = 31; }},
      {"watchdog_s", [](auto& s) { s.watchdog_s = 0.04; }},
      {"watchdog_s", [&](auto& s) { s.watchdog_s = nan; }},
      {"answer_timeout_s", [](auto& s) { s.answer_timeout_s = 0.001; }},
      {"quiet_s", [](auto& s) { s.quiet_s = 1; }},
      {"quiet_s", [&](auto& s) { s.quiet_s = nan; }},
  };
  for (const auto& [what, change] : cases) {
    QuickSilverSettings settings = test::quicksilver_settings();
    change(settings);
    QuickSilver servo(settings, port_, clock_);
    EXPECT_EQ(servo.open(), Status::bad_argument) << what;
    EXPECT_NE(std::string(servo.problem()).find(what), std::string::npos) << what << ": " << servo.problem();
  }
  EXPECT_EQ(port_.opened, 0);
}

}  // namespace
}  // namespace lakshya

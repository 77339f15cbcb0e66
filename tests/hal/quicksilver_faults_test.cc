// QuickSilver after a good start: drives that start anew, programs that die, a plug that is pulled.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/quicksilver_rig.h"

namespace lakshya {
namespace {

using QuickSilverFaultsTest = test::QuickSilverRig;

// ---- drives that start anew

TEST_F(QuickSilverFaultsTest, ADriveThatStartedAnewIsStoppedAndSetUpAgain) {
  registers_[16][1] = 1'000'000;
  open_it();
  WheelTravel travel;
  ASSERT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20)), Status::ok);
  registers_[16][1] = 0;
  EXPECT_EQ(servo_.read_travel(in_ms(20), travel), Status::bad_data);
  commands_.clear();
  EXPECT_EQ(servo_.read_travel(in_ms(20), travel), Status::bad_data);
  expect_problem("drive 16: has started anew at position 0");
  EXPECT_EQ(count("position_jumps"), 1U);
  EXPECT_EQ(registers_[17][30], 0);
  Status status = Status::timeout;
  for (int i = 0; i < 50 && status != Status::ok; ++i) {
    clock_.advance(20 * kMillisecond);
    status = servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20));
  }
  EXPECT_EQ(status, Status::ok) << servo_.problem();
  EXPECT_TRUE(was_sent("@16 11 29 32212"));
  registers_[16][1] = 80;
  EXPECT_EQ(servo_.read_travel(in_ms(20), travel), Status::ok);
  EXPECT_NEAR(travel.left_m, 0.0006, 1e-12);
}

TEST_F(QuickSilverFaultsTest, AHeartbeatThatGoesBackIsADriveThatStartedAnew) {
  open_it();
  clock_.advance(2 * kSecond);
  alive_ = false;
  registers_[16][32] = 3;
  WheelTravel travel;
  EXPECT_EQ(servo_.read_travel(in_ms(20), travel), Status::refused);
  expect_problem("drive 16: resident program: it has started anew");
}

// ---- the program later on

TEST_F(QuickSilverFaultsTest, AProgramThatDiesLaterIsNoticedAndTheWheelsAreStopped) {
  open_it();
  WheelTravel travel;
  for (int i = 0; i < 150; ++i) {
    ASSERT_EQ(servo_.read_travel(in_ms(20), travel), Status::ok) << servo_.problem();
    clock_.advance(20 * kMillisecond);
  }
  EXPECT_TRUE(was_sent("@16 12 32") && was_sent("@17 12 32"));
  alive_ = false;
  for (auto& [address, registers] : registers_)
    registers[32] = static_cast<std::int32_t>(clock_.now() / (10 * kMillisecond));
  ASSERT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20)), Status::ok);
  Status status = Status::ok;
  Nanoseconds begin = clock_.now();
  while (status == Status::ok && clock_.now() < begin + 5 * kSecond) {
    clock_.advance(20 * kMillisecond);
    status = servo_.read_travel(in_ms(20), travel);
  }
  EXPECT_EQ(status, Status::refused);
  EXPECT_LT(clock_.now() - begin, 2100 * kMillisecond);  // the one look may have been just before
  expect_problem("its heartbeat stands still");
  EXPECT_EQ(registers_[16][30], 0);
  EXPECT_EQ(registers_[17][30], 0);
  EXPECT_EQ(count("dead_programs"), 1U);

  status = Status::timeout;
  begin = clock_.now();
  commands_.clear();
  while (clock_.now() < begin + 2 * kSecond) {
    EXPECT_NE(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20)), Status::ok);
    clock_.advance(20 * kMillisecond);
  }
  EXPECT_FALSE(was_sent("@16 11 30 268435456"));
  alive_ = true;
  while (status != Status::ok && clock_.now() < begin + 4 * kSecond) {
    status = servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20));
    clock_.advance(20 * kMillisecond);
  }
  EXPECT_TRUE(was_sent("@16 11 30 268435456")) << "a program that runs again is taken again";
}

TEST_F(QuickSilverFaultsTest, AHeartbeatThatCannotBeReadIsNoHeartbeat) {
  open_it();
  override_answer = [](const std::string& command) { return command.ends_with(" 12 32"); };
  WheelTravel travel;
  Status status = Status::ok;
  const Nanoseconds begin = clock_.now();
  while (status != Status::refused && clock_.now() < begin + 10 * kSecond) {
    status = servo_.read_travel(in_ms(20), travel);
    clock_.advance(20 * kMillisecond);
  }
  EXPECT_EQ(status, Status::refused);
  expect_problem("its heartbeat cannot be read");
}

// ---- unplugged

TEST_F(QuickSilverFaultsTest, APulledPlugIsLookedForEvery200MsAndTheDrivesAreSetUpAgain) {
  open_it();
  WheelTravel travel;
  ASSERT_EQ(servo_.read_travel(in_ms(20), travel), Status::ok);
  port_.unplugged = true;
  EXPECT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20)), Status::disconnected);
  EXPECT_EQ(count("disconnections"), 1U);
  port_.opened = 0;
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20)), Status::disconnected);
    EXPECT_EQ(servo_.read_travel(in_ms(20), travel), Status::disconnected);
    EXPECT_EQ(servo_.stop(in_ms(20)), Status::disconnected);
    clock_.advance(20 * kMillisecond);
  }
  EXPECT_EQ(port_.opened, 5);
  EXPECT_EQ(count("disconnections"), 1U);
  port_.unplugged = false;
  registers_[16][1] += 8000;  // it rolled on a little
  commands_.clear();
  const Nanoseconds begin = clock_.now();
  Status status = Status::disconnected;
  while (status != Status::ok && clock_.now() < begin + 2 * kSecond) {
    const Nanoseconds deadline = in_ms(20);
    status = servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, deadline);
    EXPECT_LE(clock_.now(), deadline);
    if (status != Status::ok) {
      EXPECT_FALSE(was_sent("@16 11 30 268435456")) << "before the program was seen to act";
    }
    clock_.advance(10 * kMillisecond);
  }
  EXPECT_EQ(status, Status::ok) << servo_.problem();
  EXPECT_TRUE(was_sent("@16 11 29 32212"));
  ASSERT_EQ(servo_.read_travel(in_ms(20), travel), Status::ok);
  EXPECT_NEAR(travel.left_m, 0.06, 1e-12) << "travel goes on";
}

TEST_F(QuickSilverFaultsTest, AStopDuringTheTrialIsNotTakenForTheProgramsDoing) {
  open_it();
  acts_ = false;
  port_.unplugged = true;
  EXPECT_EQ(servo_.stop(in_ms(20)), Status::disconnected);
  port_.unplugged = false;
  for (int i = 0; i < 200; ++i) {
    clock_.advance(20 * kMillisecond);
    EXPECT_NE(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20)), Status::ok);
    if (i % 5 == 0) (void)servo_.stop(in_ms(20));
  }
  EXPECT_FALSE(was_sent("@16 11 30 268435456"));
}

// As a caller does for whom a failed drive() is a reason to stop.
TEST_F(QuickSilverFaultsTest, StoppingAfterEveryFailureDoesNotHinderSettingUp) {
  open_it();
  port_.unplugged = true;
  EXPECT_EQ(servo_.stop(in_ms(20)), Status::disconnected);
  port_.unplugged = false;
  const Nanoseconds begin = clock_.now();
  Status status = Status::disconnected;
  while (status != Status::ok && clock_.now() < begin + 2 * kSecond) {
    clock_.advance(20 * kMillisecond);
    status = servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20));
    if (status != Status::ok) (void)servo_.stop(in_ms(20));
  }
  EXPECT_EQ(status, Status::ok) << servo_.problem();
}

}  // namespace
}  // namespace lakshya

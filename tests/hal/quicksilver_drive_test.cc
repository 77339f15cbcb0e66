// QuickSilver: drive(), stop(), close() and read_travel(): what is sent, and what follows when a drive is silent or refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "tests/support/quicksilver_rig.h"

namespace lakshya {
namespace {

using QuickSilverDriveTest = test::QuickSilverRig;

const std::vector<std::string> kBothStopped = {"@16 11 30 0", "@17 11 30 0"};

// ---- drive

TEST_F(QuickSilverDriveTest, DriveWritesBothVelocitiesThenBothCounters) {
  open_it();
  EXPECT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.25}, in_ms(20)), Status::ok) << servo_.problem();
  const std::vector<std::string> first = {"@16 11 30 268435456", "@17 11 30 -134217728", "@16 11 31 1",
                                          "@17 11 31 1"};
  EXPECT_EQ(commands_, first);
  commands_.clear();
  EXPECT_EQ(servo_.drive({.left_mps = -1.0, .right_mps = 0}, in_ms(20)), Status::ok);
  const std::vector<std::string> second = {"@16 11 30 -536870912", "@17 11 30 0", "@16 11 31 2", "@17 11 31 2"};
  EXPECT_EQ(commands_, second);
}

TEST_F(QuickSilverDriveTest, TheCounterMovesWithEveryCall) {
  open_it();
  std::int32_t before = registers_[16][31];
  for (int i = 0; i < 25; ++i) {
    ASSERT_EQ(servo_.drive({}, in_ms(20)), Status::ok);
    EXPECT_NE(registers_[16][31], before);
    before = registers_[16][31];
    EXPECT_LE(before, 9) << "one digit: the line is slow";
  }
}

TEST_F(QuickSilverDriveTest, WhatIsNoSpeedIsRefusedAndStopsTheWheels) {
  open_it();
  const double inf = std::numeric_limits<double>::infinity();
  std::uint64_t refused = 0;
  for (const WheelVelocities& wanted :
       {WheelVelocities{1.002, 0}, {0, -1.002}, {std::nan(""), 0}, {0, std::nan("")}, {inf, 0}, {0, -inf}}) {
    commands_.clear();
    EXPECT_EQ(servo_.drive(wanted, in_ms(20)), Status::refused);
    EXPECT_EQ(commands_, kBothStopped);
    expect_problem("faster than 1 m/s");
    EXPECT_EQ(count("refused_commands"), ++refused);
  }
  EXPECT_EQ(servo_.drive({.left_mps = 1, .right_mps = -1}, in_ms(20)), Status::ok);
}

TEST_F(QuickSilverDriveTest, BeforeOpenNothingIsThere) {
  WheelTravel travel;
  EXPECT_EQ(servo_.drive({}, in_ms(20)), Status::disconnected);
  EXPECT_EQ(servo_.read_travel(in_ms(20), travel), Status::disconnected);
  EXPECT_EQ(servo_.stop(in_ms(20)), Status::disconnected);
  expect_problem("not open");
  EXPECT_EQ(port_.opened, 0);
}

TEST_F(QuickSilverDriveTest, WhenTheLeftDriveIsSilentTheRightOneIsStopped) {
  open_it();
  silence("16");
  const Nanoseconds deadline = in_ms(20);
  EXPECT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, deadline), Status::timeout);
  expect_problem("drive 16: no reply to command 11");
  EXPECT_LE(clock_.now(), deadline);
  EXPECT_GE(count("timeouts"), 1U);
  EXPECT_EQ(registers_[17][30], 0);
  EXPECT_TRUE(was_sent("@17 11 30 0"));
  EXPECT_TRUE(was_sent("@16 11 30 0")) << "it may hear although it does not answer";
}

TEST_F(QuickSilverDriveTest, WhenTheRightDriveIsSilentTheLeftOneIsStopped) {
  open_it();
  silence("17");
  const Nanoseconds deadline = in_ms(20);
  EXPECT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, deadline), Status::timeout);
  EXPECT_LE(clock_.now(), deadline);
  EXPECT_EQ(registers_[16][30], 0);
  EXPECT_TRUE(was_sent("@17 11 30 0"));
}

TEST_F(QuickSilverDriveTest, ABusyDriveIsAskedOnceMore) {
  open_it();
  int busy = 1;
  override_answer = [&](const std::string& command) {
    if (command != "@16 11 30 268435456" || busy-- <= 0) return false;
    port_.say(nak(16, 11, 2), kMillisecond);
    return true;
  };
  EXPECT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20)), Status::ok) << servo_.problem();
  EXPECT_EQ(count("naks"), 1U);
  busy = 2;
  EXPECT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20)), Status::refused);
  expect_problem("drive 16: refused command 11: busy (2)");
  EXPECT_EQ(count("naks"), 3U);
}

TEST_F(QuickSilverDriveTest, OtherNaksAreRefusalsWithAName) {
  open_it();
  for (const auto& [code, name] : std::map<int, std::string>{{1, "bad command"},
                                                             {5, "bad format"},
                                                             {6, "buffer full"},
                                                             {7, "bad address"},
                                                             {8, "bad response"},
                                                             {9, "locked out"},
                                                             {10, "bad checksum"},
                                                             {44, "unknown (44)"}}) {
    override_answer = [&, code = code](const std::string& command) {
      if (!command.starts_with("@17 11 31")) return false;
      port_.say(nak(17, 11, code), kMillisecond);
      return true;
    };
    commands_.clear();
    EXPECT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(30)), Status::refused);
    expect_problem(name);
    EXPECT_EQ(commands_.size(), 6U) << "asked once, then both stopped";
    EXPECT_EQ(registers_[16][30], 0);
    EXPECT_EQ(registers_[17][30], 0);
  }
}

// ---- stop and close

TEST_F(QuickSilverDriveTest, StopIsTriedForEachDrive) {
  open_it();
  EXPECT_EQ(servo_.stop(in_ms(20)), Status::ok);
  EXPECT_EQ(commands_, kBothStopped);
  commands_.clear();
  silence("16");
  const Nanoseconds deadline = in_ms(20);
  EXPECT_EQ(servo_.stop(deadline), Status::timeout);
  expect_problem("drive 16");
  EXPECT_LE(clock_.now(), deadline);
  const std::vector<std::string> left_twice = {"@16 11 30 0", "@16 11 30 0", "@17 11 30 0"};
  EXPECT_EQ(commands_, left_twice);
}

TEST_F(QuickSilverDriveTest, ADriveThatWillNotBeStoppedByItsProgramIsHaltedAndSeenAnew) {
  open_it();
  override_answer = [&](const std::string& command) {
    if (command != "@16 11 30 0") return false;
    port_.say(nak(16, 11, 9), kMillisecond);
    return true;
  };
  EXPECT_EQ(servo_.stop(in_ms(20)), Status::ok);
  EXPECT_TRUE(was_sent("@16 2"));
  EXPECT_TRUE(was_sent("@17 11 30 0"));
  override_answer = nullptr;
  alive_ = false;  // HLT has ended it
  Status status = Status::timeout;
  for (int i = 0; i < 100 && status == Status::timeout; ++i) {
    status = servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20));
    clock_.advance(20 * kMillisecond);
  }
  EXPECT_EQ(status, Status::refused);
  EXPECT_FALSE(was_sent("@16 11 30 268435456"));
}

// HLT would end its program until somebody switches it off and on.
TEST_F(QuickSilverDriveTest, ADriveThatIsBusyIsNotHalted) {
  open_it();
  int busy = 4;
  override_answer = [&](const std::string& command) {
    if (command != "@16 11 30 0" || busy-- <= 0) return false;
    port_.say(nak(16, 11, 2), kMillisecond);
    return true;
  };
  EXPECT_EQ(servo_.stop(in_ms(40)), Status::ok) << servo_.problem();
  EXPECT_EQ(count("naks"), 4U);
  EXPECT_FALSE(was_sent("@16 2"));
  busy = 1000;
  const Nanoseconds deadline = in_ms(40);
  EXPECT_EQ(servo_.stop(deadline), Status::refused);
  expect_problem("busy");
  EXPECT_LE(clock_.now(), deadline);
  EXPECT_FALSE(was_sent("@16 2"));
  EXPECT_TRUE(was_sent("@17 11 30 0"));
  busy = 0;
  EXPECT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20)), Status::ok)
      << "its program was not ended";
  override_answer = nullptr;  // the rig's end comes after that of `busy`
}

TEST_F(QuickSilverDriveTest, CloseStopsBothAndLeavesThePort) {
  open_it();
  ASSERT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20)), Status::ok);
  commands_.clear();
  servo_.close();
  EXPECT_EQ(commands_, kBothStopped);
  EXPECT_FALSE(port_.is_open());
  servo_.close();
  EXPECT_EQ(commands_, kBothStopped);
  {
    QuickSilver other(settings_, port_, clock_);
    ASSERT_EQ(other.open(), Status::ok);
    commands_.clear();
  }
  EXPECT_EQ(commands_, kBothStopped) << "as does the end of its life";
}

// ---- travel

TEST_F(QuickSilverDriveTest, TravelIsCountedFromOpenForwardPositive) {
  registers_[16][1] = 1'000'000;
  registers_[17][1] = -500;
  open_it();
  WheelTravel travel;
  ASSERT_EQ(servo_.read_travel(in_ms(20), travel), Status::ok) << servo_.problem();
  EXPECT_EQ(travel.left_m, 0);
  EXPECT_EQ(travel.right_m, 0);
  EXPECT_TRUE(travel.measured);
  clock_.advance(kSecond);
  registers_[16][1] += 80'000;
  registers_[17][1] -= 40'000;
  const Nanoseconds begin = clock_.now();
  ASSERT_EQ(servo_.read_travel(in_ms(12), travel), Status::ok) << servo_.problem();
  EXPECT_NEAR(travel.left_m, 0.6, 1e-12);
  EXPECT_NEAR(travel.right_m, 0.3, 1e-12);
  EXPECT_GE(travel.time, begin);
  EXPECT_LE(travel.time, clock_.now());
}

// Each answer takes a millisecond here.
TEST_F(QuickSilverDriveTest, TravelIsStampedMidway) {
  open_it();
  WheelTravel travel;
  const Nanoseconds begin = clock_.now();
  ASSERT_EQ(servo_.read_travel(in_ms(20), travel), Status::ok);
  EXPECT_EQ(travel.time, begin + kMillisecond);
}

TEST_F(QuickSilverDriveTest, AnImpossiblePositionIsDoubtedOnce) {
  open_it();
  ASSERT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20)), Status::ok);
  WheelTravel travel;
  registers_[16][1] = 1 << 30;
  EXPECT_EQ(servo_.read_travel(in_ms(20), travel), Status::bad_data);
  expect_problem("drive 16: position 1073741824");
  EXPECT_EQ(count("position_jumps"), 0U);
  EXPECT_EQ(registers_[16][30], 268435456) << "one number is no reason to stop";
  registers_[16][1] = 0;
  EXPECT_EQ(servo_.read_travel(in_ms(20), travel), Status::ok);
}

}  // namespace
}  // namespace lakshya

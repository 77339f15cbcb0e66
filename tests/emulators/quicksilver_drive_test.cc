// The emulated drives against numbers worked out by hand from the manuals.
#include "tests/emulators/quicksilver_drive.h"

#include <gtest/gtest.h>

#include <string>

namespace lakshya::emulator {
namespace {

constexpr std::int64_t kMs = 1'000'000;

class QuickSilverDriveTest : public testing::Test {
 protected:
  void pass(std::int64_t ms) { now_ += ms * kMs; }

  // Lets 30 ms pass, which is enough for every reply.
  std::string ask(const std::string& command) {
    line_.hear(command + "\r", now_);
    pass(30);
    return line_.say(now_);
  }

  void set_up_program() {
    pass(20);
    ASSERT_EQ(ask("@16 11 29 38655"), "* 10\r");  // 10 rev/s^2
  }

  QuickSilverState state(std::size_t index = 0) { return line_.state(index, now_); }

  std::int64_t now_ = 5'000 * kMs;
  QuickSilverLine line_;
};

TEST_F(QuickSilverDriveTest, RepliesAreTheManuals) {
  line_.drive(0).set_position(329379);
  EXPECT_EQ(ask("@16 12 1"), "# 10 000C 0005 06A3\r");
  line_.drive(1).set_position(-2);
  EXPECT_EQ(ask("@17 12 1"), "# 11 000C FFFF FFFE\r");
  EXPECT_EQ(ask("@16 11 40 -5"), "* 10\r");
  EXPECT_EQ(ask("@16 12 40"), "# 10 000C FFFF FFFB\r");
  EXPECT_EQ(ask("@16 11 40 4294967295"), "* 10\r");
  EXPECT_EQ(line_.drive(0).value(40), -1);
  EXPECT_EQ(line_.drive(1).value(40), 0);
  EXPECT_EQ(ask("@16 0"), "* 10\r");
}

TEST_F(QuickSilverDriveTest, WrongCommandsGetTheManualsNaks) {
  EXPECT_EQ(ask("@16 250"), "! 10 00FA 0001\r");
  EXPECT_EQ(ask("@16 12"), "! 10 000C 0005\r");
  EXPECT_EQ(ask("@16 12 1 1"), "! 10 000C 0005\r");
  EXPECT_EQ(ask("@16 12 x"), "! 10 000C 0005\r");
  EXPECT_EQ(ask("@16 12 199"), "! 10 000C 0005\r");
  EXPECT_EQ(ask("@16 11 1 5"), "! 10 000B 0005\r");
  EXPECT_EQ(ask("@16 11 30 4294967296"), "! 10 000B 0005\r");
  EXPECT_EQ(ask("@16 15 0 1 0 0"), "! 10 000F 0005\r");
  EXPECT_EQ(ask("@16"), "! 10 0000 0005\r");
  EXPECT_EQ(ask("@16 11 30 " + std::string(80, '1')), "! 10 000B 0006\r");
  EXPECT_EQ(state().naks, 10);
  EXPECT_EQ(ask("@18 12 1"), "");
  EXPECT_EQ(ask("12 1"), "");
  EXPECT_EQ(ask("@x"), "");
  EXPECT_EQ(ask("@16 12 @17 0"), "* 11\r") << "a command begins at every @";
}

// 120 rpm are 2 rev/s: from rest at 10 rev/s^2 in 0.2 s, in which 0.2 rev are done.
TEST_F(QuickSilverDriveTest, VelocityModeRampsAndHolds) {
  line_.hear("@16 15 38655 64424509 0 0\r", now_);
  now_ += 26 * line_.character_ns;  // the whole command
  (void)line_.say(now_);
  pass(100);
  EXPECT_EQ(line_.say(now_), "* 10\r");
  EXPECT_NEAR(state().velocity_rpm, 60, 0.01);
  EXPECT_NEAR(state().position, 0.05 * 8000, 1);
  pass(100);
  EXPECT_NEAR(state().velocity_rpm, 120, 0.01);
  EXPECT_NEAR(state().position, 0.2 * 8000, 1);
  pass(10'000);
  EXPECT_NEAR(state().position, 20.2 * 8000, 2) << "and goes on without a host";
  EXPECT_EQ(ask("@16 3 0"), "* 10\r");
  pass(1000);
  EXPECT_EQ(state().velocity_rpm, 0);
  const double at_stop = state().position;
  pass(1000);
  EXPECT_EQ(state().position, at_stop);
  EXPECT_EQ(ask("@16 15 38655 -64424509 0 0"), "* 10\r");
  pass(1000);
  EXPECT_NEAR(state().velocity_rpm, -120, 0.01);
  EXPECT_EQ(ask("@16 2"), "* 10\r");
  EXPECT_EQ(state().velocity_rpm, 0);
}

TEST_F(QuickSilverDriveTest, TheProgramFollowsItsRegisterAndStopsAMotorWithoutHost) {
  set_up_program();
  EXPECT_EQ(ask("@16 12 33"), "# 10 000C 4C4B 5131\r");
  EXPECT_EQ(ask("@16 11 30 64424509"), "* 10\r");
  for (int i = 1; i <= 20; ++i) {
    ASSERT_EQ(ask("@16 11 31 " + std::to_string(i)), "* 10\r");
    pass(120);
  }
  EXPECT_NEAR(state().velocity_rpm, 120, 0.01);
  EXPECT_FALSE(state().tripped);
  pass(60);  // 210 ms since the counter's last step
  EXPECT_TRUE(state().tripped);
  EXPECT_EQ(line_.drive(0).value(30), 0);
  pass(200);  // 2 rev/s at 10 rev/s^2
  EXPECT_EQ(state().velocity_rpm, 0);
  EXPECT_EQ(state().trips, 1);
  EXPECT_EQ(ask("@16 11 31 0"), "* 10\r");
  EXPECT_FALSE(state().tripped);
}

TEST_F(QuickSilverDriveTest, AVelocityThatNobodyKeepsAliveDoesNotLast) {
  set_up_program();
  ASSERT_EQ(ask("@16 11 30 1"), "* 10\r");
  pass(190);  // 220 in all, in which the program looks at least 20 times
  EXPECT_TRUE(state().tripped);
  EXPECT_EQ(line_.drive(0).value(30), 0);
}

TEST_F(QuickSilverDriveTest, TheHeartbeatMovesOnceARoundAndStopsWithTheProgram) {
  pass(5);
  const std::int32_t before = (line_.say(now_), line_.drive(0).value(32));
  pass(1000);
  (void)line_.say(now_);
  EXPECT_EQ(line_.drive(0).value(32) - before, 100);
  for (const char* command : {"@16 2", "@16 3 0", "@16 15 38655 0 0 0"}) {
    line_.drive(0).restart();
    pass(50);
    EXPECT_TRUE(state().program_runs);
    EXPECT_EQ(ask(command), "* 10\r");
    EXPECT_FALSE(state().program_runs) << command;
    const std::int32_t last = line_.drive(0).value(32);
    pass(1000);
    (void)state();
    EXPECT_EQ(line_.drive(0).value(32), last);
    EXPECT_EQ(ask("@16 0"), "# 10 0000 2000\r");
    EXPECT_EQ(ask("@16 1 8192"), "* 10\r");
    EXPECT_EQ(ask("@16 0"), "* 10\r");
  }
}

TEST_F(QuickSilverDriveTest, WithoutAProgramTheRegistersAreOnlyRegisters) {
  QuickSilverLine line({16}, {.at_power_up = false});
  line.hear("@16 11 30 64424509\r", now_);
  pass(1000);
  EXPECT_EQ(line.say(now_), "* 10\r");
  EXPECT_EQ(line.state(0, now_).velocity_rpm, 0);
  EXPECT_EQ(line.drive(0).value(30), 64424509);
  EXPECT_EQ(line.drive(0).value(33), 0);
}

TEST_F(QuickSilverDriveTest, ThePositionWraps) {
  line_.drive(0).set_position(2147483647);
  EXPECT_EQ(ask("@16 12 1"), "# 10 000C 7FFF FFFF\r");
  line_.drive(0).set_position(2147483648);
  EXPECT_EQ(ask("@16 12 1"), "# 10 000C 8000 0000\r");
  EXPECT_EQ(state().position, 2147483648.0);
}

// 9 characters are 1.719 ms, the pause 0.5 ms, 5 characters 0.955 ms.
TEST_F(QuickSilverDriveTest, RepliesTakeTheLinesTime) {
  line_.hear("@16 11 40", now_);
  EXPECT_EQ(line_.say(now_ + 100 * kMs), "");
  line_ = QuickSilverLine({16});
  line_.hear("@16 1 0 \r", now_);
  EXPECT_EQ(line_.say(now_ + 2'400'000), "");
  EXPECT_EQ(line_.say(now_ + 2'610'000), "* ");
  EXPECT_EQ(line_.say(now_ + 3'160'000), "10");
  EXPECT_EQ(line_.say(now_ + 3'180'000), "\r");
}

TEST_F(QuickSilverDriveTest, Knobs) {
  line_.nak_every = 2;
  EXPECT_EQ(ask("@16 11 40 7"), "* 10\r");
  EXPECT_EQ(ask("@17 11 40 8"), "! 11 000B 0002\r");
  EXPECT_EQ(line_.drive(1).value(40), 0);
  line_.nak_every = 0;
  line_.silent_every = 3;
  EXPECT_EQ(ask("@16 11 40 9"), "");
  EXPECT_EQ(line_.drive(0).value(40), 9);
  line_.silent_every = 0;
  line_.silent_address = 17;
  EXPECT_EQ(ask("@17 11 40 8"), "");
  EXPECT_EQ(line_.drive(1).value(40), 0);
  line_.garbage_every = 1;
  const std::string damaged = ask("@16 0");
  EXPECT_EQ(damaged.substr(damaged.find('\r')), "\r* 10\r");
  line_.garbage_every = 0;
  line_.merge = true;
  EXPECT_EQ(ask("@16 0"), "* 10\r* 10\r");
  line_.merge = false;
  line_.checksum_errors = true;
  EXPECT_EQ(ask("@16 0"), "! 10 0000 000A\r");
}

TEST_F(QuickSilverDriveTest, SplitRepliesComeInTwoPieces) {
  line_.split = true;
  line_.hear("@16 1 0 \r", now_);
  EXPECT_EQ(line_.say(now_ + 3 * kMs), "* ");
  EXPECT_EQ(line_.say(now_ + 5 * kMs), "");
  EXPECT_EQ(line_.say(now_ + 7 * kMs), "10\r");
}

}  // namespace
}  // namespace lakshya::emulator

#include "hal/servo/quicksilver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/count_allocations.h"
#include "tests/support/fake_serial_port.h"
#include "tests/support/manual_clock.h"

namespace lakshya {
namespace {

// One turn of a wheel is 0.6 m and 10 turns of its motor: 0.5 m/s are 500 rpm, 268435456 units; 0.5 m/s^2 are 8.3333
// rev/s^2, 32212 units. 8000 counts are 0.06 m.
QuickSilverSettings settings_of_test() {
  const double radius = 0.3 / std::numbers::pi;
  QuickSilverSettings settings;
  settings.left = {.address = 16, .direction = 1, .radius_m = radius, .gear_ratio = 10};
  settings.right = {.address = 17, .direction = -1, .radius_m = radius, .gear_ratio = 10};
  return settings;
}

// What the other end of the line knows: registers, and a program that lives as long as it is allowed to.
class QuickSilverTest : public testing::Test {
 protected:
  using Numbers = std::vector<std::int64_t>;

  QuickSilverTest() {
    port_.answer = [this](const std::string& text) { hear(text); };
    for (auto& [address, registers] : registers_)
      registers = {{1, 0}, {30, 0}, {31, 0}, {32, 0}, {33, kQuickSilverSignature}};
  }

  Nanoseconds in_ms(int ms) const { return clock_.now() + ms * kMillisecond; }

  void hear(const std::string& text) {
    commands_.push_back(text.substr(0, text.size() - 1));
    if (override_answer && override_answer(commands_.back())) return;
    std::istringstream fields(text.substr(1));
    Numbers n;
    for (std::int64_t number = 0; fields >> number;)
      n.push_back(number);
    reply(n);
  }

  void reply(const Numbers& n) {
    const int address = static_cast<int>(n.at(0));
    if (n.at(1) != 12) {
      if (n.at(1) == 11) write(address, n);
      return port_.say(done(address), kMillisecond);
    }
    port_.say(data(address, read(address, static_cast<int>(n.at(2)))), kMillisecond);
  }

  void write(int address, const Numbers& n) {
    registers_[address][static_cast<int>(n.at(2))] = static_cast<std::int32_t>(n.at(3));
    written_at_[address] = clock_.now();
  }

  std::int32_t read(int address, int number) {
    if (number == 32 && alive_) return static_cast<std::int32_t>(clock_.now() / (10 * kMillisecond));
    if (number == 30 && acts_ && clock_.now() > written_at_[address] + 200 * kMillisecond) return 0;
    return registers_[address][number];
  }

  static std::string done(int address) { return text("* %02X\r", address); }
  static std::string data(int address, std::int32_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    return text("# %02X 000C %04X %04X\r", address, static_cast<int>(bits >> 16), static_cast<int>(bits & 0xFFFF));
  }
  static std::string nak(int address, int command, int code) {
    return text("! %02X %04X %04X\r", address, command, code);
  }
  static std::string text(const char* format, int a, int b = 0, int c = 0) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, a, b, c);
    return buffer;
  }

  void open_it() {
    ASSERT_EQ(servo_.open(), Status::ok) << servo_.problem();
    commands_.clear();
  }

  std::uint64_t count(const std::string& name) const {
    for (const Counter& counter : servo_.counters()) {
      if (counter.name == name) return counter.value;
    }
    ADD_FAILURE() << "no counter " << name;
    return 0;
  }

  void expect_problem(const std::string& part) const {
    EXPECT_NE(std::string(servo_.problem()).find(part), std::string::npos) << servo_.problem();
  }

  bool was_sent(const std::string& command) const {
    return std::find(commands_.begin(), commands_.end(), command) != commands_.end();
  }

  // Nothing but the port's answer for this drive.
  void silence(const std::string& address) {
    override_answer = [address](const std::string& command) { return command.starts_with("@" + address + " "); };
  }

  ManualClock clock_;
  FakeSerialPort port_{clock_};
  std::map<int, std::map<int, std::int32_t>> registers_{{16, {}}, {17, {}}};
  std::map<int, Nanoseconds> written_at_;
  bool alive_ = true;
  bool acts_ = true;
  std::vector<std::string> commands_;
  std::function<bool(const std::string& command)> override_answer;  // true: has answered
  QuickSilverSettings settings_ = settings_of_test();
  QuickSilver servo_{settings_, port_, clock_};
};

const std::vector<std::string> kBothStopped = {"@16 11 30 0", "@17 11 30 0"};

// ---- open

TEST_F(QuickSilverTest, OpenSetsUpAndSeesTheProgramsAct) {
  const Nanoseconds begin = clock_.now();
  ASSERT_EQ(servo_.open(), Status::ok) << servo_.problem();
  const std::vector<std::string> expected = {
      "@16 11 30 0",     "@17 11 30 0",     "@16 12 1",  "@17 12 1",  "@16 12 33", "@17 12 33",
      "@16 11 29 32212", "@17 11 29 32212", "@16 12 29", "@17 12 29", "@16 12 32", "@17 12 32",
      "@16 11 30 1",     "@17 11 30 1",     "@16 12 32", "@17 12 32", "@16 12 30", "@17 12 30"};
  EXPECT_EQ(commands_, expected);
  EXPECT_GE(clock_.now() - begin, 300 * kMillisecond);
  EXPECT_LE(clock_.now() - begin, 400 * kMillisecond);
  EXPECT_TRUE(servo_.is_supervised());
  EXPECT_EQ(servo_.max_speed_mps(), 1.0);
}

TEST_F(QuickSilverTest, WithoutItsSignatureAProgramIsNotBelieved) {
  registers_[17][33] = 0;
  EXPECT_EQ(servo_.open(), Status::refused);
  expect_problem("drive 17: no resident program: signature register 33 holds 0");
  EXPECT_FALSE(port_.is_open());
  EXPECT_EQ(count("dead_programs"), 1U);
  EXPECT_FALSE(was_sent("@17 11 30 1"));
}

TEST_F(QuickSilverTest, AHeartbeatThatStandsStillIsNotBelieved) {
  alive_ = false;
  EXPECT_EQ(servo_.open(), Status::refused);
  expect_problem("drive 16: resident program: its heartbeat stands still");
}

TEST_F(QuickSilverTest, AProgramThatDoesNotZeroTheVelocityIsNotBelieved) {
  acts_ = false;
  EXPECT_EQ(servo_.open(), Status::refused);
  expect_problem("drive 16: resident program: it does not zero");
  EXPECT_EQ(registers_[16][30], 0) << "close() stops";
}

TEST_F(QuickSilverTest, ARegisterThatDoesNotHoldItsValueIsNotBelieved) {
  override_answer = [&](const std::string& command) {
    if (command != "@16 12 29") return false;
    port_.say(data(16, 5), kMillisecond);
    return true;
  };
  EXPECT_EQ(servo_.open(), Status::refused);
  expect_problem("register 29 holds 5 instead of the acceleration 32212");
}

TEST_F(QuickSilverTest, ADriveThatIsNotThereEndsOpen) {
  silence("17");
  const Nanoseconds begin = clock_.now();
  EXPECT_EQ(servo_.open(), Status::timeout);
  expect_problem("drive 17: no reply");
  EXPECT_LE(clock_.now() - begin, 2 * kSecond);
  EXPECT_FALSE(port_.is_open());
}

TEST_F(QuickSilverTest, APortThatIsNotThereEndsOpen) {
  port_.unplugged = true;
  EXPECT_EQ(servo_.open(), Status::disconnected);
  expect_problem("not there");
}

TEST_F(QuickSilverTest, OpenSurvivesALostReply) {
  int lost = 0;
  override_answer = [&](const std::string& command) { return command == "@17 12 33" && lost++ == 0; };
  EXPECT_EQ(servo_.open(), Status::ok) << servo_.problem();
  EXPECT_EQ(count("timeouts"), 1U);
}

TEST_F(QuickSilverTest, ImpossibleSettingsAreRefused) {
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
      {"v_unsupervised_mps", [](auto& s) { s.v_unsupervised_mps = 0; }},
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
    QuickSilverSettings settings = settings_of_test();
    change(settings);
    QuickSilver servo(settings, port_, clock_);
    EXPECT_EQ(servo.open(), Status::bad_argument) << what;
    EXPECT_NE(std::string(servo.problem()).find(what), std::string::npos) << what << ": " << servo.problem();
  }
  EXPECT_EQ(port_.opened, 0);
}

// ---- drive

TEST_F(QuickSilverTest, DriveWritesBothVelocitiesThenBothCounters) {
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

TEST_F(QuickSilverTest, TheCounterMovesWithEveryCall) {
  open_it();
  std::int32_t before = registers_[16][31];
  for (int i = 0; i < 25; ++i) {
    ASSERT_EQ(servo_.drive({}, in_ms(20)), Status::ok);
    EXPECT_NE(registers_[16][31], before);
    before = registers_[16][31];
    EXPECT_LE(before, 9) << "one digit: the line is slow";
  }
}

TEST_F(QuickSilverTest, WhatIsNoSpeedIsRefusedAndStopsTheWheels) {
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

TEST_F(QuickSilverTest, BeforeOpenNothingIsThere) {
  WheelTravel travel;
  EXPECT_EQ(servo_.drive({}, in_ms(20)), Status::disconnected);
  EXPECT_EQ(servo_.read_travel(in_ms(20), travel), Status::disconnected);
  EXPECT_EQ(servo_.stop(in_ms(20)), Status::disconnected);
  expect_problem("not open");
  EXPECT_EQ(port_.opened, 0);
}

TEST_F(QuickSilverTest, WhenTheLeftDriveIsSilentTheRightOneIsStopped) {
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

TEST_F(QuickSilverTest, WhenTheRightDriveIsSilentTheLeftOneIsStopped) {
  open_it();
  silence("17");
  const Nanoseconds deadline = in_ms(20);
  EXPECT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, deadline), Status::timeout);
  EXPECT_LE(clock_.now(), deadline);
  EXPECT_EQ(registers_[16][30], 0);
  EXPECT_TRUE(was_sent("@17 11 30 0"));
}

TEST_F(QuickSilverTest, ABusyDriveIsAskedOnceMore) {
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

TEST_F(QuickSilverTest, OtherNaksAreRefusalsWithAName) {
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

TEST_F(QuickSilverTest, StopIsTriedForEachDrive) {
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

TEST_F(QuickSilverTest, ADriveThatWillNotBeStoppedByItsProgramIsHaltedAndSeenAnew) {
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

TEST_F(QuickSilverTest, CloseStopsBothAndLeavesThePort) {
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

TEST_F(QuickSilverTest, TravelIsCountedFromOpenForwardPositive) {
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
TEST_F(QuickSilverTest, TravelIsStampedMidway) {
  open_it();
  WheelTravel travel;
  const Nanoseconds begin = clock_.now();
  ASSERT_EQ(servo_.read_travel(in_ms(20), travel), Status::ok);
  EXPECT_EQ(travel.time, begin + kMillisecond);
}

TEST_F(QuickSilverTest, AnImpossiblePositionIsDoubtedOnce) {
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

TEST_F(QuickSilverTest, ADriveThatStartedAnewIsStoppedAndSetUpAgain) {
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

TEST_F(QuickSilverTest, AHeartbeatThatGoesBackIsADriveThatStartedAnew) {
  open_it();
  clock_.advance(2 * kSecond);
  alive_ = false;
  registers_[16][32] = 3;
  WheelTravel travel;
  EXPECT_EQ(servo_.read_travel(in_ms(20), travel), Status::refused);
  expect_problem("drive 16: resident program: it has started anew");
}

TEST_F(QuickSilverTest, ALateReplyIsNotTakenForTheNextOne) {
  open_it();
  clock_.advance(kSecond);
  WheelTravel travel;
  ASSERT_EQ(servo_.read_travel(in_ms(12), travel), Status::ok);
  registers_[16][1] = 800;
  override_answer = [&](const std::string& command) {
    if (command != "@16 12 1") return false;
    port_.say(data(16, 800), 30 * kMillisecond);
    return true;
  };
  EXPECT_EQ(servo_.read_travel(in_ms(10), travel), Status::timeout);
  override_answer = nullptr;
  registers_[16][1] = 8000;
  const Nanoseconds early = in_ms(10);
  EXPECT_EQ(servo_.read_travel(early, travel), Status::timeout) << "the late reply has not come yet";
  EXPECT_LE(clock_.now(), early);
  EXPECT_EQ(servo_.read_travel(in_ms(30), travel), Status::ok) << servo_.problem();
  EXPECT_NEAR(travel.left_m, 0.06, 1e-12) << "800 counts would be 0.006";
}

TEST_F(QuickSilverTest, AReplyThatNeverComesIsNotWaitedForForever) {
  open_it();
  silence("16");
  WheelTravel travel;
  EXPECT_EQ(servo_.read_travel(in_ms(10), travel), Status::timeout);
  override_answer = nullptr;
  EXPECT_EQ(servo_.read_travel(in_ms(60), travel), Status::ok) << servo_.problem();
}

TEST_F(QuickSilverTest, RepliesOfTheOtherDriveAreNotTaken) {
  open_it();
  override_answer = [&](const std::string& command) {
    if (command == "@16 12 1") port_.say(data(17, 4000), kMillisecond / 2);
    return false;
  };
  WheelTravel travel;
  EXPECT_EQ(servo_.read_travel(in_ms(20), travel), Status::ok);
  EXPECT_EQ(travel.left_m, 0);
  EXPECT_EQ(count("wrong_address"), 1U);
}

TEST_F(QuickSilverTest, GarbageBeforeAReplyIsSkippedAndCounted) {
  open_it();
  override_answer = [&](const std::string& command) {
    if (command == "@16 12 1")
      port_.say(std::string(200, 'x') + "\r\r* 10\r# 10 000B 0001 0002\r#", kMillisecond / 2);
    if (command == "@17 12 1") port_.say("\x01\xff ?\r", kMillisecond / 2);
    return false;
  };
  WheelTravel travel;
  // The lone '#' spoils the reply that follows it.
  EXPECT_EQ(servo_.read_travel(in_ms(40), travel), Status::bad_data);
  expect_problem("drive 16: no readable reply to command 12");
  override_answer = [&](const std::string& command) {
    if (command == "@17 12 1") port_.say("\x01\xff ?\r", kMillisecond / 2);
    return false;
  };
  EXPECT_EQ(servo_.read_travel(in_ms(80), travel), Status::ok) << servo_.problem();
  EXPECT_EQ(count("bad_replies"), 6U);
}

// A port that has bytes at once whenever it is asked, also when the deadline has passed.
class ChatteringPort final : public SerialPort {
 public:
  explicit ChatteringPort(ManualClock& clock) : clock_(&clock) {}
  Status open() override {
    is_open_ = true;
    return Status::ok;
  }
  void close() override { is_open_ = false; }
  std::span<const Counter> counters() const override { return {}; }
  bool is_open() const override { return is_open_; }
  Status read(std::span<std::uint8_t> buffer, Nanoseconds, std::size_t& count) override {
    if (++reads > 100'000) return Status::disconnected;
    clock_->advance(kMillisecond / 10);
    count = 1;
    buffer[0] = reads % 5 == 0 ? '\r' : 'x';
    return Status::ok;
  }
  Status write(std::span<const std::uint8_t>, Nanoseconds) override { return Status::ok; }
  void discard_input() override {}

  int reads = 0;

 private:
  ManualClock* clock_;
  bool is_open_ = false;
};

TEST_F(QuickSilverTest, ALineThatNeverFallsSilentDoesNotHoldTheDriver) {
  ChatteringPort port(clock_);
  QuickSilver servo(settings_, port, clock_);
  const Nanoseconds begin = clock_.now();
  EXPECT_EQ(servo.open(), Status::bad_data);
  EXPECT_LE(clock_.now() - begin, 2 * kSecond);
  EXPECT_LE(port.reads, 20'000);
}

TEST_F(QuickSilverTest, RepliesInPiecesAndTwoInOne) {
  open_it();
  override_answer = [&](const std::string& command) {
    if (command == "@16 12 1") {
      port_.say("# 10 0", kMillisecond);
      port_.say("00C 0000 1F4", 2 * kMillisecond);
      port_.say("0\r", 3 * kMillisecond);
      return true;
    }
    if (command != "@17 12 1") return false;
    port_.say(done(16) + data(17, -8000) + data(17, -8000), kMillisecond);
    return true;
  };
  WheelTravel travel;
  clock_.advance(kSecond);
  ASSERT_EQ(servo_.read_travel(in_ms(12), travel), Status::ok) << servo_.problem();
  EXPECT_NEAR(travel.left_m, 0.06, 1e-12);
  EXPECT_NEAR(travel.right_m, 0.06, 1e-12);
}

TEST_F(QuickSilverTest, AnAdapterThatEchoesIsNoFault) {
  open_it();
  override_answer = [&](const std::string& command) {
    port_.say(command + "\r");
    return false;
  };
  EXPECT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20)), Status::ok) << servo_.problem();
  EXPECT_EQ(count("bad_replies"), 0U);
}

TEST_F(QuickSilverTest, ARegisterOfOneWordIsBadData) {
  open_it();
  override_answer = [&](const std::string& command) {
    if (command != "@16 12 1") return false;
    port_.say("# 10 000C 0005\r", kMillisecond);
    return true;
  };
  WheelTravel travel;
  EXPECT_EQ(servo_.read_travel(in_ms(20), travel), Status::bad_data);
  expect_problem("register 1 came as 1 words");
}

TEST_F(QuickSilverTest, APortThatTakesNothingEndsAtTheDeadline) {
  open_it();
  port_.stuck = true;
  const Nanoseconds deadline = in_ms(20);
  EXPECT_EQ(servo_.drive({}, deadline), Status::timeout);
  EXPECT_LE(clock_.now(), deadline);
}

// ---- the program later on

TEST_F(QuickSilverTest, AProgramThatDiesLaterIsNoticedAndTheWheelsAreStopped) {
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

TEST_F(QuickSilverTest, AHeartbeatThatCannotBeReadIsNoHeartbeat) {
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

TEST_F(QuickSilverTest, APulledPlugIsLookedForEvery200MsAndTheDrivesAreSetUpAgain) {
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

TEST_F(QuickSilverTest, AStopDuringTheTrialIsNotTakenForTheProgramsDoing) {
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
TEST_F(QuickSilverTest, StoppingAfterEveryFailureDoesNotHinderSettingUp) {
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

// ---- without resident programs

class QuickSilverUnsupervisedTest : public QuickSilverTest {
 protected:
  QuickSilverUnsupervisedTest() { registers_ = {{16, {}}, {17, {}}}; }

  static QuickSilverSettings unsupervised() {
    QuickSilverSettings settings = settings_of_test();
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

// ---- memory

// A port that answers everything and takes no memory itself.
class QuickSilverMemoryTest : public testing::Test {
 protected:
  class Port final : public SerialPort {
   public:
    explicit Port(ManualClock& clock) : clock_(&clock) {}
    Status open() override { return Status::ok; }
    void close() override {}
    std::span<const Counter> counters() const override { return {}; }
    bool is_open() const override { return true; }
    Status read(std::span<std::uint8_t> buffer, Nanoseconds deadline, std::size_t& count) override {
      count = static_cast<std::size_t>(size_);
      if (count == 0) clock_->sleep_until(deadline);
      if (count == 0) return Status::timeout;
      clock_->advance(kMillisecond);
      std::copy_n(reply_, count, buffer.begin());
      size_ = 0;
      return Status::ok;
    }
    Status write(std::span<const std::uint8_t> bytes, Nanoseconds) override {
      char text[64] = {};
      std::copy(bytes.begin(), bytes.end(), text);
      int address = 0;
      int command = 0;
      int number = 0;
      (void)std::sscanf(text, "@%d %d %d", &address, &command, &number);
      const auto heartbeat = static_cast<unsigned>(clock_->now() / (10 * kMillisecond)) & 0xFFFF;
      size_ = std::snprintf(reply_, sizeof reply_, "* %02X\r", static_cast<unsigned>(address));
      if (command != 12) return Status::ok;
      const unsigned low = number == 33 ? 0x5131 : number == 32 ? heartbeat : number == 29 ? 32212 : 0;
      size_ = std::snprintf(reply_, sizeof reply_, "# %02X 000C %04X %04X\r", static_cast<unsigned>(address),
                            number == 33 ? 0x4C4BU : 0U, low);
      return Status::ok;
    }
    void discard_input() override { size_ = 0; }

   private:
    ManualClock* clock_;
    char reply_[64] = {};
    int size_ = 0;
  };

  ManualClock clock_;
  Port port_{clock_};
};

TEST_F(QuickSilverMemoryTest, NothingIsAllocatedAfterOpen) {
  QuickSilver servo(settings_of_test(), port_, clock_);
  ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
  WheelTravel travel;
  const int before = test::allocations;
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(servo.drive({.left_mps = 0.5, .right_mps = -0.5}, clock_.now() + 20 * kMillisecond), Status::ok);
    EXPECT_EQ(servo.read_travel(clock_.now() + 20 * kMillisecond, travel), Status::ok);
  }
  EXPECT_EQ(servo.stop(clock_.now() + 20 * kMillisecond), Status::ok);
  EXPECT_EQ(servo.drive({.left_mps = 9, .right_mps = 0}, clock_.now() + 20 * kMillisecond), Status::refused);
  servo.close();
  EXPECT_EQ(test::allocations, before);
}

}  // namespace
}  // namespace lakshya

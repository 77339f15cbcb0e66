// QuickSilver: replies that come late, in pieces, damaged, or not at all.
#include <gtest/gtest.h>

#include <string>

#include "hal/serial_port.h"
#include "tests/support/quicksilver_rig.h"

namespace lakshya {
namespace {

using QuickSilverLineTest = test::QuickSilverRig;

TEST_F(QuickSilverLineTest, ALateReplyIsNotTakenForTheNextOne) {
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

TEST_F(QuickSilverLineTest, AReplyThatNeverComesIsNotWaitedForForever) {
  open_it();
  silence("16");
  WheelTravel travel;
  EXPECT_EQ(servo_.read_travel(in_ms(10), travel), Status::timeout);
  override_answer = nullptr;
  EXPECT_EQ(servo_.read_travel(in_ms(110), travel), Status::ok) << servo_.problem();
}

// 0.05 s is the configuration's default.
TEST_F(QuickSilverLineTest, AnyTimesKeepALateReplyOut) {
  for (const double answer_s : {0.005, 0.05, 0.5}) {
    QuickSilverSettings settings = test::quicksilver_settings();
    settings.answer_timeout_s = answer_s;
    QuickSilver servo(settings, port_, clock_);
    ASSERT_EQ(servo.open(), Status::ok) << servo.problem();
    WheelTravel travel;
    ASSERT_EQ(servo.read_travel(in_ms(20), travel), Status::ok) << servo.problem();
    registers_[16][1] += 800;
    bool asked = false;
    override_answer = [&](const std::string& command) {
      if (command != "@16 12 1" || asked) return false;
      asked = true;
      port_.say(data(16, registers_[16][1]), as_nanoseconds(answer_s) + 40 * kMillisecond);
      return true;
    };
    EXPECT_EQ(servo.read_travel(in_ms(1) + as_nanoseconds(answer_s), travel), Status::timeout);
    registers_[16][1] += 80;
    ASSERT_EQ(servo.read_travel(in_ms(100), travel), Status::ok) << servo.problem();
    EXPECT_NEAR(travel.left_m, 0.0066, 1e-12) << "0.006 is what was true when it was given up";
    override_answer = nullptr;
    registers_[16][1] = 0;
  }
}

TEST_F(QuickSilverLineTest, RepliesOfTheOtherDriveAreNotTaken) {
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

TEST_F(QuickSilverLineTest, GarbageBeforeAReplyIsSkippedAndCounted) {
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

TEST_F(QuickSilverLineTest, ALineThatNeverFallsSilentDoesNotHoldTheDriver) {
  ChatteringPort port(clock_);
  QuickSilver servo(settings_, port, clock_);
  const Nanoseconds begin = clock_.now();
  EXPECT_EQ(servo.open(), Status::bad_data);
  EXPECT_LE(clock_.now() - begin, 2 * kSecond);
  EXPECT_LE(port.reads, 20'000);
}

TEST_F(QuickSilverLineTest, RepliesInPiecesAndTwoInOne) {
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

TEST_F(QuickSilverLineTest, AnAdapterThatEchoesIsNoFault) {
  open_it();
  override_answer = [&](const std::string& command) {
    port_.say(command + "\r");
    return false;
  };
  EXPECT_EQ(servo_.drive({.left_mps = 0.5, .right_mps = 0.5}, in_ms(20)), Status::ok) << servo_.problem();
  EXPECT_EQ(count("bad_replies"), 0U);
}

TEST_F(QuickSilverLineTest, ARegisterOfOneWordIsBadData) {
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

TEST_F(QuickSilverLineTest, APortThatTakesNothingEndsAtTheDeadline) {
  open_it();
  port_.stuck = true;
  const Nanoseconds deadline = in_ms(20);
  EXPECT_EQ(servo_.drive({}, deadline), Status::timeout);
  EXPECT_LE(clock_.now(), deadline);
}

}  // namespace
}  // namespace lakshya

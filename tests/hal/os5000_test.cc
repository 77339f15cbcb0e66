#include "hal/compass/os5000.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/emulators/os5000_device.h"
#include "tests/support/count_allocations.h"
#include "tests/support/fake_serial_port.h"

namespace lakshya {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::string line(const std::string& content) {
  unsigned sum = 0;
  for (const char c : content)
    sum ^= static_cast<unsigned char>(c);
  char end[8];
  std::snprintf(end, sizeof end, "*%02X\r\n", sum);
  return "$" + content + end;
}

// A port that allocates nothing, unlike the fake: it repeats one piece.
struct RepeatingPort final : SerialPort {
  ManualClock& clock;
  std::string_view text;
  int pieces_until_gone = 1000;
  bool there = false;

  explicit RepeatingPort(ManualClock& c) : clock(c) {}
  Status open() override {
    there = pieces_until_gone > 0;
    return there ? Status::ok : Status::disconnected;
  }
  void close() override { there = false; }
  std::span<const Counter> counters() const override { return {}; }
  bool is_open() const override { return there; }
  Status read(std::span<std::uint8_t> buffer, Nanoseconds deadline, std::size_t& size) override {
    size = 0;
    if (pieces_until_gone-- <= 0) return Status::disconnected;
    clock.sleep_until(deadline);
    size = text.copy(reinterpret_cast<char*>(buffer.data()), buffer.size());
    return Status::ok;
  }
  Status write(std::span<const std::uint8_t> /*bytes*/, Nanoseconds /*deadline*/) override { return Status::ok; }
  void discard_input() override {}
};

class Os5000Test : public testing::Test {
 protected:
  Nanoseconds in_ms(int ms) const { return clock_.now() + ms * kMillisecond; }

  // Opens; the device's first sentence comes when the commands (0.9 s) have been sent.
  void open(Os5000& compass) {
    port_.say(line("C0.0"), 950 * kMillisecond);
    ASSERT_EQ(compass.open(), Status::ok) << compass.problem();
  }

  Status read(Os5000& compass, int ms) { return compass.read(in_ms(ms), sample_); }

  static std::uint64_t count(const Os5000& compass, const std::string& name) {
    for (const Counter& counter : compass.counters()) {
      if (name == counter.name) return counter.value;
    }
    ADD_FAILURE() << "no counter " << name;
    return 0;
  }

  static bool says(const Os5000& compass, const std::string& words) {
    return std::string(compass.problem()).find(words) != std::string::npos;
  }

  ManualClock clock_;
  FakeSerialPort port_{clock_};
  Os5000 compass_{{}, port_, clock_};
  HeadingSample sample_;
};

TEST_F(Os5000Test, OpenSetsRateAndContentCharacterByCharacter) {
  std::vector<Nanoseconds> times;
  port_.answer = [&](const std::string& written) {
    EXPECT_EQ(written.size(), 1U);
    times.push_back(clock_.now());
  };
  const Nanoseconds start = clock_.now();
  open(compass_);
  EXPECT_EQ(port_.written, "\x1bR10\r\x1bX7\r");
  ASSERT_EQ(times.size(), 9U);
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_EQ(times[i] - start, static_cast<Nanoseconds>(i) * 100 * kMillisecond);
  EXPECT_EQ(clock_.now() - start, 950 * kMillisecond);
}

TEST_F(Os5000Test, ADeviceThatIsDeafToFastTypingObeys) {
  emulator::Os5000Device device;
  device.deaf_ms = 100;
  port_.answer = [&](const std::string& written) { device.hear(written, clock_.now()); };
  open(compass_);
  EXPECT_EQ(device.characters_lost, 0);
  EXPECT_EQ(device.commands_obeyed, 2);
  EXPECT_EQ(device.rate_hz, 10);
  EXPECT_EQ(device.fields, 7);
}

TEST_F(Os5000Test, CommandsMayEndWithASpaceOrNotBeSent) {
  Os5000 spaced({.commands_end_with_space = true, .rate_hz = 5}, port_, clock_);
  open(spaced);
  EXPECT_EQ(port_.written, "\x1bR5 \x1bX7 ");
  port_.written.clear();
  Os5000 quiet({.set_up = false}, port_, clock_);
  open(quiet);
  EXPECT_EQ(port_.written, "");
}

TEST_F(Os5000Test, GivesYawPitchAndRoll) {
  open(compass_);
  port_.say(line("C320.5P0.2R-18.3T19.0"), 30 * kMillisecond);
  ASSERT_EQ(read(compass_, 200), Status::ok) << compass_.problem();
  EXPECT_NEAR(sample_.yaw, (90 - 320.5 + 360) * kDegree, 1e-12);
  EXPECT_NEAR(sample_.pitch, 0.2 * kDegree, 1e-12);
  EXPECT_NEAR(sample_.roll, -18.3 * kDegree, 1e-12);
  port_.say(line("C270.0"));
  ASSERT_EQ(read(compass_, 200), Status::ok);
  EXPECT_NEAR(sample_.yaw, std::numbers::pi, 1e-12) << "west is pi, not -pi";
  EXPECT_TRUE(std::isnan(sample_.pitch));
  EXPECT_TRUE(std::isnan(sample_.roll));
}

TEST_F(Os5000Test, AddsTheDeclinationToMagneticHeadingsOnly) {
  Os5000 compass({.declination_deg = 10, .pitch_sign = -1, .roll_sign = -1}, port_, clock_);
  open(compass);
  port_.say(line("OHPR,50.0,1.0,2.0,20.0"));
  ASSERT_EQ(read(compass, 100), Status::ok);
  EXPECT_NEAR(sample_.yaw, 30 * kDegree, 1e-12);
  EXPECT_NEAR(sample_.pitch, -1 * kDegree, 1e-12);
  EXPECT_NEAR(sample_.roll, -2 * kDegree, 1e-12);
  port_.say(line("HCHDT,50.0,T"));
  ASSERT_EQ(read(compass, 100), Status::ok);
  EXPECT_NEAR(sample_.yaw, 40 * kDegree, 1e-12);
}

// A device that looks to the vehicle's left: its nose is the vehicle's left side, its right side the vehicle's nose.
TEST_F(Os5000Test, TakesTheMountingOff) {
  Os5000 compass({.mounting_deg = 90}, port_, clock_);
  open(compass);
  port_.say(line("C0.0P5.0R-7.0"));  // it looks north, so the vehicle looks east
  ASSERT_EQ(read(compass, 100), Status::ok);
  EXPECT_NEAR(sample_.pitch, std::asin(std::cos(5 * kDegree) * std::sin(7 * kDegree)),
              1e-12);  // its right side is up
  EXPECT_NEAR(sample_.roll, 5 * kDegree, 0.1 * kDegree);
  EXPECT_NEAR(sample_.yaw, 0, 0.7 * kDegree);
  port_.say(line("C0.0"));
  ASSERT_EQ(read(compass, 100), Status::ok);
  EXPECT_NEAR(sample_.yaw, 0, 1e-12);
  EXPECT_TRUE(std::isnan(sample_.pitch));
}

TEST_F(Os5000Test, TheTimeIsWhenTheFirstByteBeganToBeSent) {
  open(compass_);
  const std::string text = line("C1.0");
  // Two pieces: the first byte is the last but two of the first piece.
  const Nanoseconds came = in_ms(20);
  port_.say("noise" + text.substr(0, 3), 20 * kMillisecond);
  port_.say(text.substr(3), 50 * kMillisecond);
  ASSERT_EQ(read(compass_, 100), Status::ok);
  EXPECT_EQ(sample_.time, came - 30 * kSecond / 19200);
  EXPECT_EQ(clock_.now(), came + 30 * kMillisecond);
}

TEST_F(Os5000Test, TimeNeverStepsBack) {
  open(compass_);
  port_.say(line("C1.0"), 20 * kMillisecond);
  ASSERT_EQ(read(compass_, 100), Status::ok);
  const Nanoseconds first = sample_.time;
  port_.say(line("C2.0") + std::string(100, 'x'));
  ASSERT_EQ(read(compass_, 100), Status::ok);
  EXPECT_EQ(sample_.time, first);
}

TEST_F(Os5000Test, GivesTheNewestOfSeveralAndEachOnce) {
  open(compass_);
  port_.say(line("C1.0") + line("C2.0"));
  port_.say(line("C3.0") + "$C4");
  port_.say(".0*69\r\n", 300 * kMillisecond);
  ASSERT_EQ(read(compass_, 100), Status::ok);
  EXPECT_NEAR(sample_.yaw, 87 * kDegree, 1e-12);
  const Nanoseconds deadline = in_ms(100);
  EXPECT_EQ(read(compass_, 100), Status::timeout) << "the third was given already, the fourth is not whole";
  EXPECT_EQ(clock_.now(), deadline);
  ASSERT_EQ(read(compass_, 300), Status::ok);
  EXPECT_NEAR(sample_.yaw, 86 * kDegree, 1e-12);
}

TEST_F(Os5000Test, WhatIsWaitingIsTakenThoughTheDeadlineHasPassed) {
  open(compass_);
  port_.say(line("C1.0"));
  const Nanoseconds now = clock_.now();
  ASSERT_EQ(compass_.read(now - kSecond, sample_), Status::ok);
  EXPECT_EQ(compass_.read(now - kSecond, sample_), Status::timeout);
  EXPECT_EQ(clock_.now(), now);
}

// A terminal that is full keeps what came first.
TEST_F(Os5000Test, AfterALongPauseWhatWaitedIsForgotten) {
  open(compass_);
  port_.say(line("C1.0") + line("C2.0") + "$C3");
  clock_.advance(30 * kSecond);
  EXPECT_EQ(compass_.read(clock_.now(), sample_), Status::timeout);
  port_.say("59.0*00\r\n" + line("C4.0"), 80 * kMillisecond);
  const Nanoseconds came = in_ms(80);
  ASSERT_EQ(read(compass_, 200), Status::ok) << compass_.problem();
  EXPECT_NEAR(sample_.yaw, 86 * kDegree, 1e-12);
  EXPECT_GT(sample_.time, came - 20 * kMillisecond);
  EXPECT_EQ(count(compass_, "bad_checksums"), 0U) << "joined to a half from before the pause";
}

TEST_F(Os5000Test, APauseOfASecondForgetsNothingNorDoesALongWait) {
  open(compass_);
  port_.say(line("C1.0"));
  clock_.advance(kSecond);
  ASSERT_EQ(compass_.read(clock_.now(), sample_), Status::ok);
  EXPECT_NEAR(sample_.yaw, 89 * kDegree, 1e-12);
  EXPECT_EQ(read(compass_, 3000), Status::timeout);
  port_.say(line("C2.0"));
  ASSERT_EQ(compass_.read(clock_.now(), sample_), Status::ok) << "the port was listened to all the time";
  EXPECT_NEAR(sample_.yaw, 88 * kDegree, 1e-12);
}

TEST_F(Os5000Test, SilenceIsATimeoutAtTheDeadline) {
  open(compass_);
  const Nanoseconds deadline = in_ms(70);
  EXPECT_EQ(compass_.read(deadline, sample_), Status::timeout);
  EXPECT_EQ(clock_.now(), deadline);
  EXPECT_EQ(count(compass_, "timeouts"), 1U);
  EXPECT_TRUE(says(compass_, "no sentence came")) << compass_.problem();
}

TEST_F(Os5000Test, DamagedSentencesAreCountedAndWaitedOver) {
  open(compass_);
  port_.say("$C1.0*00\r\n");
  port_.say(line("P1.0"), 10 * kMillisecond);
  port_.say("$C1.0P$C1", 20 * kMillisecond);
  port_.say(std::string(300, 'x'), 30 * kMillisecond);
  const Nanoseconds deadline = in_ms(60);
  EXPECT_EQ(compass_.read(deadline, sample_), Status::bad_data);
  EXPECT_EQ(clock_.now(), deadline);
  EXPECT_EQ(count(compass_, "bad_checksums"), 1U);
  EXPECT_EQ(count(compass_, "bad_sentences"), 3U);
  EXPECT_EQ(count(compass_, "timeouts"), 0U);
  EXPECT_TRUE(says(compass_, "no sentence that can be used"));
  port_.say("$C1.0*00\r\n");
  port_.say(line("C2.0"), 10 * kMillisecond);
  EXPECT_EQ(read(compass_, 60), Status::ok);
  EXPECT_EQ(count(compass_, "bad_checksums"), 2U);
}

TEST_F(Os5000Test, NoiseAloneIsNoSentence) {
  open(compass_);
  port_.say(std::string(5000, '\xa5'));
  EXPECT_EQ(read(compass_, 60), Status::timeout);
}

TEST_F(Os5000Test, AFloodOfBytesDoesNotHoldTheCallForEver) {
  open(compass_);
  std::string flood;
  for (int i = 0; i < 20000; ++i)
    flood += line("C1.0");
  port_.say(flood);
  const int before = port_.opened;
  ASSERT_EQ(compass_.read(clock_.now(), sample_), Status::ok);
  // Something is left after the 32 reads of 256 bytes.
  std::array<std::uint8_t, 8> rest{};
  std::size_t got = 0;
  EXPECT_EQ(port_.read(rest, clock_.now(), got), Status::ok);
  EXPECT_EQ(port_.opened, before);
}

TEST_F(Os5000Test, APulledPlugIsFoundAgainAndSetUpAgain) {
  open(compass_);
  port_.unplugged = true;
  const Nanoseconds gone = clock_.now();
  EXPECT_EQ(read(compass_, 100), Status::disconnected);
  EXPECT_EQ(clock_.now(), gone) << "told at once";
  EXPECT_EQ(count(compass_, "disconnections"), 1U);

  const int opened = port_.opened;
  EXPECT_EQ(read(compass_, 150), Status::disconnected);
  EXPECT_EQ(port_.opened, opened) << "looked for too soon";
  EXPECT_EQ(clock_.now(), gone + 150 * kMillisecond);
  EXPECT_EQ(read(compass_, 150), Status::disconnected);
  EXPECT_EQ(port_.opened, opened + 1);
  EXPECT_EQ(clock_.now(), gone + 200 * kMillisecond);
  EXPECT_TRUE(says(compass_, "not there")) << compass_.problem();

  port_.unplugged = false;
  port_.written.clear();
  port_.say(line("C90.0"), 250 * kMillisecond);
  ASSERT_EQ(read(compass_, 300), Status::ok) << compass_.problem();
  EXPECT_NEAR(sample_.yaw, 0, 1e-12);
  EXPECT_EQ(count(compass_, "disconnections"), 1U) << "one plug was pulled once";
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(read(compass_, 100), Status::timeout);
  EXPECT_EQ(port_.written, "\x1bR10\r\x1bX7\r");
}

TEST_F(Os5000Test, WhatCameBeforeThePlugWasPulledIsGiven) {
  RepeatingPort port{clock_};
  const std::string good = line("C90.0");
  port.text = good;
  Os5000 compass({.set_up = false}, port, clock_);
  ASSERT_EQ(compass.open(), Status::ok);
  port.pieces_until_gone = 1;
  ASSERT_EQ(read(compass, 100), Status::ok);
  EXPECT_NEAR(sample_.yaw, 0, 1e-12);
  EXPECT_EQ(count(compass, "disconnections"), 1U);
  EXPECT_EQ(read(compass, 100), Status::disconnected);
}

TEST_F(Os5000Test, OpenSaysWhyItFailed) {
  port_.unplugged = true;
  EXPECT_EQ(compass_.open(), Status::disconnected);
  EXPECT_TRUE(says(compass_, "not there")) << compass_.problem();
  EXPECT_EQ(read(compass_, 10), Status::disconnected);
  EXPECT_TRUE(says(compass_, "is not open"));
  port_.unplugged = false;

  port_.stuck = true;
  EXPECT_EQ(compass_.open(), Status::timeout);
  EXPECT_TRUE(says(compass_, "takes no bytes")) << compass_.problem();
  EXPECT_FALSE(port_.is_open());
  port_.stuck = false;

  const Nanoseconds start = clock_.now();
  EXPECT_EQ(compass_.open(), Status::timeout);
  EXPECT_EQ(clock_.now() - start, 900 * kMillisecond + 1200 * kMillisecond);
  EXPECT_FALSE(port_.is_open());

  port_.say(line("P1.0"), kSecond);
  EXPECT_EQ(compass_.open(), Status::bad_data);
  port_.answer = [&](const std::string&) { port_.unplugged = true; };
  EXPECT_EQ(compass_.open(), Status::disconnected);
}

TEST_F(Os5000Test, ImpossibleSettingsAreRefused) {
  const std::vector<std::pair<Os5000Settings, std::string>> cases = {
      {{.rate_hz = 0}, "rate_hz"},
      {{.rate_hz = 41}, "rate_hz"},
      {{.rate_hz = 40, .baud = 9600}, "more than the line can carry"},
      {{.baud = 300}, "baud"},
      {{.baud = 1'000'000}, "baud"},
      {{.declination_deg = 181}, "declination_deg"},
      {{.declination_deg = std::nan("")}, "declination_deg"},
      {{.mounting_deg = -181}, "mounting_deg"},
      {{.pitch_sign = 0}, "pitch_sign"},
      {{.roll_sign = 2}, "roll_sign"},
  };
  for (const auto& [settings, words] : cases) {
    Os5000 compass(settings, port_, clock_);
    EXPECT_EQ(compass.open(), Status::bad_argument) << words;
    EXPECT_TRUE(says(compass, words)) << compass.problem();
  }
  EXPECT_EQ(port_.opened, 0);
}

TEST_F(Os5000Test, ReadAllocatesNothing) {
  RepeatingPort port{clock_};
  const std::string good = line("C320.5P0.2R-18.3T19.0");
  port.text = good;
  Os5000 compass({.mounting_deg = 3}, port, clock_);
  ASSERT_EQ(compass.open(), Status::ok) << compass.problem();
  const int before = test::allocations;
  EXPECT_EQ(compass.read(in_ms(100), sample_), Status::ok);
  port.text = "$C1*00\r\n$C";
  EXPECT_EQ(compass.read(in_ms(100), sample_), Status::bad_data);
  port.pieces_until_gone = 0;
  EXPECT_EQ(compass.read(in_ms(500), sample_), Status::disconnected);
  EXPECT_EQ(compass.read(in_ms(500), sample_), Status::disconnected);
  port.pieces_until_gone = 1000;
  port.text = good;
  EXPECT_EQ(compass.read(in_ms(500), sample_), Status::ok);
  EXPECT_EQ(test::allocations, before);
}

}  // namespace
}  // namespace lakshya

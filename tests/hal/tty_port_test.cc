#include "hal/serial/tty_port.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "hal/clock/monotonic_clock.h"
#include "tests/support/pseudo_terminal.h"

namespace lakshya {
namespace {

class TtyPortTest : public testing::Test {
 protected:
  Nanoseconds in_ms(int ms) const { return clock_.now() + ms * kMillisecond; }

  std::span<const std::uint8_t> bytes(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
  }

  MonotonicClock clock_;
  PseudoTerminal other_end_;
  TtyPort port_{{.path = other_end_.path(), .baud = 57600, .stop_bits = 2}, clock_};
  std::array<std::uint8_t, 64> buffer_{};
  std::size_t count_ = 99;
};

TEST_F(TtyPortTest, CarriesEveryByteBothWaysUnchanged) {
  ASSERT_EQ(port_.open(), Status::ok) << port_.problem();
  std::string all;
  for (int i = 0; i < 256; ++i)
    all += static_cast<char>(i);
  ASSERT_EQ(port_.write(bytes(all), in_ms(1000)), Status::ok);
  EXPECT_EQ(other_end_.read(1000), all);

  other_end_.write(all);
  std::string got;
  while (got.size() < all.size()) {
    ASSERT_EQ(port_.read(buffer_, in_ms(1000), count_), Status::ok);
    ASSERT_GT(count_, 0U);
    got.append(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(count_));
  }
  EXPECT_EQ(got, all);
}

TEST_F(TtyPortTest, AReadEndsAtItsDeadline) {
  ASSERT_EQ(port_.open(), Status::ok) << port_.problem();
  const Nanoseconds deadline = in_ms(30);
  EXPECT_EQ(port_.read(buffer_, deadline, count_), Status::timeout);
  EXPECT_EQ(count_, 0U);
  EXPECT_GE(clock_.now(), deadline);
  EXPECT_LT(clock_.now(), deadline + kSecond);
}

TEST_F(TtyPortTest, AWriteThatNobodyTakesEndsAtItsDeadline) {
  ASSERT_EQ(port_.open(), Status::ok) << port_.problem();
  const std::string much(1 << 20, 'x');
  const Nanoseconds deadline = in_ms(30);
  EXPECT_EQ(port_.write(bytes(much), deadline), Status::timeout);
  EXPECT_LT(clock_.now(), deadline + kSecond);
  EXPECT_EQ(port_.counters()[1].value, 1U);
}

TEST_F(TtyPortTest, APulledPlugIsADisconnectionAndAnotherOneIsFoundAgain) {
  ASSERT_EQ(port_.open(), Status::ok) << port_.problem();
  other_end_.unplug();
  EXPECT_EQ(port_.read(buffer_, in_ms(1000), count_), Status::disconnected);
  EXPECT_FALSE(port_.is_open());
  EXPECT_EQ(port_.counters()[0].value, 1U);
  EXPECT_EQ(port_.read(buffer_, in_ms(1000), count_), Status::disconnected);
  EXPECT_EQ(port_.write(bytes("x"), in_ms(1000)), Status::disconnected);
  EXPECT_EQ(port_.open(), Status::disconnected);
  EXPECT_NE(std::string(port_.problem()).find("No such file"), std::string::npos) << port_.problem();
}

TEST_F(TtyPortTest, DiscardedInputIsNotRead) {
  ASSERT_EQ(port_.open(), Status::ok) << port_.problem();
  other_end_.write("old");
  EXPECT_EQ(clock_.wait_for(-1, Ready::to_read, 0), Status::bad_argument);
  clock_.sleep_until(in_ms(5));
  port_.discard_input();
  other_end_.write("new");
  ASSERT_EQ(port_.read(buffer_, in_ms(1000), count_), Status::ok);
  EXPECT_EQ(std::string(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(count_)), "new");
}

TEST_F(TtyPortTest, SettingsThatDoNotExistAndFilesThatAreNoPortAreRefused) {
  TtyPort odd({.path = other_end_.path(), .baud = 12345}, clock_);
  EXPECT_EQ(odd.open(), Status::bad_argument);
  EXPECT_NE(std::string(odd.problem()).find("12345"), std::string::npos);
  TtyPort none({.path = "/nonexistent/tty"}, clock_);
  EXPECT_EQ(none.open(), Status::disconnected);
  TtyPort null({.path = "/dev/null"}, clock_);
  EXPECT_EQ(null.open(), Status::disconnected);
  EXPECT_NE(std::string(null.problem()).find("is no serial port"), std::string::npos) << null.problem();
}

}  // namespace
}  // namespace lakshya

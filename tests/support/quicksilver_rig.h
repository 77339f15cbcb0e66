// What the tests of QuickSilver share: a scripted line with two drives on it, and a clock that stands still.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "hal/servo/quicksilver.h"
#include "tests/support/fake_serial_port.h"
#include "tests/support/manual_clock.h"

namespace lakshya::test {

// One turn of a wheel is 0.6 m and 10 turns of its motor: 0.5 m/s are 500 rpm, 268435456 units; 0.5 m/s^2 are 8.3333
// rev/s^2, 32212 units. 8000 counts are 0.06 m.
inline QuickSilverSettings quicksilver_settings() {
  const double radius = 0.3 / std::numbers::pi;
  QuickSilverSettings settings;
  settings.left = {.address = 16, .direction = 1, .radius_m = radius, .gear_ratio = 10};
  settings.right = {.address = 17, .direction = -1, .radius_m = radius, .gear_ratio = 10};
  return settings;
}

// What the other end of the line knows: registers, and a program that lives as long as it is allowed to.
class QuickSilverRig : public testing::Test {
 protected:
  using Numbers = std::vector<std::int64_t>;

  QuickSilverRig() {
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
  QuickSilverSettings settings_ = quicksilver_settings();
  QuickSilver servo_{settings_, port_, clock_};
};

}  // namespace lakshya::test

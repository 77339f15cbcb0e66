#include "tests/emulators/os5000_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace lakshya::emulator {
namespace {

constexpr std::int64_t kMs = 1'000'000;

// Its own clock, a millisecond at a time.
class Os5000DeviceTest : public testing::Test {
 protected:
  Os5000DeviceTest() { device_.say(now_); }

  std::string run(int ms) {
    std::string said;
    for (int i = 0; i < ms; ++i)
      said += device_.say(now_ += kMs);
    return said;
  }

  void type(const std::string& text, int gap_ms) {
    for (const char c : text) {
      device_.hear(std::string(1, c), now_);
      run(gap_ms);
    }
  }

  static long count(const std::string& text, char c) { return std::count(text.begin(), text.end(), c); }

  Os5000Device device_;
  std::int64_t now_ = 5'000'000'000;
};

// The guide's example: 320.5, 0.2, -18.3, 19.0 have the checksum 3C.
TEST_F(Os5000DeviceTest, SaysTheGuidesExample) {
  device_.heading_deg = 320.5;
  device_.pitch_deg = 0.2;
  device_.roll_deg = -18.3;
  device_.temperature_c = 19;
  EXPECT_EQ(run(200), "$C320.5P0.2R-18.3T19.0*3C\r\n");
}

TEST_F(Os5000DeviceTest, KeepsItsRateAndTheLinesSpeed) {
  EXPECT_EQ(count(run(1100), '$'), 8);
  // Sentence 9 begins 1125 ms after the start; 26 bytes at 19200 baud take 13.5 ms.
  const std::string part = run(25 + 5);
  EXPECT_GE(part.size(), 9U);
  EXPECT_LE(part.size(), 10U);
}

TEST_F(Os5000DeviceTest, ObeysCommandsTypedSlowlyEnough) {
  type("\x1bR20\r\x1bX3 ", 100);
  EXPECT_EQ(device_.commands_obeyed, 2);
  EXPECT_EQ(device_.characters_lost, 0);
  run(200);
  const std::string said = run(1000);
  EXPECT_EQ(count(said, '$'), 20);
  EXPECT_NE(said.find("$C0.0P0.0*"), std::string::npos) << said;
  type("\x1bR0 ", 100);
  run(100);
  EXPECT_EQ(run(1000), "");
}

TEST_F(Os5000DeviceTest, IsDeafToCharactersThatComeTooFast) {
  type("\x1bR20\r", 10);
  EXPECT_EQ(device_.commands_obeyed, 0);
  EXPECT_EQ(device_.rate_hz, 8);
  EXPECT_EQ(device_.characters_lost, 4);
  type("\x1bQ5\r\x1bR41\r", 100);
  EXPECT_EQ(device_.commands_obeyed, 0) << "unknown, and out of range";
}

TEST_F(Os5000DeviceTest, Turns) {
  device_.heading_deg = 350;
  device_.turn_dps = 40;
  device_.fields = 1;
  const std::string said = run(530);
  for (const char* const heading : {"$C355.0*", "$C0.0*", "$C5.0*", "$C10.0*"})
    EXPECT_NE(said.find(heading), std::string::npos) << heading << said;
}

TEST_F(Os5000DeviceTest, OtherFormats) {
  device_.heading_deg = 320.5;
  device_.format = Os5000Device::Format::true_heading;
  EXPECT_EQ(run(200), "$HCHDT,320.5,T*2D\r\n");
  device_.format = Os5000Device::Format::by_place;
  EXPECT_EQ(run(120).substr(0, 29), "$OHPR,320.5,0.0,0.0,25.0,0.0,");
}

TEST_F(Os5000DeviceTest, Faults) {
  device_.fields = 1;
  device_.wrong_checksum_every = 2;
  device_.garbage_every = 3;
  const std::string said = run(520);
  // "C0.0" has the checksum 6D.
  EXPECT_EQ(said, "$C0.0*6D\r\n$C0.0*6C\r\n\xff\x80*7\r$C12$C0.0*6D\r\n$C0.0*6C\r\n");
  device_.silent = true;
  EXPECT_EQ(run(500), "");
}

TEST_F(Os5000DeviceTest, SplitsAndMerges) {
  const auto pieces_in = [&](int ms) {
    std::vector<std::string> pieces;
    bool goes_on = false;
    for (int i = 0; i < ms; ++i) {
      const std::string said = run(1);
      if (!said.empty() && goes_on) pieces.back() += said;
      if (!said.empty() && !goes_on) pieces.push_back(said);
      goes_on = !said.empty();
    }
    return pieces;
  };
  device_.fields = 1;
  device_.split = true;
  EXPECT_EQ(pieces_in(250), (std::vector<std::string>{"$C0.0", "*6D\r\n"}));
  device_.split = false;
  device_.merge = true;
  run(130);
  EXPECT_EQ(pieces_in(250), std::vector<std::string>{"$C0.0*6D\r\n$C0.0*6D\r\n"});
}

}  // namespace
}  // namespace lakshya::emulator

// QuickSilver takes no memory after open().
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "hal/servo/quicksilver.h"
#include "tests/support/count_allocations.h"
#include "tests/support/manual_clock.h"
#include "tests/support/quicksilver_rig.h"

namespace lakshya {
namespace {

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
  QuickSilver servo(test::quicksilver_settings(), port_, clock_);
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

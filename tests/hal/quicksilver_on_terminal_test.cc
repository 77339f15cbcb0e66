// The driver against emulated drives over a pseudo-terminal, in real time.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>

#include "hal/clock/monotonic_clock.h"
#include "hal/serial/tty_port.h"
#include "hal/servo/quicksilver.h"
#include "tests/emulators/on_terminal.h"
#include "tests/emulators/quicksilver_drive.h"
#include "tests/support/quicksilver_wheels.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

using test::left_m;
using test::right_m;
using test::speed_mps;

class QuickSilverOnTerminalTest : public testing::Test {
 protected:
  Nanoseconds in_ms(int ms) const { return clock_.now() + ms * kMillisecond; }

  int drive_for(int ms, const WheelVelocities& wanted) {
    int failures = 0;
    for (const Nanoseconds end = in_ms(ms); clock_.now() < end;) {
      const Nanoseconds next = in_ms(60);
      if (servo_.drive(wanted, in_ms(200)) != Status::ok) ++failures;
      last_drive_ = clock_.now();
      if (servo_.read_travel(in_ms(200), travel_) != Status::ok) ++failures;
      clock_.sleep_until(next);
    }
    return failures;
  }

  emulator::QuickSilverState state(std::size_t index) {
    const auto lock = terminal_->locked();
    return line_.state(index, emulator::monotonic_ns());
  }

  void wait_until_both_stand() {
    for (int i = 0; i < 100 && (speed_mps(state(0)) > 0 || speed_mps(state(1)) > 0); ++i)
      clock_.sleep_until(in_ms(10));
  }

  // As udev gives an adapter the same name wherever it is plugged in.
  std::string linked_path() const {
    std::string link = folder_.path("drives");
    std::filesystem::remove(link);
    std::filesystem::create_symlink(terminal_->path(), link);
    return link;
  }

  MonotonicClock clock_;
  emulator::QuickSilverLine line_;
  std::optional<emulator::OnTerminal> terminal_{line_};
  TempFolder folder_;
  std::string path_ = linked_path();
  TtyPort port_{{.path = path_, .baud = 57600, .stop_bits = 2}, clock_};
  QuickSilver servo_{test::emulated_quicksilver_settings(), port_, clock_};
  WheelTravel travel_;
  Nanoseconds last_drive_ = 0;
};

TEST_F(QuickSilverOnTerminalTest, AStraightAndATurnThenSilence) {
  ASSERT_EQ(servo_.open(), Status::ok) << servo_.problem();
  EXPECT_EQ(drive_for(1000, {.left_mps = 0.5, .right_mps = 0.5}), 0) << servo_.problem();
  EXPECT_EQ(drive_for(1000, {.left_mps = 0.3, .right_mps = -0.3}), 0) << servo_.problem();
  ASSERT_EQ(servo_.stop(in_ms(200)), Status::ok) << servo_.problem();
  wait_until_both_stand();
  ASSERT_EQ(servo_.read_travel(in_ms(200), travel_), Status::ok) << servo_.problem();
  const double left = left_m(state(0));
  const double right = right_m(state(1));
  EXPECT_GT(left, 0.5);
  EXPECT_NEAR(travel_.left_m, left, 0.01 * left);
  EXPECT_NEAR(travel_.right_m, right, 0.01 * std::abs(right) + 1e-4);

  ASSERT_EQ(drive_for(500, {.left_mps = 0.1, .right_mps = 0.1}), 0) << servo_.problem();
  ASSERT_GT(speed_mps(state(0)), 0.05);
  clock_.sleep_until(last_drive_ + 300 * kMillisecond);
  EXPECT_EQ(speed_mps(state(0)), 0);
  EXPECT_EQ(speed_mps(state(1)), 0);
  EXPECT_TRUE(state(0).tripped && state(1).tripped);
}

TEST_F(QuickSilverOnTerminalTest, UnpluggedMidDriveTheWheelsStandAndItGoesOnWhenThePlugIsBack) {
  ASSERT_EQ(servo_.open(), Status::ok) << servo_.problem();
  ASSERT_EQ(drive_for(300, {.left_mps = 0.1, .right_mps = 0.1}), 0) << servo_.problem();
  terminal_->unplug();
  EXPECT_EQ(servo_.drive({.left_mps = 0.1, .right_mps = 0.1}, in_ms(100)), Status::disconnected);
  EXPECT_EQ(servo_.read_travel(in_ms(100), travel_), Status::disconnected);
  wait_until_both_stand();
  EXPECT_EQ(speed_mps(state(0)), 0);
  EXPECT_TRUE(state(0).tripped);

  terminal_.reset();
  terminal_.emplace(line_);
  (void)linked_path();
  Status status = Status::disconnected;
  for (const Nanoseconds end = in_ms(3000); status != Status::ok && clock_.now() < end;) {
    status = servo_.drive({.left_mps = 0.1, .right_mps = 0.1}, in_ms(100));
    if (status != Status::ok) clock_.sleep_until(in_ms(20));
  }
  EXPECT_EQ(status, Status::ok) << servo_.problem();
  EXPECT_EQ(drive_for(300, {.left_mps = 0.1, .right_mps = 0.1}), 0) << servo_.problem();
  EXPECT_NEAR(travel_.left_m, left_m(state(0)), 0.01 * travel_.left_m + 0.01);
}

TEST_F(QuickSilverOnTerminalTest, FaultsInRealTime) {
  ASSERT_EQ(servo_.open(), Status::ok) << servo_.problem();
  {
    const auto lock = terminal_->locked();
    line_.nak_every = 11;
    line_.garbage_every = 5;
    line_.silent_every = 47;
    line_.split = true;
  }
  (void)drive_for(800, {.left_mps = 0.2, .right_mps = 0.2});
  {
    const auto lock = terminal_->locked();
    line_.nak_every = line_.garbage_every = line_.silent_every = 0;
    line_.split = false;
    line_.merge = true;
  }
  clock_.sleep_until(in_ms(60));
  EXPECT_EQ(drive_for(300, {.left_mps = 0.2, .right_mps = 0.2}), 0) << servo_.problem();
  ASSERT_EQ(servo_.stop(in_ms(200)), Status::ok) << servo_.problem();
  wait_until_both_stand();
  ASSERT_EQ(servo_.read_travel(in_ms(200), travel_), Status::ok) << servo_.problem();
  EXPECT_NEAR(travel_.left_m, left_m(state(0)), 0.01 * travel_.left_m);
  EXPECT_GT(travel_.left_m, 0.05);
}

}  // namespace
}  // namespace lakshya

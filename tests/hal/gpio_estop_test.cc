#include "hal/estop/gpio_estop.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>

#include "hal/estop/gpiod_line.h"
#include "tests/support/count_allocations.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

// A pin with its resistor, which is high unless something holds it low.
class FakePin final : public GpioLine {
 public:
  Status request(const GpioLineRequest& request, Problem& problem) override {
    if (taken) {
      problem.set("GPIO: %s, line %d: Device or resource busy", request.chip.c_str(), request.line);
      return Status::refused;
    }
    requested = request;
    is_requested = true;
    return Status::ok;
  }
  void release() override { is_requested = false; }
  int value() override {
    if (gone) return -ENODEV;
    const bool low = held_low || !requested.pull_up;
    return low == requested.active_low ? 1 : 0;
  }

  bool held_low = true;
  bool taken = false;
  bool gone = false;
  bool is_requested = false;
  GpioLineRequest requested;
};

class GpioEstopTest : public testing::Test {
 protected:
  bool is_pressed(GpioEstop& estop) {
    bool pressed = false;
    EXPECT_EQ(estop.read(pressed), Status::ok) << estop.problem();
    return pressed;
  }

  FakePin pin_;
  GpioEstop estop_{{.chip = "gpiochip0", .line = 17}, pin_};
};

TEST_F(GpioEstopTest, ANormallyClosedSwitchAndItsCutWire) {
  ASSERT_EQ(estop_.open(), Status::ok) << estop_.problem();
  EXPECT_EQ(pin_.requested.chip, "gpiochip0");
  EXPECT_EQ(pin_.requested.line, 17);
  EXPECT_TRUE(pin_.requested.pull_up);
  EXPECT_FALSE(is_pressed(estop_));
  pin_.held_low = false;  // the switch opens, or a wire is cut
  EXPECT_TRUE(is_pressed(estop_));
  estop_.close();
  EXPECT_FALSE(pin_.is_requested);
}

TEST_F(GpioEstopTest, ANormallyOpenSwitchIsActiveLow) {
  GpioEstop estop({.line = 17, .active_low = true}, pin_);
  ASSERT_EQ(estop.open(), Status::ok);
  EXPECT_TRUE(is_pressed(estop));
  pin_.held_low = false;
  EXPECT_FALSE(is_pressed(estop));
}

TEST_F(GpioEstopTest, ALineThatCannotBeReadIsPressed) {
  ASSERT_EQ(estop_.open(), Status::ok);
  pin_.gone = true;
  bool pressed = false;
  EXPECT_EQ(estop_.read(pressed), Status::disconnected);
  EXPECT_TRUE(pressed);
  EXPECT_STREQ(estop_.problem(), "GPIO: gpiochip0, line 17: No such device");
  EXPECT_EQ(estop_.counters()[0].value, 1U);
  pin_.gone = false;
  EXPECT_FALSE(is_pressed(estop_));
}

TEST_F(GpioEstopTest, NothingIsAllocatedOnceItIsOpen) {
  ASSERT_EQ(estop_.open(), Status::ok);
  bool pressed = false;
  test::allocations = 0;
  EXPECT_EQ(estop_.read(pressed), Status::ok);
  pin_.gone = true;
  EXPECT_EQ(estop_.read(pressed), Status::disconnected);
  EXPECT_EQ(test::allocations, 0);
}

TEST_F(GpioEstopTest, WhatDoesNotOpen) {
  bool pressed = false;
  EXPECT_EQ(estop_.read(pressed), Status::disconnected);
  EXPECT_TRUE(pressed);
  pin_.gone = true;
  EXPECT_EQ(estop_.open(), Status::disconnected);
  EXPECT_FALSE(pin_.is_requested);
  pin_.taken = true;
  EXPECT_EQ(estop_.open(), Status::refused);
  EXPECT_NE(std::string(estop_.problem()).find("busy"), std::string::npos) << estop_.problem();
  GpioEstop no_line({.chip = "gpiochip0"}, pin_);
  EXPECT_EQ(no_line.open(), Status::bad_argument);
  EXPECT_STREQ(no_line.problem(), "GPIO: chip \"gpiochip0\", line -1: no line of a chip");
  GpioEstop no_chip({.chip = {}, .line = 17}, pin_);
  EXPECT_EQ(no_chip.open(), Status::bad_argument);
}

// In either way of building it says what is the matter.
TEST(GpiodLine, WithoutAChipThereIsNoLine) {
  const TempFolder folder;
  for (const std::string& chip : {std::string("gpiochip999"), std::string("/dev/none"),
                                  std::string("no such label"), folder.write("file", std::string("no chip"))}) {
    const auto line = make_gpiod_line();
    GpioEstop estop({.chip = chip, .line = 0}, *line);
    const Status status = estop.open();
    EXPECT_TRUE(status == Status::disconnected || status == Status::unsupported) << to_string(status);
    EXPECT_NE(std::string(estop.problem()).find(status == Status::disconnected ? "GPIO: " + chip + ": " : "built"),
              std::string::npos)
        << estop.problem();
    EXPECT_EQ(std::string(estop.problem()).find("Success"), std::string::npos) << estop.problem();
    EXPECT_EQ(line->value(), -ENODEV);
  }
}

}  // namespace
}  // namespace lakshya

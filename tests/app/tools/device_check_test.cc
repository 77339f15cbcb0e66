// Devices that work and devices with one fault each.
#include "app/tools/device_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "hal/servo/record_servo.h"
#include "tests/support/manual_clock.h"

namespace lakshya {
namespace {

class TestCamera final : public StereoCamera {
 public:
  explicit TestCamera(Clock& clock) : clock_(&clock) {}
  Status open() override {
    if (opens != Status::ok) problem_.set("video9: no such thing");
    return opens;
  }
  void close() override { closed = true; }
  std::span<const Counter> counters() const override { return counters_; }
  int width() const override { return 16; }
  int height() const override { return 16; }
  bool is_static() const override { return is_static_camera; }
  Status capture(Nanoseconds deadline, StereoFrame& frame) override {
    const Nanoseconds due = clock_->now() + 50 * kMillisecond;
    if (unplugged_after >= 0 && sequence_ >= static_cast<std::uint64_t>(unplugged_after)) {
      problem_.set("video9: gone");
      return Status::disconnected;
    }
    if (silent || due > deadline) {
      clock_->sleep_until(deadline);
      return Status::timeout;
    }
    clock_->sleep_until(due);
    left_.assign(256, left_grey);
    right_.assign(256, 100);
    if (!frozen) left_[0] = static_cast<std::uint8_t>(sequence_);
    frame = {.left = {left_.data(), 16, 16},
             .right = {right_.data(), 16, 16},
             .left_time = due,
             .right_time = due - 2 * kMillisecond,
             .sequence = sequence_};
    sequence_ += sequence_ == 3 ? 3 : 1;  // two are lost on the way
    return Status::ok;
  }

  Status opens = Status::ok;
  bool silent = false;
  int unplugged_after = -1;
  bool frozen = false;
  bool is_static_camera = false;
  bool closed = false;
  std::uint8_t left_grey = 90;

 private:
  Clock* clock_;
  std::uint64_t sequence_ = 0;
  std::vector<std::uint8_t> left_, right_;
  Counter counters_[1] = {{"lost_frames", 2}};
};

// Wheels that obey at once, or with one fault.
class TestServo final : public Servo {
 public:
  explicit TestServo(Clock& clock) : clock_(&clock) {}
  Status open() override { return Status::ok; }
  void close() override { (void)drive({}, 0); }
  std::span<const Counter> counters() const override { return {}; }
  Status drive(const WheelVelocities& wanted, Nanoseconds /*deadline*/) override {
    advance();
    wanted_ = wanted;
    if (swapped) std::swap(wanted_.left_mps, wanted_.right_mps);
    wanted_.right_mps *= right_factor;
    ++commands;
    if (commands == naks_at) problem_.set("drive 17: busy");
    return commands == naks_at ? Status::refused : Status::ok;
  }
  Status read_travel(Nanoseconds /*deadline*/, WheelTravel& travel) override {
    advance();
    travel = travel_;
    return Status::ok;
  }
  Status stop(Nanoseconds deadline) override { return drive({}, deadline); }
  double max_speed_mps() const override { return 1; }
  bool is_supervised() const override { return true; }

  bool still() const { return wanted_.left_mps == 0 && wanted_.right_mps == 0; }

  bool swapped = false;
  double acceleration = 1e6;
  double right_factor = 1;
  int commands = 0;
  int naks_at = -1;

 private:
  static double towards(double now, double wanted, double step) {
    return now + std::clamp(wanted - now, -step, step);
  }
  // In steps of a millisecond.
  void advance() {
    while (travel_.time < clock_->now()) {
      const double step = acceleration * 1e-3;
      now_ = {towards(now_.left_mps, wanted_.left_mps, step), towards(now_.right_mps, wanted_.right_mps, step)};
      travel_.left_m += now_.left_mps * 1e-3;
      travel_.right_m += now_.right_mps * 1e-3;
      travel_.time += kMillisecond;
    }
  }
  Clock* clock_;
  WheelVelocities wanted_;
  WheelVelocities now_;
  WheelTravel travel_{.time = clock_->now()};
};

class TestCompass final : public Compass {
 public:
  explicit TestCompass(Clock& clock) : clock_(&clock) {}
  Status open() override { return Status::ok; }
  void close() override {}
  std::span<const Counter> counters() const override { return {}; }
  Status read(Nanoseconds deadline, HeadingSample& sample) override {
    if (broken) {
      clock_->sleep_until(deadline);
      return Status::bad_data;
    }
    clock_->sleep_until(std::min(deadline, clock_->now() + 100 * kMillisecond));
    sample = {.yaw = 1.5707963267948966,
              .pitch = 0.1,
              .roll = std::numeric_limits<double>::quiet_NaN(),
              .time = clock_->now()};
    return Status::ok;
  }
  bool broken = false;

 private:
  Clock* clock_;
};

class DeviceCheckTest : public testing::Test {
 protected:
  ManualClock clock_;
  CheckSettings settings_{.seconds = 3};
};

TEST_F(DeviceCheckTest, ACameraThatWorks) {
  TestCamera camera(clock_);
  const DeviceCheck check = check_camera(camera, clock_, settings_);
  EXPECT_EQ(check.fault, "");
  EXPECT_EQ(check.facts["pairs"], 60);
  EXPECT_EQ(check.facts["pairs_per_second"], 20.0);
  EXPECT_EQ(check.facts["lost"], 2);
  EXPECT_EQ(check.facts["skew_ms"], 2.0);
  EXPECT_EQ(check.facts["counters"]["lost_frames"], 2);
  EXPECT_TRUE(camera.closed);
  const std::string text = device_check_text(check);
  EXPECT_NE(text.find("  size: [16,16]\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  counters: lost_frames 2\n"), std::string::npos) << text;
}

TEST_F(DeviceCheckTest, CamerasAtFault) {
  const auto fault = [this](auto change) {
    TestCamera camera(clock_);
    change(camera);
    return check_camera(camera, clock_, settings_).fault;
  };
  EXPECT_EQ(fault([](TestCamera& c) { c.opens = Status::disconnected; }),
            "open: disconnected (video9: no such thing)");
  EXPECT_EQ(fault([](TestCamera& c) { c.silent = true; }), "nothing came: timeout");
  EXPECT_EQ(fault([](TestCamera& c) { c.unplugged_after = 20; }),
            "nothing came any more: disconnected (video9: gone)");
  EXPECT_TRUE(fault([](TestCamera& c) { c.frozen = true; }).starts_with("frozen"));
  EXPECT_EQ(fault([](TestCamera& c) { c.frozen = c.is_static_camera = true; }), "");
  EXPECT_TRUE(fault([](TestCamera& c) { c.left_grey = 0; }).starts_with("left images are black"));
  EXPECT_TRUE(fault([](TestCamera& c) { c.left_grey = 255; }).starts_with("left images are saturated"));
}

TEST_F(DeviceCheckTest, WithoutASpeedNoWheelTurns) {
  TestServo servo(clock_);
  const DeviceCheck check = check_servo(servo, clock_, settings_);
  EXPECT_EQ(check.fault, "");
  EXPECT_EQ(servo.commands, 1);  // close()
  EXPECT_FALSE(check.facts.contains("steps"));
}

TEST_F(DeviceCheckTest, DrivesThatWork) {
  TestServo servo(clock_);
  settings_.speed_mps = 0.1;
  const DeviceCheck check = check_servo(servo, clock_, settings_);
  EXPECT_EQ(check.fault, "");
  ASSERT_EQ(check.facts["steps"].size(), 6U);
  EXPECT_EQ(check.facts["steps"][5]["wanted_m"].dump(), "[-0.05,-0.05]");
  EXPECT_EQ(check.facts["steps"][5]["travelled_m"].dump(), "[-0.05,-0.05]");
  EXPECT_GE(servo.commands, 6 * 12);  // commands come again and again
  EXPECT_TRUE(servo.still());
}

TEST_F(DeviceCheckTest, DrivesAtFault) {
  settings_.speed_mps = 0.1;
  const auto fault = [this](auto change) {
    TestServo servo(clock_);
    change(servo);
    std::string text = check_servo(servo, clock_, settings_).fault;
    EXPECT_TRUE(servo.still());
    return text;
  };
  EXPECT_TRUE(
      fault([](TestServo& s) { s.swapped = true; }).starts_with("left wheel forward: the wheels did not go"));
  EXPECT_TRUE(
      fault([](TestServo& s) { s.right_factor = -1; }).starts_with("right wheel forward: the wheels did not"));
  EXPECT_TRUE(
      fault([](TestServo& s) { s.right_factor = 1.3; }).starts_with("right wheel forward: the wheels did not"));
  EXPECT_EQ(fault([](TestServo& s) { s.naks_at = 20; }), "left wheel back: refused (drive 17: busy)");
}

TEST_F(DeviceCheckTest, WhoInterruptsFindsTheWheelsStanding) {
  TestServo servo(clock_);
  const std::atomic<bool> interrupt = true;
  settings_.speed_mps = 0.1;
  settings_.interrupt = &interrupt;
  EXPECT_EQ(check_servo(servo, clock_, settings_).fault, "interrupted");
  EXPECT_TRUE(servo.still());
  TestCompass compass(clock_);
  EXPECT_EQ(check_compass(compass, clock_, settings_).fault, "interrupted");
}

TEST_F(DeviceCheckTest, WheelsThatTakeTimeToStopAreWaitedFor) {
  TestServo servo(clock_);
  servo.acceleration = 0.6;
  settings_.speed_mps = 1;
  const DeviceCheck check = check_servo(servo, clock_, settings_);
  EXPECT_EQ(check.fault, "");
  EXPECT_NEAR(check.facts["steps"][0]["travelled_m"][0].get<double>(), 4, 0.05);
}

TEST_F(DeviceCheckTest, DrivesThatMeasureNothingAreBelieved) {
  RecordServo servo({.path = {}}, clock_);
  settings_.speed_mps = 0.1;
  const DeviceCheck check = check_servo(servo, clock_, settings_);
  EXPECT_EQ(check.fault, "");
  EXPECT_EQ(check.facts["measures_travel"], false);
}

TEST_F(DeviceCheckTest, ACompass) {
  TestCompass compass(clock_);
  const DeviceCheck check = check_compass(compass, clock_, settings_);
  EXPECT_EQ(check.fault, "");
  EXPECT_EQ(check.facts["readings"], 30);
  EXPECT_EQ(check.facts["heading_deg"], 0.0);
  EXPECT_NEAR(check.facts["pitch_deg"].get<double>(), 5.73, 1e-9);
  EXPECT_FALSE(check.facts.contains("roll_deg"));
  compass.broken = true;
  EXPECT_EQ(check_compass(compass, clock_, settings_).fault, "nothing came: bad data");
}

}  // namespace
}  // namespace lakshya

#include "app/core/devices.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "app/core/device_config_keys.h"
#include "app/core/image.h"
#include "app/core/image_file.h"
#include "app/core/input_error.h"
#include "hal/servo/quicksilver_settings.h"
#include "hal/watchdog/linux_watchdog.h"
#include "tests/support/config_checks.h"
#include "tests/support/manual_clock.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

template <class Kind>
std::vector<std::string_view> names(std::span<const Driver<Kind>> drivers) {
  std::vector<std::string_view> result;
  for (const Driver<Kind>& driver : drivers)
    result.push_back(driver.name);
  return result;
}

template <class Names>
std::vector<std::string_view> listed(const Names& names) {
  return {names.begin(), names.end()};
}

TEST(Devices, TheConfigurationMayNameEveryDriverAndNoOther) {
  EXPECT_EQ(names(camera_drivers()), listed(kCameraDrivers));
  EXPECT_EQ(names(servo_drivers()), listed(kServoDrivers));
  EXPECT_EQ(names(compass_drivers()), listed(kCompassDrivers));
  EXPECT_EQ(names(estop_drivers()), listed(kEstopDrivers));
  EXPECT_EQ(names(watchdog_drivers()), listed(kWatchdogDrivers));
}

TEST(Devices, TheWatchdogIsTheSameInTheConfigurationAndInTheDriver) {
  EXPECT_EQ(WatchdogConfig{}.path, LinuxWatchdogSettings{}.path);
  EXPECT_EQ(WatchdogConfig{}.timeout_s, LinuxWatchdogSettings{}.timeout_s);
}

// A reply later than these is given up in the same way, with a configuration or without one.
TEST(Devices, TheDrivesTimesAreTheSameInTheConfigurationAndInTheDriver) {
  EXPECT_EQ(QuicksilverConfig{}.answer_timeout_s, QuickSilverSettings{}.answer_timeout_s);
  EXPECT_EQ(QuicksilverConfig{}.watchdog_s, QuickSilverSettings{}.watchdog_s);
}

class DevicesTest : public testing::Test {
 protected:
  // An even image of 4 x 3.
  std::string image(const std::string& name, std::uint8_t grey) {
    write_png(folder_.path(name), Image<std::uint8_t>(4, 3, grey).view());
    return folder_.path(name);
  }

  std::string camera_refusal() {
    return refusal([&] { (void)make_camera(config_, clock_); });
  }

  TempFolder folder_;
  ManualClock clock_;
  VehicleConfig config_;
};

TEST_F(DevicesTest, ASinglePairIsAStaticCamera) {
  config_.folder = {.path = {}, .left = image("l.png", 10), .right = image("r.png", 20), .repeat = "yes"};
  const Made<StereoCamera> camera = make_camera(config_, clock_);
  ASSERT_EQ(camera.device->open(), Status::ok) << camera.device->problem();
  EXPECT_TRUE(camera.device->is_static());
  StereoFrame frame;
  ASSERT_EQ(camera.device->capture(clock_.now(), frame), Status::ok);
  EXPECT_EQ(camera.device->width(), 4);
  EXPECT_EQ(frame.left.at(3, 2), 10);
  EXPECT_EQ(frame.right.at(0, 0), 20);
}

TEST_F(DevicesTest, ASequenceComesWithItsTimesAndABrokenImageIsBadData) {
  std::filesystem::create_directories(folder_.path("left"));
  std::filesystem::create_directories(folder_.path("right"));
  for (int n = 0; n < 3; ++n) {
    const std::string name = std::to_string(n) + ".png";
    (void)image("left/" + name, static_cast<std::uint8_t>(n));
    (void)image("right/" + name, static_cast<std::uint8_t>(100 + n));
  }
  (void)folder_.write("times.txt", std::string("0.0\n0.2\n0.25\n"));
  (void)folder_.write("right/1.png", std::string("no image"));
  config_.folder.path = folder_.path("");
  const Made<StereoCamera> camera = make_camera(config_, clock_);
  ASSERT_EQ(camera.device->open(), Status::ok) << camera.device->problem();
  EXPECT_FALSE(camera.device->is_static());
  const Nanoseconds start = clock_.now();
  StereoFrame frame;
  EXPECT_EQ(camera.device->capture(start + kSecond, frame), Status::ok);
  EXPECT_EQ(camera.device->capture(start + kSecond, frame), Status::bad_data);
  EXPECT_EQ(clock_.now(), start + kSecond / 5);
  EXPECT_EQ(camera.device->capture(start + kSecond, frame), Status::ok);
  EXPECT_EQ(clock_.now(), start + kSecond / 4);
  EXPECT_EQ(camera.device->capture(start + kSecond, frame), Status::end_of_data);
}

TEST_F(DevicesTest, WhatTheConfigurationLacksIsSaid) {
  EXPECT_TRUE(contains(camera_refusal(), "folder.path or both folder.left and folder.right"));
  config_.folder.left = "only/this";
  EXPECT_TRUE(contains(camera_refusal(), "folder.left"));
  config_.folder.path = folder_.path("nothing");
  EXPECT_TRUE(contains(camera_refusal(), "is not a folder"));
  config_.drivers.camera = "sim";
  EXPECT_TRUE(contains(camera_refusal(), "simulator"));
}

TEST_F(DevicesTest, NoneIsNoDevice) {
  config_.drivers.camera = "none";
  EXPECT_EQ(make_camera(config_, clock_).device, nullptr);
  EXPECT_EQ(make_compass(config_, clock_).device, nullptr);
  EXPECT_EQ(make_estop(config_, clock_).device, nullptr);
  EXPECT_EQ(make_watchdog(config_, clock_).device, nullptr);
}

TEST_F(DevicesTest, AnEmergencyStopIsAFileOrALine) {
  const auto estop_refusal = [&] { return refusal([&] { (void)make_estop(config_, clock_); }); };
  config_.drivers.estop = "file";
  EXPECT_TRUE(contains(estop_refusal(), "estop.path"));
  config_.estop.path = folder_.write("estop", std::string("0\n"));
  const Made<EmergencyStop> file = make_estop(config_, clock_);
  ASSERT_EQ(file.device->open(), Status::ok) << file.device->problem();
  bool pressed = true;
  EXPECT_EQ(file.device->read(pressed), Status::ok);
  EXPECT_FALSE(pressed);
  config_.drivers.estop = "gpio";
  EXPECT_TRUE(contains(estop_refusal(), "estop.line"));
  config_.estop.line = 17;
  config_.estop.chip = "";
  EXPECT_TRUE(contains(estop_refusal(), "estop.chip"));
  config_.estop.chip = "gpiochip999";
  const Made<EmergencyStop> line = make_estop(config_, clock_);
  EXPECT_NE(line.device->open(), Status::ok);
  EXPECT_NE(line.device->read(pressed), Status::ok);
  EXPECT_TRUE(pressed);
}

TEST_F(DevicesTest, AWatchdogIsTheMachinesOwn) {
  config_.drivers.watchdog = "linux";
  config_.watchdog.path = folder_.path("none");
  const Made<Watchdog> watchdog = make_watchdog(config_, clock_);
  EXPECT_EQ(watchdog.device->open(), Status::disconnected);
  EXPECT_TRUE(contains(watchdog.device->problem(), folder_.path("none")));
}

TEST_F(DevicesTest, DrivesTakeTheVehiclesLimits) {
  config_.vehicle.max_speed_mps = 1.5;
  EXPECT_EQ(make_servo(config_, clock_).device->max_speed_mps(), 1.5);
  config_.drivers.servo = "pwm";
  config_.pwm.full_speed_mps = 1.2;
  EXPECT_EQ(make_servo(config_, clock_).device->max_speed_mps(), 0.3);
  config_.pwm.supervised = "yes";
  EXPECT_EQ(make_servo(config_, clock_).device->max_speed_mps(), 1.2);
  config_.drivers.servo = "quicksilver";
  config_.quicksilver.port = "/dev/none";
  EXPECT_EQ(make_servo(config_, clock_).device->max_speed_mps(), 1.5);
  config_.vehicle.max_speed_mps = 7;  // wheels of 0.1 m behind gears of 10 do 4.2 m/s at 4000 rpm
  EXPECT_NEAR(make_servo(config_, clock_).device->max_speed_mps(), 4.19, 0.01);
  config_.drivers.compass = "os5000";
  EXPECT_TRUE(odometry_settings(config_).has_compass);
  EXPECT_EQ(odometry_settings(config_).track_m, config_.vehicle.track_m);
}

}  // namespace
}  // namespace lakshya

// `lakshya devices` and `lakshya compass` as a user starts them, with the emulators at the other end of the line.
#include "app/tools/devices_command.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "app/core/image.h"
#include "app/core/image_file.h"
#include "app/core/vehicle_config_file.h"
#include "tests/emulators/on_terminal.h"
#include "tests/emulators/os5000_device.h"
#include "tests/emulators/quicksilver_drive.h"
#include "tests/support/run_command.h"

namespace lakshya {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

class DevicesCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (lakshya_binary().empty()) GTEST_SKIP() << "LAKSHYA_BIN does not name the command";
  }

  static Outcome devices(Words words) {
    words.insert(words.begin(), {lakshya_binary(), "devices"});
    return run_command(words);
  }

  TempFolder folder_;
};

class QuickSilverCommand : public DevicesCommand {
 protected:
  static Outcome test_drives(const std::string& port, Words more = {}) {
    Words words{"--test", "quicksilver", "--json", "--set", "quicksilver.port=" + port};
    words.insert(words.end(), more.begin(), more.end());
    return devices(words);
  }

  emulator::QuickSilverLine line_;
};

TEST_F(QuickSilverCommand, DrivesTurnAndTheirTravelIsRight) {
  emulator::OnTerminal terminal(line_);
  const Outcome o = test_drives(terminal.path(), {"--drive", "0.2"});
  ASSERT_EQ(o.exit_code, 0) << o.out << o.err;
  EXPECT_NE(o.err.find("wheels are about to turn"), std::string::npos) << o.err;
  const Json json = Json::parse(o.out);
  EXPECT_TRUE(json["ok"]);
  EXPECT_TRUE(json["supervised"]);
  EXPECT_NEAR(json["max_speed_mps"].get<double>(), 4.19, 0.01);
  ASSERT_EQ(json["steps"].size(), 6U);
  EXPECT_EQ(json["steps"][0]["step"], "left wheel forward");
  EXPECT_GT(json["steps"][0]["travelled_m"][0].get<double>(), 0.08);
  EXPECT_EQ(json["steps"][0]["travelled_m"][1], 0.0);
  const auto lock = terminal.locked();
  EXPECT_EQ(line_.state(0, emulator::monotonic_ns()).velocity_rpm, 0);
  EXPECT_EQ(line_.state(1, emulator::monotonic_ns()).velocity_rpm, 0);
}

TEST_F(QuickSilverCommand, ADriveThatIsNotThereIsNamed) {
  emulator::OnTerminal terminal(line_);
  const Outcome o = test_drives(terminal.path(), {"--set", "quicksilver.left_address=20"});
  EXPECT_EQ(o.exit_code, 1);
  EXPECT_NE(Json::parse(o.out)["fault"].get<std::string>().find("drive 20: no reply"), std::string::npos) << o.out;
  EXPECT_NE(o.err.find("--drive"), std::string::npos) << o.err;
}

TEST_F(QuickSilverCommand, DrivesWithoutTheirProgramAreRefused) {
  emulator::QuickSilverLine bare({16, 17}, {.at_power_up = false});
  emulator::OnTerminal terminal(bare);
  const Outcome o = test_drives(terminal.path(), {"--drive", "0.2"});
  EXPECT_EQ(o.exit_code, 1);
  EXPECT_NE(Json::parse(o.out)["fault"].get<std::string>().find("no resident program"), std::string::npos) << o.out;
  const Outcome slow = test_drives(terminal.path(), {"--drive", "0.2", "--set", "quicksilver.supervised=no"});
  EXPECT_EQ(slow.exit_code, 0) << slow.out << slow.err;
  EXPECT_EQ(Json::parse(slow.out)["max_speed_mps"], 0.3);
  const Outcome fast = test_drives(terminal.path(), {"--drive", "0.5", "--set", "quicksilver.supervised=no"});
  EXPECT_EQ(fast.exit_code, 1);
  EXPECT_NE(Json::parse(fast.out)["fault"].get<std::string>().find("faster than 0.3 m/s"), std::string::npos)
      << fast.out;
}

TEST_F(QuickSilverCommand, CtrlCStopsTheWheels) {
  // Without the program in the drives: VMI runs until the next command.
  emulator::QuickSilverLine bare({16, 17}, {.at_power_up = false});
  emulator::OnTerminal terminal(bare);
  const Outcome o = run_command({"timeout", "--signal=INT", "2", lakshya_binary(), "devices", "--test",
                                 "quicksilver", "--set", "quicksilver.port=" + terminal.path(), "--set",
                                 "quicksilver.supervised=no", "--drive", "0.2", "--seconds", "60"});
  EXPECT_NE(o.out.find("at fault: interrupted"), std::string::npos) << o.out << o.err;
  const auto lock = terminal.locked();
  const std::int64_t soon = emulator::monotonic_ns() + 1'000'000'000;
  EXPECT_GT(bare.state(0, soon).position, 0);
  EXPECT_EQ(bare.state(0, soon).velocity_rpm, 0);
}

TEST_F(DevicesCommand, ACompassOnItsLine) {
  emulator::Os5000Device device;
  device.heading_deg = 320.5;
  device.pitch_deg = 2;
  emulator::OnTerminal terminal(device);
  const Words words{"--test", "os5000", "--seconds", "1", "--json", "--set", "os5000.port=" + terminal.path()};
  const Outcome o = devices(words);
  ASSERT_EQ(o.exit_code, 0) << o.out << o.err;
  const Json json = Json::parse(o.out);
  EXPECT_NEAR(json["heading_deg"].get<double>(), 320.5, 0.11);
  EXPECT_NEAR(json["pitch_deg"].get<double>(), 2, 0.11);
  EXPECT_NEAR(json["readings_per_second"].get<double>(), 10, 1.5);
  {
    const auto lock = terminal.locked();
    device.silent = true;
  }
  const Outcome silent = devices(words);
  EXPECT_EQ(silent.exit_code, 1);
  EXPECT_NE(Json::parse(silent.out)["fault"].get<std::string>().find("timeout"), std::string::npos) << silent.out;
}

TEST_F(DevicesCommand, RecordedPairsAreACamera) {
  write_png(folder_.path("l.png"), Image<std::uint8_t>(8, 6, 90).view());
  write_png(folder_.path("r.png"), Image<std::uint8_t>(8, 6, 91).view());
  const Outcome o =
      devices({"--test", "camera", "--seconds", "0.3", "--set", "folder.left=" + folder_.path("l.png"), "--set",
               "folder.right=" + folder_.path("r.png")});
  EXPECT_EQ(o.exit_code, 0) << o.err;
  EXPECT_EQ(o.out.rfind("camera: ok\n  size: [8,6]\n  static: true\n  pairs: 1\n", 0), 0U) << o.out;
}

TEST_F(DevicesCommand, WhatIsThereIsListed) {
  const Outcome o = devices({});
  EXPECT_EQ(o.exit_code, 0);
  EXPECT_NE(o.out.find("Serial ports (drivers: quicksilver os5000)\n"), std::string::npos) << o.out;
  EXPECT_TRUE(Json::parse(devices({"--json"}).out).contains("iio_sensors"));
}

TEST_F(DevicesCommand, WhatCannotBeTestedIsRefused) {
  const Outcome unknown = devices({"--test", "sonar"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_NE(unknown.err.find(
                "there are: camera, servo, compass, folder, v4l2, dc1394, record, quicksilver, pwm, os5000, iio"),
            std::string::npos)
      << unknown.err;
  const Outcome no_port = devices({"--test", "os5000"});
  EXPECT_EQ(no_port.exit_code, 1);
  EXPECT_NE(no_port.err.find("os5000.port"), std::string::npos) << no_port.err;
  EXPECT_EQ(devices({"--drive", "0.1"}).exit_code, 2);
  EXPECT_EQ(devices({"--test", "compass"}).exit_code, 1);  // none is configured
}

// ---- compass --calibrate

// A magnetometer in a folder laid out as sysfs.
class CompassCommand : public DevicesCommand {
 protected:
  CompassCommand() {
    std::filesystem::create_directories(folder_.path("iio:device0"));
    (void)folder_.write("iio:device0/in_magn_scale", std::string("0.0001\n"));
    (void)folder_.write("iio:device0/name", std::string("hmc5883l\n"));
    point(0);
  }

  // Its level field, moved by 0.3 and -0.1 gauss and stretched by a quarter forward, when the vehicle points there.
  void point(double angle) {
    set("x", 3000 + 2500 * std::cos(angle));
    set("y", -1000 + 2000 * std::sin(angle));
    set("z", -4000);
  }

  Outcome calibrate() {
    return run_command({lakshya_binary(), "compass", "--calibrate", "--seconds", "3", "--sysfs", folder_.path("."),
                        "--set", "compass.rate_hz=100"});
  }

 private:
  // In one piece of constant length: who reads meanwhile gets the old number or the new one.
  void set(const std::string& axis, double raw) {
    char text[16];
    (void)std::snprintf(text, sizeof text, "%6ld\n", std::lround(raw));
    std::fstream file(folder_.path("iio:device0/in_magn_" + axis + "_raw"), std::ios::in | std::ios::out);
    if (!file.is_open()) {
      (void)folder_.write("iio:device0/in_magn_" + axis + "_raw", std::string(text));
      return;
    }
    file.write(text, 7);
  }
};

TEST_F(CompassCommand, ATurnOnTheSpotIsACalibration) {
  std::atomic<bool> done = false;
  std::thread turning([&] {
    for (double angle = 0; !done; angle += 0.02) {
      point(angle);
      std::this_thread::sleep_for(std::chrono::milliseconds(3));
    }
  });
  const Outcome o = calibrate();
  done = true;
  turning.join();
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const VehicleConfig config = parse_vehicle_config(o.out, "output", "", {});
  EXPECT_NEAR(config.iio.hard_iron_x_gauss, 0.3, 0.01) << o.out;
  EXPECT_NEAR(config.iio.hard_iron_y_gauss, -0.1, 0.01) << o.out;
  EXPECT_NEAR(config.iio.soft_iron_yy / config.iio.soft_iron_xx, 1.25, 0.03) << o.out;
}

TEST_F(CompassCommand, WithoutATurnThereIsNone) {
  const Outcome o = calibrate();
  EXPECT_EQ(o.exit_code, 1);
  EXPECT_EQ(o.out, "");
  EXPECT_NE(o.err.find("calibration: "), std::string::npos) << o.err;
}

TEST_F(CompassCommand, AxesThatAreNoneAreRefused) {
  const Outcome axes = run_command({lakshya_binary(), "compass", "--calibrate", "--set", "iio.axes=x,x,z"});
  EXPECT_EQ(axes.exit_code, 1);
  EXPECT_NE(axes.err.find("iio.axes"), std::string::npos) << axes.err;
}

}  // namespace
}  // namespace lakshya

// Against a folder laid out as the kernel lays out /sys and /dev.
#include "app/tools/device_list.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;

class DeviceListTest : public testing::Test {
 protected:
  void file(const std::string& name, const std::string& content = "") {
    fs::create_directories(fs::path(folder_.path(name)).parent_path());
    (void)folder_.write(name, content);
  }
  void link(const std::string& name, const std::string& to) {
    fs::create_directories(fs::path(folder_.path(name)).parent_path());
    fs::create_symlink(to, folder_.path(name));
  }
  std::string root() const { return folder_.path("."); }

  TempFolder folder_;
};

TEST_F(DeviceListTest, SerialPortsWithHardwareBehindThem) {
  link("sys/class/tty/ttyUSB10/device/driver", "../../bus/usb-serial/drivers/ftdi_sio");
  link("sys/class/tty/ttyUSB2/device/driver", "../../bus/usb-serial/drivers/ch341-uart");
  link("dev/serial/by-id/usb-FTDI_FT232R_A1-if00", "../../ttyUSB10");
  link("sys/class/tty/ttyS0/device/driver", "../../bus/platform/drivers/serial8250");
  file("sys/class/tty/ttyS0/type", "4\n");
  link("sys/class/tty/ttyS1/device/driver", "../../bus/platform/drivers/serial8250");
  file("sys/class/tty/ttyS1/type", "0\n");  // no UART
  file("sys/class/tty/tty7/dev", "4:7\n");  // a console
  const auto ports = list_serial_ports(root());
  ASSERT_EQ(ports.size(), 3U);
  EXPECT_EQ(ports[0].path, "/dev/ttyS0");
  EXPECT_EQ(ports[1].path, "/dev/ttyUSB2");
  EXPECT_EQ(ports[1].name, "ch341-uart");
  EXPECT_EQ(ports[2].path, "/dev/ttyUSB10");
  EXPECT_EQ(ports[2].name, "ftdi_sio, /dev/serial/by-id/usb-FTDI_FT232R_A1-if00");
}

TEST_F(DeviceListTest, SensorsThatTellDirections) {
  file("sys/bus/iio/devices/iio:device0/name", "bmp280\n");  // a barometer
  file("sys/bus/iio/devices/iio:device0/in_pressure_raw");
  file("sys/bus/iio/devices/iio:device1/name", "lsm303dlhc_magn\n");
  file("sys/bus/iio/devices/iio:device1/in_magn_x_raw");
  file("sys/bus/iio/devices/iio:device2/name", "icm20948\n");
  file("sys/bus/iio/devices/iio:device2/in_magn_x_raw");
  file("sys/bus/iio/devices/iio:device2/in_accel_x_raw");
  const auto sensors = list_iio_sensors(root());
  ASSERT_EQ(sensors.size(), 2U);
  EXPECT_EQ(sensors[0].path, "iio:device1");
  EXPECT_EQ(sensors[0].name, "lsm303dlhc_magn, magnetometer");
  EXPECT_EQ(sensors[1].name, "icm20948, magnetometer, accelerometer");
}

TEST_F(DeviceListTest, PwmChips) {
  file("sys/class/pwm/pwmchip0/npwm", "2\n");
  const auto chips = list_pwm_chips(root());
  ASSERT_EQ(chips.size(), 1U);
  EXPECT_EQ(chips[0].path, "pwmchip0");
  EXPECT_EQ(chips[0].name, "2 channels");
}

TEST_F(DeviceListTest, AMachineWithNothingSaysSo) {
  const DeviceList list = list_devices(folder_.path("nowhere"));
  const std::string text = device_list_text(list);
  EXPECT_NE(text.find("Serial ports (drivers: quicksilver os5000)\n  none\n"), std::string::npos) << text;
  EXPECT_EQ(device_list_json(list).dump(), R"({"cameras":[],"serial_ports":[],"iio_sensors":[],"pwm_chips":[]})");
}

}  // namespace
}  // namespace lakshya

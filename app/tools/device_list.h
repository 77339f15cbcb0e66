// What of the machine a driver could use: `lakshya devices`.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lakshya {

struct FoundDevice {
  std::string path;  // what the configuration wants: /dev/ttyUSB0, iio:device0, pwmchip0
  std::string name;  // what it says it is
};

// Under `root` ("" for the machine itself), in the order of their paths: cameras of Video4Linux2 with what they offer; ports with hardware behind them; sensors with a
// magnetometer or an accelerometer; chips, with their number of channels.
std::vector<FoundDevice> list_cameras(const std::string& root);
std::vector<FoundDevice> list_serial_ports(const std::string& root);
std::vector<FoundDevice> list_iio_sensors(const std::string& root);
std::vector<FoundDevice> list_pwm_chips(const std::string& root);

struct DeviceList {
  std::vector<FoundDevice> cameras;
  std::vector<FoundDevice> serial_ports;
  std::vector<FoundDevice> iio_sensors;
  std::vector<FoundDevice> pwm_chips;
};

DeviceList list_devices(const std::string& root);

// {"cameras": [{"path", "name"}], "serial_ports": .., "iio_sensors": .., "pwm_chips": ..}
nlohmann::ordered_json device_list_json(const DeviceList& list);

// With the drivers that this program has.
std::string device_list_text(const DeviceList& list);

}  // namespace lakshya

#include "app/tools/device_list.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "app/core/devices.h"
#include "app/core/frame_lists.h"
#include "app/core/vehicle_config_text.h"
#include "hal/camera/v4l2_list.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;

// One line of a file of sysfs; empty where there is none.
std::string attribute(const fs::path& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  return line;
}

// Entries of a folder whose names begin so, in natural order; none where there is no such folder.
std::vector<fs::path> entries(const fs::path& folder, const std::string& prefix) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().filename().string().starts_with(prefix)) found.push_back(entry.path());
  }
  std::ranges::sort(found,
                    [](const fs::path& a, const fs::path& b) { return natural_less(a.string(), b.string()); });
  return found;
}

// What udev calls the port, for adapters that are plugged in: it stays when the number changes.
std::string name_by_id(const std::string& root, const std::string& port) {
  for (const fs::path& link : entries(root + "/dev/serial/by-id", "")) {
    std::error_code error;
    if (fs::read_symlink(link, error).filename() == port) return "/dev/serial/by-id/" + link.filename().string();
  }
  return {};
}

template <class List>
void append(std::ostringstream& out, const char* what, const std::vector<FoundDevice>& found, const List& drivers) {
  out << what << " (drivers:";
  for (const auto& driver : drivers)
    out << ' ' << driver;
  out << ")\n";
  if (found.empty()) out << "  none\n";
  for (const FoundDevice& device : found)
    out << "  " << std::left << std::setw(20) << device.path << " " << device.name << '\n';
}

nlohmann::ordered_json json_of(const std::vector<FoundDevice>& found) {
  auto json = nlohmann::ordered_json::array();
  for (const FoundDevice& device : found)
    json.push_back({{"path", device.path}, {"name", device.name}});
  return json;
}

}  // namespace

std::vector<FoundDevice> list_serial_ports(const std::string& root) {
  std::vector<FoundDevice> found;
  for (const fs::path& tty : entries(root + "/sys/class/tty", "tty")) {
    std::error_code error;
    if (!fs::exists(tty / "device", error)) continue;  // a console or a pseudo-terminal
    if (attribute(tty / "type") == "0") continue;      // a place for a UART, with none in it
    const std::string port = tty.filename().string();
    const std::string driver = fs::read_symlink(tty / "device" / "driver", error).filename().string();
    const std::string id = name_by_id(root, port);
    FoundDevice device{"/dev/" + port, driver};
    if (!id.empty()) device.name.append(", ").append(id);
    found.push_back(device);
  }
  return found;
}

std::vector<FoundDevice> list_iio_sensors(const std::string& root) {
  std::vector<FoundDevice> found;
  for (const fs::path& device : entries(root + "/sys/bus/iio/devices", "iio:device")) {
    std::error_code error;
    const bool magnetometer = fs::exists(device / "in_magn_x_raw", error);
    const bool accelerometer = fs::exists(device / "in_accel_x_raw", error);
    if (!magnetometer && !accelerometer) continue;
    std::string name = attribute(device / "name");
    if (magnetometer) name += ", magnetometer";
    if (accelerometer) name += ", accelerometer";
    found.push_back({device.filename().string(), name});
  }
  return found;
}

std::vector<FoundDevice> list_pwm_chips(const std::string& root) {
  std::vector<FoundDevice> found;
  for (const fs::path& chip : entries(root + "/sys/class/pwm", "pwmchip"))
    found.push_back({chip.filename().string(), attribute(chip / "npwm") + " channels"});
  return found;
}

std::vector<FoundDevice> list_cameras(const std::string& root) {
  std::vector<FoundDevice> found;
  for (const V4l2Listed& camera : list_v4l2(linux_system_calls(), root + "/dev/video")) {
    std::string text = camera.card + camera.problem;
    for (const V4l2Offer& offer : camera.offers) {
      text.append(", ")
          .append(offer.format)
          .append(offer.up_to ? " up to " : " ")
          .append(std::to_string(offer.width));
      text.append("x").append(std::to_string(offer.height));
      for (std::size_t i = 0; i < offer.fps.size(); ++i)
        text.append(i == 0 ? " at " : "/").append(number_text(std::round(offer.fps[i] * 100) / 100));
    }
    found.push_back({camera.path, text});
  }
  return found;
}

DeviceList list_devices(const std::string& root) {
  return {.cameras = list_cameras(root),
          .serial_ports = list_serial_ports(root),
          .iio_sensors = list_iio_sensors(root),
          .pwm_chips = list_pwm_chips(root)};
}

nlohmann::ordered_json device_list_json(const DeviceList& list) {
  return {{"cameras", json_of(list.cameras)},
          {"serial_ports", json_of(list.serial_ports)},
          {"iio_sensors", json_of(list.iio_sensors)},
          {"pwm_chips", json_of(list.pwm_chips)}};
}

std::string device_list_text(const DeviceList& list) {
  using Words = std::vector<std::string>;
  std::ostringstream out;
  append(out, "Cameras", list.cameras, Words{"v4l2", "dc1394 (on IEEE 1394, not listed)"});
  append(out, "Serial ports", list.serial_ports, Words{"quicksilver", "os5000"});
  append(out, "IIO sensors", list.iio_sensors, Words{"iio"});
  append(out, "PWM chips", list.pwm_chips, Words{"pwm"});
  return out.str();
}

}  // namespace lakshya

#include "app/tools/devices_command.h"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>

#include "app/core/devices.h"
#include "app/core/input_error.h"
#include "app/core/vehicle_config_file.h"
#include "app/lakshyad/options.h"
#include "app/tools/device_check.h"
#include "app/tools/device_list.h"
#include "hal/clock/monotonic_clock.h"

namespace lakshya {
namespace {

struct DevicesOptions {
  std::string test;
  ConfigOptions config;
  double seconds = 3;
  double drive_mps = 0;
  bool json = false;
};

// Whoever sees the wrong wheel turn presses Ctrl-C: the wheels must not go on turning then.
std::atomic<bool> interrupt_flag = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal may come at any time");

void on_signal(int /*number*/) {
  interrupt_flag = true;
}

// Not the names that stand for no device, or for a simulator's.
bool is_of_a_device(std::string_view driver) {
  return driver != "none" && driver != "sim";
}

template <class Kind>
bool has(std::span<const Driver<Kind>> drivers, const std::string& name) {
  return is_of_a_device(name) && std::ranges::find(drivers, name, &Driver<Kind>::name) != drivers.end();
}

template <class Kind>
Kind& existing(const Made<Kind>& made, const std::string& name) {
  if (made.device == nullptr) throw InputError("--test " + name, "there is no device to test (name its driver)");
  return *made.device;
}

// NAME is a driver's, or the kind of device whose driver the configuration names.
DeviceCheck check(const DevicesOptions& o) {
  VehicleConfig config = load_vehicle_config(o.config.config, o.config.profile, o.config.sets);
  const CheckSettings settings{.seconds = o.seconds, .speed_mps = o.drive_mps, .interrupt = &interrupt_flag};
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    (void)std::signal(number, on_signal);
  MonotonicClock clock;
  const std::string& name = o.test;
  if (name == "camera" || has(camera_drivers(), name)) {
    if (name != "camera") config.drivers.camera = name;
    const Made<StereoCamera> made = make_camera(config, clock);
    return check_camera(existing(made, name), clock, settings);
  }
  if (name == "compass" || has(compass_drivers(), name)) {
    if (name != "compass") config.drivers.compass = name;
    const Made<Compass> made = make_compass(config, clock);
    return check_compass(existing(made, name), clock, settings);
  }
  if (name == "servo" || has(servo_drivers(), name)) {
    if (name != "servo") config.drivers.servo = name;
    const Made<Servo> made = make_servo(config, clock);
    if (o.drive_mps > 0) {
      spdlog::warn("the wheels are about to turn");
    } else {
      spdlog::info("no wheel is turned; --drive 0.1 turns them (lift the vehicle off the ground first)");
    }
    return check_servo(existing(made, name), clock, settings);
  }
  std::string names = "camera, servo, compass";
  const auto add = [&names](const auto& drivers) {
    for (const auto& driver : drivers) {
      if (is_of_a_device(driver.name)) names.append(", ").append(driver.name);
    }
  };
  add(camera_drivers());
  add(servo_drivers());
  add(compass_drivers());
  throw InputError("--test " + name, "there is no such driver (there are: " + names + ")");
}

void test_device(const DevicesOptions& o) {
  const DeviceCheck result = check(o);
  if (o.json) {
    nlohmann::ordered_json json{{"device", o.test}, {"ok", result.fault.empty()}, {"fault", result.fault}};
    json.update(result.facts);
    std::cout << json.dump() << '\n';
  } else {
    std::cout << o.test << ": " << (result.fault.empty() ? "ok" : "at fault: " + result.fault) << '\n'
              << device_check_text(result);
  }
  if (!result.fault.empty()) throw CLI::RuntimeError(1);
}

void run(const DevicesOptions& o) {
  if (!o.test.empty()) return test_device(o);
  const DeviceList list = list_devices("");
  std::cout << (o.json ? device_list_json(list).dump() + "\n" : device_list_text(list));
}

}  // namespace

void add_devices_command(CLI::App& app) {
  auto options = std::make_shared<DevicesOptions>();
  CLI::App* command =
      app.add_subcommand("devices", "Which cameras, ports and sensors are there, and do they work?");
  auto* test = command->add_option(
      "--test", options->test, "Try one device: camera, servo or compass as configured, or a driver by its name");
  add_config_options(*command, options->config);
  command->add_option("--seconds", options->seconds, "For how long")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 3600.0))
      ->needs(test);
  command
      ->add_option("--drive", options->drive_mps,
                   "Servo: turn the wheels at this speed, m/s (lift the vehicle off the ground first)")
      ->check(CLI::Range(0.01, 2.0))
      ->needs(test);
  command->add_flag("--json", options->json, "Print JSON");
  command->footer(
      "Exit code 1: the device is at fault, and the output says how. Without --drive no wheel turns.\n"
      "Example: lakshya devices --test os5000 --set os5000.port=/dev/ttyUSB0\n"
      "         lakshya devices --test servo --config vehicle.yaml --drive 0.1");
  command->callback([options] { run(*options); });
}

}  // namespace lakshya

#include "app/lakshyad/stop_motors_command.h"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/core/devices.h"
#include "app/core/input_error.h"
#include "app/core/vehicle_config_file.h"
#include "app/lakshyad/options.h"
#include "hal/clock/monotonic_clock.h"

namespace lakshya {
namespace {

constexpr Nanoseconds kTime = 100 * kMillisecond;

void stop_motors(const ConfigOptions& o) {
  const VehicleConfig config = load_vehicle_config(o.config, o.profile, o.sets);
  MonotonicClock clock;
  const Made<Servo> servo = make_servo(config, clock);
  const std::string name = "drivers.servo: " + config.drivers.servo;
  // Opening stops them already, and fails where that cannot be proved; they are told again whatever it said.
  const Status opened = servo.device->open();
  const std::string problem = servo.device->problem();
  const Status stopped = servo.device->stop(clock.now() + kTime);
  servo.device->close();
  if (opened != Status::ok) throw InputError(name, std::string(to_string(opened)) + ": " + problem);
  if (stopped != Status::ok)
    throw InputError(name, std::string(to_string(stopped)) + ": " + servo.device->problem());
  spdlog::info("the drives have confirmed zero speed");
}

}  // namespace

void add_stop_motors_command(CLI::App& app) {
  auto o = std::make_shared<ConfigOptions>();
  CLI::App* command = app.add_subcommand("stop-motors", "Tell the drives to stop, whatever state they are in");
  add_config_options(*command, *o);
  command->footer("Exit code 1: they have not confirmed it. For ExecStopPost= of the service, and for people.");
  command->callback([o] { stop_motors(*o); });
}

}  // namespace lakshya

#include "app/tools/compass_command.h"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <bitset>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "app/core/devices.h"
#include "app/core/input_error.h"
#include "app/core/vehicle_config_file.h"
#include "app/core/vehicle_config_text.h"
#include "app/lakshyad/options.h"
#include "app/tools/progress.h"
#include "hal/clock/monotonic_clock.h"

namespace lakshya {
namespace {

struct CompassOptions {
  bool calibrate = false;
  ConfigOptions config;
  double seconds = 60;
  std::string root = "/sys/bus/iio/devices";
  bool json = false;
};

constexpr double kPi = std::numbers::pi;
constexpr int kDirectionStep = 10;  // degrees

std::vector<Vector3> collect(IioCompass& compass, const CompassOptions& o) {
  MonotonicClock clock;
  std::vector<Vector3> samples;
  Progress progress(static_cast<std::size_t>(std::ceil(o.seconds)));
  const Nanoseconds start = clock.now();
  const Nanoseconds end = start + std::llround(o.seconds * static_cast<double>(kSecond));
  Nanoseconds next_line = start;
  while (clock.now() < end) {
    FieldSample sample;
    if (compass.read_field(end, sample) == Status::ok) samples.push_back(sample.field_gauss);
    if (clock.now() < next_line) continue;
    next_line += kSecond;
    progress.next("s: turn on the spot; seen " + std::to_string(directions_seen_deg(samples)) + " of 360 degrees");
  }
  return samples;
}

nlohmann::ordered_json fit_json(const MagnetometerFit& fit, std::size_t samples) {
  return {{"samples", samples},         {"hard_iron_gauss", fit.hard_iron}, {"soft_iron", fit.soft_iron},
          {"radius_gauss", fit.radius}, {"axis_ratio", fit.axis_ratio},     {"residual", fit.residual},
          {"outliers", fit.outliers},   {"coverage_deg", fit.coverage_deg}};
}

void calibrate(const CompassOptions& o) {
  const VehicleConfig config = load_vehicle_config(o.config.config, o.config.profile, o.config.sets);
  IioCompassSettings settings = iio_settings(config);
  settings.root = o.root;
  settings.rate_hz = std::max(settings.rate_hz, 20.0);  // more samples than driving needs
  MonotonicClock clock;
  IioCompass compass(settings, linux_system_calls(), clock);
  if (const Status opened = compass.open(); opened != Status::ok)
    throw InputError("iio", std::string(to_string(opened)) + ": " + compass.problem());
  spdlog::info("turn the vehicle on the spot, on level ground, once or twice round in {} s", o.seconds);
  const std::vector<Vector3> samples = collect(compass, o);
  MagnetometerFit fit;
  const Status status = fit_magnetometer(samples, {}, fit);
  if (status != Status::ok) {
    throw InputError("calibration", std::string(to_string(fit.refusal)) + " (" + std::to_string(samples.size()) +
                                        " samples, " + number_text(std::round(fit.coverage_deg)) + " degrees, " +
                                        number_text(std::round(fit.residual * 1000) / 10) +
                                        " % residual; turn further and more slowly, away from iron and motors)");
  }
  if (o.json) {
    std::cout << fit_json(fit, samples.size()).dump() << '\n';
    return;
  }
  spdlog::info("{} samples over {:.0f} degrees; field {:.3f} gauss, residual {:.1f} %, outliers {:.1f} %",
               samples.size(), fit.coverage_deg, fit.radius, 100 * fit.residual, 100 * fit.outliers);
  std::cout << calibration_yaml(fit);
}

}  // namespace

int directions_seen_deg(std::span<const Vector3> samples) {
  if (samples.empty()) return 0;
  const auto middle = [&](std::size_t axis) {
    const auto [least, most] =
        std::ranges::minmax(samples, {}, [axis](const Vector3& sample) { return sample[axis]; });
    return (least[axis] + most[axis]) / 2;
  };
  const double x = middle(0);
  const double y = middle(1);
  std::bitset<360 / kDirectionStep> seen;
  for (const Vector3& sample : samples) {
    const double turn = std::atan2(sample[1] - y, sample[0] - x) / (2 * kPi) + 0.5;  // 0 to 1
    seen.set(std::min(static_cast<std::size_t>(turn * static_cast<double>(seen.size())), seen.size() - 1));
  }
  return static_cast<int>(seen.count()) * kDirectionStep;
}

std::string calibration_yaml(const MagnetometerFit& fit) {
  // More digits than any magnetometer has.
  const auto line = [](const char* key, double value) {
    return std::string("  ") + key + ": " + number_text(std::round(value * 1e6) / 1e6) + "\n";
  };
  const Matrix3& m = fit.soft_iron;
  return "iio:\n" + line("hard_iron_x_gauss", fit.hard_iron[0]) + line("hard_iron_y_gauss", fit.hard_iron[1]) +
         line("hard_iron_z_gauss", fit.hard_iron[2]) + line("soft_iron_xx", m[0]) + line("soft_iron_xy", m[1]) +
         line("soft_iron_xz", m[2]) + line("soft_iron_yy", m[4]) + line("soft_iron_yz", m[5]) +
         line("soft_iron_zz", m[8]);
}

void add_compass_command(CLI::App& app) {
  auto options = std::make_shared<CompassOptions>();
  CLI::App* command = app.add_subcommand("compass", "Calibrate a magnetometer in its vehicle");
  command->add_flag("--calibrate", options->calibrate, "Fit hard and soft iron from a turn on the spot")
      ->required();
  add_config_options(*command, options->config);
  command->add_option("--seconds", options->seconds, "For how long samples are taken")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 600.0));
  command->add_option("--sysfs", options->root, "Where the sensors are")->capture_default_str();
  command->add_flag("--json", options->json, "Print JSON instead of the lines for vehicle.yaml");
  command->footer(
      "Prints the group \"iio\" for vehicle.yaml; the sensor and its axes are those of the configuration.\n"
      "Example: lakshya compass --calibrate --config vehicle.yaml");
  command->callback([options] { calibrate(*options); });
}

}  // namespace lakshya

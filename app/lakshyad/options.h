// Command-line options that several subcommands share.
#pragma once

#include <string>
#include <vector>

#include "app/core/kernel_table.h"
#include "app/core/vehicle_config.h"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace lakshya {

struct ConfigOptions {
  std::string config;
  std::string profile;
  std::vector<std::string> sets;
};

// --config, --profile, --set
void add_config_options(CLI::App& command, ConfigOptions& options);

// --backend, --isa
struct KernelOptions {
  std::string backend = "simd";
  std::string isa = "best";
};
void add_kernel_options(CLI::App& command, KernelOptions& options);

// The kernels chosen; their instruction set is in use from now on. Throws InputError for what this machine has not.
KernelTable choose_kernels(const KernelOptions& options);

// Matchers search a multiple of 16 disparities.
constexpr int round_up_to_16(int n) {
  return (n + 15) / 16 * 16;
}

// Degrees from -180 to 180; CLI::Range lets "nan" through.
CLI::Validator angle_in_degrees();

// The configuration's recording: a sequence, or left and right images or folders. Calibration: a file, two, or a folder; none: the
// configuration's own.
void name_recording(VehicleConfig& config, const std::vector<std::string>& source,
                    const std::vector<std::string>& calibration);

}  // namespace lakshya

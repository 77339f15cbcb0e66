// Command-line options that several subcommands share.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace lakshya {

struct ConfigOptions {
  std::string config;
  std::string profile;
  std::vector<std::string> sets;
};

// --config, --profile, --set
void add_config_options(CLI::App& command, ConfigOptions& options);

// Degrees from -180 to 180; CLI::Range lets "nan" through.
CLI::Validator angle_in_degrees();

}  // namespace lakshya

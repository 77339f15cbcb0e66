#include "app/tools/config_command.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "app/core/vehicle_config_file.h"
#include "app/core/vehicle_config_text.h"
#include "app/lakshyad/options.h"

namespace lakshya {
namespace {

struct Options {
  ConfigOptions config;
  bool markdown = false;
};

std::string config_text(const Options& options) {
  if (options.markdown) return markdown_table();
  const auto& [file, profile, sets] = options.config;
  if (file.empty() && profile.empty() && sets.empty()) return documented_yaml();
  return effective_yaml(load_vehicle_config(file, profile, sets));
}

}  // namespace

void add_config_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("config", "Print the configuration with unit, range and meaning of every key");
  add_config_options(*command, options->config);
  command->add_flag("--markdown", options->markdown, "Print the table of keys instead")
      ->excludes("--config", "--profile", "--set");
  command->footer(
      "Without an option: every key with its default, and the built-in profiles, as a file to start from.\n"
      "Example: lakshya config --config vehicle.yaml --profile indoor --set camera.height_m=0.45");
  command->callback([options] { std::cout << config_text(*options); });
}

}  // namespace lakshya

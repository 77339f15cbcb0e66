#include "app/tools/options.h"

namespace lakshya {

void add_config_options(CLI::App& command, ConfigOptions& options) {
  command.add_option("--config", options.config, "Vehicle configuration (without: built-in defaults)")
      ->type_name("FILE");
  command.add_option("--profile", options.profile,
                     "Profile to apply: outdoor, indoor or one that the file defines");
  command.add_option("--set", options.sets, "Override one value; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

CLI::Validator angle_in_degrees() {
  const auto check = [](const std::string& text) {
    double deg = 0;
    if (CLI::detail::lexical_cast(text, deg) && deg >= -180 && deg <= 180) return std::string();
    return text + " is not an angle from -180 to 180 degrees";
  };
  return {check, "DEG in -180..180"};
}

}  // namespace lakshya

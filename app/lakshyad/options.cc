#include "app/lakshyad/options.h"

#include <CLI/CLI.hpp>
#include <filesystem>

#include "app/core/input_error.h"
#include "kernels/base/isa.h"

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

void add_kernel_options(CLI::App& command, KernelOptions& options) {
  command
      .add_option("--backend", options.backend,
                  "Kernels: simd (default), or ref, the scalar reference; exceptions after it: simd,sgm=ref")
      ->type_name("NAME");
  command.add_option("--isa", options.isa, "Instruction set of the simd kernels: best (default), avx2, ...")
      ->type_name("NAME");
}

KernelTable choose_kernels(const KernelOptions& options) {
  if (use_isa(options.isa) != Status::ok) {
    std::string names;
    for (const char* name : available_isas())
      names += (names.empty() ? "" : ", ") + std::string(name);
    throw InputError("instruction set", "'" + options.isa + "' is not to be had here (there are: " + names + ")");
  }
  return kernels_by_name(options.backend);
}

CLI::Validator angle_in_degrees() {
  const auto check = [](const std::string& text) {
    double deg = 0;
    if (CLI::detail::lexical_cast(text, deg) && deg >= -180 && deg <= 180) return std::string();
    return text + " is not an angle from -180 to 180 degrees";
  };
  return {check, "DEG in -180..180"};
}

void name_recording(VehicleConfig& config, const std::vector<std::string>& source,
                    const std::vector<std::string>& calibration) {
  const bool two = source.size() == 2;
  config.folder.path = two ? "" : source[0];
  config.folder.left = two ? source[0] : "";
  config.folder.right = two ? source[1] : "";
  if (calibration.empty()) return;
  config.camera.calibration.clear();
  for (const std::string& path : calibration)
    config.camera.calibration +=
        (config.camera.calibration.empty() ? "" : ",") + std::filesystem::absolute(path).string();
}

}  // namespace lakshya

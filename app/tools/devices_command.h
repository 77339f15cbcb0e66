// `lakshya devices`: what is there, and does it work?
#pragma once

#include <CLI/CLI.hpp>

namespace lakshya {

void add_devices_command(CLI::App& app);

}  // namespace lakshya

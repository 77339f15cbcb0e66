// `lakshya process`: one stereo pair to disparity, navigation map, steering decision and pictures.
#pragma once

#include <CLI/CLI.hpp>

namespace lakshya {

void add_process_command(CLI::App& app);

}  // namespace lakshya

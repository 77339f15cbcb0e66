// `stop-motors`: zero to the drives and nothing else, for after a crash.
#pragma once

#include <CLI/CLI.hpp>

namespace lakshya {

void add_stop_motors_command(CLI::App& app);

}  // namespace lakshya

// lakshya sim: the firmware's own loop drives a simulated vehicle.
#pragma once

#include <CLI/CLI.hpp>

namespace lakshya {

void add_sim_command(CLI::App& app, char** argv);

}  // namespace lakshya

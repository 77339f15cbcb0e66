// lakshya sim: the firmware's own loop drives a simulated vehicle.
#pragma once

namespace CLI {
class App;
}

namespace lakshya {

void add_sim_command(CLI::App& app, char** argv);

}  // namespace lakshya

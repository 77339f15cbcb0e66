// `run`: the firmware itself, on the vehicle's devices. `replay`: the same loop on recorded pairs, without a vehicle.
#pragma once

namespace CLI {
class App;
}

namespace lakshya {

// argv: the program's, which is started anew where OpenMP lacks its settings (app/loop/real_time.h).
void add_run_command(CLI::App& app, char** argv);
void add_replay_command(CLI::App& app, char** argv);

}  // namespace lakshya

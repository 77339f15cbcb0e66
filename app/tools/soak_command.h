// `lakshya soak`: the endurance test.
#pragma once

namespace CLI {
class App;
}

namespace lakshya {

void add_soak_command(CLI::App& app, char** argv);

}  // namespace lakshya

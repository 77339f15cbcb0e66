// `stop-motors`: zero to the drives and nothing else, for after a crash.
#pragma once

namespace CLI {
class App;
}

namespace lakshya {

void add_stop_motors_command(CLI::App& app);

}  // namespace lakshya

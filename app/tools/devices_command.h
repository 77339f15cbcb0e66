// `lakshya devices`: what is there, and does it work?
#pragma once

namespace CLI {
class App;
}

namespace lakshya {

void add_devices_command(CLI::App& app);

}  // namespace lakshya

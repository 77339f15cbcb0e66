// `lakshya process`: one stereo pair to disparity, navigation map, steering decision and pictures.
#pragma once

namespace CLI {
class App;
}

namespace lakshya {

void add_process_command(CLI::App& app);

}  // namespace lakshya

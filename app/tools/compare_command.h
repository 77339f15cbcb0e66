// `lakshya compare`: is the fast path right? The scalar reference beside every instruction set, stage by stage.
#pragma once

namespace CLI {
class App;
}

namespace lakshya {

void add_compare_command(CLI::App& app);

}  // namespace lakshya

// `self-test`: does this machine compute what it should?
#pragma once

namespace CLI {
class App;
}

namespace lakshya {

void add_self_test_command(CLI::App& app);

}  // namespace lakshya

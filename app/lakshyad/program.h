// What both programs' main() do: log to stderr, one subcommand, errors to exit codes.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace lakshya {

// Exit code: 0 done, 1 input refused (or a command's own verdict), 2 wrong usage.
int run_program(const char* name, int argc, char** argv, const std::function<void(CLI::App&)>& add_commands);

}  // namespace lakshya

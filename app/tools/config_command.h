// `lakshya config`: prints the configuration.
#pragma once

namespace CLI {
class App;
}

namespace lakshya {

// Adds the subcommand. Its callback writes to std::cout and throws InputError for a refused configuration.
void add_config_command(CLI::App& app);

}  // namespace lakshya

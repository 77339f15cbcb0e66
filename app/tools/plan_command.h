// `lakshya plan`: from a map in a file to a direction and a speed.
#pragma once

namespace CLI {
class App;
}

namespace lakshya {

// Adds the subcommand. Its callback writes to std::cout and throws InputError for a refused map or configuration;
// angles that are not from -180 to 180 degrees are a CLI::ValidationError.
void add_plan_command(CLI::App& app);

}  // namespace lakshya

// `lakshya profile`: how long does a frame take, and where do its pixels go?
#pragma once

namespace CLI {
class App;
}

namespace lakshya {

void add_profile_command(CLI::App& app);

}  // namespace lakshya

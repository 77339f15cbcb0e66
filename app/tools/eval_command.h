// `lakshya eval`: matchers against the ground truth of one pair.
#pragma once

namespace CLI {
class App;
}

namespace lakshya {

void add_eval_command(CLI::App& app);

}  // namespace lakshya

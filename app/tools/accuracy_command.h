// `lakshya accuracy`: all matchers on a list of pairs with ground truth.
#pragma once

namespace CLI {
class App;
}

namespace lakshya {

void add_accuracy_command(CLI::App& app);

}  // namespace lakshya

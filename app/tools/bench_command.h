// `lakshya bench`: how fast we are, beside OpenCV and our own scalar reference.
#pragma once

namespace CLI {
class App;
}

namespace lakshya {

void add_bench_command(CLI::App& app);

}  // namespace lakshya

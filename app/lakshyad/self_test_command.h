// `self-test`: does this machine compute what it should?
#pragma once

#include <CLI/CLI.hpp>

namespace lakshya {

void add_self_test_command(CLI::App& app);

}  // namespace lakshya

// Worlds in YAML; docs/worlds.md has the keys.
#pragma once

#include <string>
#include <string_view>

#include "app/tools/sim/world.h"

namespace lakshya::sim {

// A file of at most 1 MiB. Throws InputError ("file:line: what: why (what to do)") for broken YAML, unknown or repeated keys,
// values of the wrong type or out of range, names given twice, and for a start or goal where the vehicle would touch something.
World read_world(const std::string& path);

// The same for a file's content; `source` stands for the path in messages.
World parse_world(std::string_view text, const std::string& source);

}  // namespace lakshya::sim

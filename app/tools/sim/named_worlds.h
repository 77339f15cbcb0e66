// The worlds that are built in: the paper's scenes and one for each hard case. Written as world files (world_file.h).
#pragma once

#include <span>
#include <string_view>

#include "app/tools/sim/world.h"

namespace lakshya::sim {

std::span<const std::string_view> world_names();

// Throws InputError with the known names for any other.
World named_world(std::string_view name);

// The world file itself: something to copy from. Throws likewise.
std::string_view named_world_text(std::string_view name);

}  // namespace lakshya::sim

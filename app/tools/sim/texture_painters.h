// Paints one material on a canvas (textures.h). Start-up only.
#pragma once

#include <cstdint>

#include "app/tools/sim/surface.h"
#include "app/tools/sim/texture_canvas.h"

namespace lakshya::sim {

// Normalised: mean 0.5, clamped to [0, 1].
TextureCanvas painted_texture(Texture texture, std::uint32_t seed);
TextureCanvas painted_clouds();

}  // namespace lakshya::sim

// How a surface of the simulated world looks. Plain data.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace lakshya::sim {

// Procedural, grey, made once per seed (textures.h). All but `plain` have detail at several sizes.
enum class Texture : std::uint8_t {
  plain,      // a painted wall: next to nothing to match
  plaster,    // a rough wall
  wallpaper,  // the same figure every scale_m: repetitive
  brick,
  concrete,
  wood,
  carpet,
  tiles,  // with joints, every scale_m
  gravel,
  grass,
  asphalt,
  paper,  // printed: a newspaper
  cardboard,
  cloth,
  leaves,
  metal,
};

inline constexpr std::array<std::string_view, 16> kTextureNames{
    "plain",  "plaster", "wallpaper", "brick", "concrete",  "wood",  "carpet", "tiles",
    "gravel", "grass",   "asphalt",   "paper", "cardboard", "cloth", "leaves", "metal"};

struct Surface {
  Texture texture = Texture::plaster;
  float albedo = 0.5F;    // mean share of light that comes back, 0..1
  float contrast = 0.5F;  // 0: even; 1: the texture's full range
  float scale_m = 1;      // size of the texture's figure, > 0
  std::uint32_t seed = 1;
  friend bool operator==(const Surface&, const Surface&) = default;
};

}  // namespace lakshya::sim

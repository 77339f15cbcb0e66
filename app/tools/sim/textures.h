// Procedural grey textures of materials, as pyramids that a ray can be shaded from.
//
// A picture of 512 x 512 wraps around without a seam, mean 0.5 of [0, 1], standard deviation near 0.2 (plain: 0.01). Made once
// per (texture, seed mod 4) and kept for the life of the program; the same numbers on every machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "app/tools/sim/surface.h"

namespace lakshya::sim {

class TexturePicture {
 public:
  static constexpr int kSide = 512;   // px of level 0
  static constexpr int kLevels = 10;  // 512 .. 1

  explicit TexturePicture(const std::vector<float>& level0);

  // Bilinear, of one level, at (u, v) in pictures: the picture lies in [0, 1) x [0, 1) and repeats. |u|, |v| < 2^20.
  float sample(float u, float v, int level) const {
    const int side = kSide >> level;
    const float x = u * static_cast<float>(side) - 0.5F;
    const float y = v * static_cast<float>(side) - 0.5F;
    const int ix = floor_of(x);
    const int iy = floor_of(y);
    const float fx = x - static_cast<float>(ix);
    const float fy = y - static_cast<float>(iy);
    const int mask = side - 1;
    const std::uint16_t* const picture = texels_.data() + kStart[static_cast<std::size_t>(level)];
    const std::uint16_t* const upper = picture + (iy & mask) * side;
    const std::uint16_t* const lower = picture + ((iy + 1) & mask) * side;
    const int left = ix & mask;
    const int right = (ix + 1) & mask;
    const auto mix = [](float a, float b, float t) { return a + t * (b - a); };
    return mix(mix(upper[left], upper[right], fx), mix(lower[left], lower[right], fx), fy) * (1.0F / 65535);
  }

  // The same between the two levels next to `level` (any number; clamped).
  float sample_between(float u, float v, float level) const {
    if (level <= 0) return sample(u, v, 0);
    if (level >= kLevels - 1) return sample(u, v, kLevels - 1);
    const int low = static_cast<int>(level);
    const float t = level - static_cast<float>(low);
    const float fine = sample(u, v, low);
    return fine + t * (sample(u, v, low + 1) - fine);
  }

  float texel(int x, int y) const { return texels_[static_cast<std::size_t>(y * kSide + x)] * (1.0F / 65535); }

 private:
  static int floor_of(float x) {
    const int i = static_cast<int>(x);
    return i - (x < static_cast<float>(i) ? 1 : 0);
  }
  static constexpr std::array<int, kLevels + 1> kStart = [] {
    std::array<int, kLevels + 1> start{};
    for (std::size_t i = 0; i < kLevels; ++i)
      start[i + 1] = start[i] + (kSide >> i) * (kSide >> i);
    return start;
  }();

  std::vector<std::uint16_t> texels_;  // of all levels; 16 bits, or a plain wall would show steps
};

// How a picture lies on a surface whose Surface::scale_m is 1.
struct TextureLayout {
  float figures = 2;  // figures across a picture: the picture repeats every figures * scale_m
  // Irregular materials are sums of the picture at several sizes, turned against each other, so that they do not repeat and have
  // detail both near and far. Weights of the picture at its own size, 2.7 times finer, 5.3 times coarser.
  float own = 1, finer = 0, coarser = 0;
};
TextureLayout texture_layout(Texture texture);

// Thread-safe; the picture lives as long as the program.
const TexturePicture& texture_picture(Texture texture, std::uint32_t seed);

// Billows of cloud, 0..1, for the sky.
const TexturePicture& cloud_picture();

}  // namespace lakshya::sim

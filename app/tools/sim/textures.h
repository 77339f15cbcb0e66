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
  static constexpr int kSideBits = 9;
  static constexpr int kSide = 1 << kSideBits;  // px of level 0
  static constexpr int kLevels = 9;             // 512 .. 2

  explicit TexturePicture(const std::vector<float>& level0);

  // A place along one side in 2^-32 of a picture: whole pictures overflow and are gone. |u| < 2^38 pictures.
  static std::uint32_t fixed(float u) {
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(static_cast<std::int64_t>(u * 0x1p24F)) << 8);
  }

  // Bilinear, of one level below kLevels, weights in 1/256. Half of a shader's time passes here: integers only.
  float sample(std::uint32_t u, std::uint32_t v, int level) const {
    const int bits = kSideBits - level;
    const std::uint32_t mask = (1U << bits) - 1;
    const int shift = 32 - bits;
    const std::uint32_t half = 1U << (shift - 1);
    const std::uint32_t x = u - half;
    const std::uint32_t y = v - half;
    const std::uint32_t left = x >> shift;
    const std::uint32_t right = (left + 1) & mask;
    const std::uint32_t upper = y >> shift;
    const std::uint32_t lower = (upper + 1) & mask;
    const std::uint32_t fx = (x >> (shift - 8)) & 255;
    const std::uint32_t fy = (y >> (shift - 8)) & 255;
    const std::uint16_t* const picture = texels_.data() + kStart[static_cast<std::size_t>(level)];
    const std::uint16_t* const up = picture + (upper << bits);
    const std::uint16_t* const low = picture + (lower << bits);
    const std::uint32_t a = up[left] * (256 - fx) + up[right] * fx;
    const std::uint32_t b = low[left] * (256 - fx) + low[right] * fx;
    return static_cast<float>(static_cast<std::int32_t>((a * (256 - fy) + b * fy) >> 8)) *
           (1.0F / (65535 * 256.0F));
  }

  // The same between the two levels next to `level` (any number; clamped).
  float sample_between(std::uint32_t u, std::uint32_t v, float level) const {
    if (level <= 0) return sample(u, v, 0);
    if (level >= kLevels - 1) return sample(u, v, kLevels - 1);
    const int low = static_cast<int>(level);
    const float t = level - static_cast<float>(low);
    const float fine = sample(u, v, low);
    return fine + t * (sample(u, v, low + 1) - fine);
  }

  float texel(int x, int y) const { return texels_[static_cast<std::size_t>(y * kSide + x)] * (1.0F / 65535); }

 private:
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

// Frames of Point Grey's stereo format, made from two images.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/camera/bumblebee.h"
#include "kernels/base/image_view.h"

namespace lakshya::test {

inline std::vector<std::uint8_t> interleaved(ImageView<const std::uint8_t> first,
                                             ImageView<const std::uint8_t> second) {
  std::vector<std::uint8_t> bytes;
  for (int v = 0; v < first.height; ++v) {
    for (int u = 0; u < first.width; ++u) {
      bytes.push_back(first.at(u, v));
      bytes.push_back(second.at(u, v));
    }
  }
  return bytes;
}

// The colour of a place: 'R', 'G' or 'B', by the pattern's own letters.
inline char color_at(BayerPattern pattern, int u, int v) {
  const char* letters = pattern == BayerPattern::bggr   ? "BGGR"
                        : pattern == BayerPattern::rggb ? "RGGB"
                        : pattern == BayerPattern::grbg ? "GRBG"
                                                        : "GBRG";
  return letters[2 * (v % 2) + u % 2];
}

}  // namespace lakshya::test

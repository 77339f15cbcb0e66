// What can be seen of a raw pair before anything is done with it: is it black, saturated, the same as the one before?
#pragma once

#include <cstdint>

#include "kernels/base/image_view.h"

namespace lakshya {

struct BrightnessLevels {
  int dark = 8;      // at most this: black
  int bright = 250;  // at least this: saturated
};

// Of one image's pixels, 0 to 1.
struct BrightnessShares {
  double dark = 0;
  double bright = 0;
};

// Of an empty image both are 0.
BrightnessShares brightness_shares(ImageView<const std::uint8_t> image, const BrightnessLevels& levels);

// Copies an image into another of the same size and gives a number made of every pixel and its place: different numbers,
// different images (FNV-1a on words of 8 bytes, Fowler, Noll and Vo; four of them side by side).
std::uint64_t copy_and_hash(ImageView<const std::uint8_t> from, ImageView<std::uint8_t> to);

}  // namespace lakshya

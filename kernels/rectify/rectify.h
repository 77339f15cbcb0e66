// Rectification: bilinear remap of a raw image through fixed-point coordinate maps.
//
//   out(u,v) = sum over the four neighbours of raw at (map_x, map_y), bilinear weights
//
// The maps hold raw-image positions in 1/128 px (Q7): the rounding of a coordinate costs at most 1/256 px, and
// a weight of at most 128 times a grey value fits the 16-bit multiply-add of every SIMD instruction set.
// With a = x & 127, b = y & 127 the sum of weights is 2^14; out = (sum + 2^13) >> 14, exact integers.
// A neighbour outside the raw image counts as 0 (as OpenCV's BORDER_CONSTANT does).
#pragma once

#include <cstdint>

#include "kernels/base/image_view.h"
#include "kernels/base/status.h"

namespace lakshya {

inline constexpr int kRectifyFractionBits = 7;

// map_x, map_y and out agree in size; `rows` lie inside. `out` must not overlap `raw` or the maps.
// size_mismatch, bad_argument (rows outside).
Status rectify_ref(ImageView<const std::uint8_t> raw, ImageView<const std::int32_t> map_x,
                   ImageView<const std::int32_t> map_y, Rows rows, ImageView<std::uint8_t> out);

}  // namespace lakshya

// Rectification: bilinear remap of a raw image through fixed-point coordinate maps.
//
//   out(u,v) = sum over the four neighbours of raw at the map's position, bilinear weights
//
// The maps hold raw-image positions in 1/128 px (Q7): the rounding of a coordinate costs at most 1/256 px, and
// a weight of at most 128 times a grey value fits the 16-bit arithmetic of every SIMD instruction set.
// With a = x & 127, b = y & 127 the sum of weights is 2^14; out = (sum + 2^13) >> 14, exact integers.
// A neighbour outside the raw image counts as 0 (as OpenCV's BORDER_CONSTANT does).
#pragma once

#include <cstdint>

#include "kernels/base/image_view.h"
#include "kernels/base/status.h"

namespace lakshya {

inline constexpr int kRectifyFractionBits = 7;

// Raw position of every output pixel. Whole pixels and fractions lie apart, as 16-bit numbers: 6 bytes per pixel
// instead of 8, and vectors of 16-bit numbers need no conversion.
struct RectifyMap {
  ImageView<const std::int16_t> x;          // px
  ImageView<const std::int16_t> y;          // px
  ImageView<const std::uint16_t> fraction;  // rectify_fraction()
};

// Fractions of x and y, 0..127, in 1/128 px. Bits 7 and 8 mean nothing. y's are the top bits, ready for a multiplication
// that keeps the upper half of its result.
constexpr std::uint16_t rectify_fraction(int x, int y) {
  return static_cast<std::uint16_t>(x | y << 9);
}
constexpr int rectify_fraction_x(std::uint16_t fraction) {
  return fraction & 127;
}
constexpr int rectify_fraction_y(std::uint16_t fraction) {
  return fraction >> 9;
}

// The map's images and out agree in size; `rows` lie inside. `out` must not overlap `raw` or the map.
// size_mismatch, bad_argument (rows outside).
Status rectify_ref(ImageView<const std::uint8_t> raw, const RectifyMap& map, Rows rows,
                   ImageView<std::uint8_t> out);
Status rectify_simd(ImageView<const std::uint8_t> raw, const RectifyMap& map, Rows rows,
                    ImageView<std::uint8_t> out);

// Columns [begin, end) of row v by the reference: what the vectors cannot do.
void rectify_columns_ref(const ImageView<const std::uint8_t>& raw, const RectifyMap& map, int v, int begin, int end,
                         const ImageView<std::uint8_t>& out);

}  // namespace lakshya

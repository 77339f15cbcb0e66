// Centre-symmetric census transform, every other pixel of a 9 x 7 window, 16 bits per pixel.
//
// Bit k of the code is set when I(p + o_k) >= I(p - o_k), for the 16 offsets o_k = (x, y) of kCensusOffsets: the odd
// squares (x + y odd) of the window's upper half in raster order. Comparing opposite pixels instead of each with the
// centre halves the bits and keeps the noise of the centre pixel out of all of them; the even squares' 15 bits say
// nearly the same once more (docs/accuracy.md) and would double the work of every cost. Source: R. Zabih, J. Woodfill, "Non-parametric Local Transforms", ECCV 1994 (census); R.
// Spangenberg, T. Langner, R. Rojas, "Weighted Semi-Global Matching and Center-Symmetric Census Transform", CAIP
// 2013 (centre-symmetric).
#pragma once

#include <array>
#include <cstdint>

#include "kernels/base/image_view.h"
#include "kernels/base/status.h"

namespace lakshya {

inline constexpr int kCensusRadiusU = 4;
inline constexpr int kCensusRadiusV = 3;
inline constexpr int kCensusBits = 16;
using CensusCode = std::uint16_t;

struct CensusOffset {
  int x;
  int y;
};
inline constexpr std::array<CensusOffset, kCensusBits> kCensusOffsets = {{{-4, -3},
                                                                          {-2, -3},
                                                                          {0, -3},
                                                                          {2, -3},
                                                                          {4, -3},
                                                                          {-3, -2},
                                                                          {-1, -2},
                                                                          {1, -2},
                                                                          {3, -2},
                                                                          {-4, -1},
                                                                          {-2, -1},
                                                                          {0, -1},
                                                                          {2, -1},
                                                                          {4, -1},
                                                                          {-3, 0},
                                                                          {-1, 0}}};

// Outside the image its border is repeated, so that every pixel has a code: two to three percent of an image lie
// within the window's radius of its border, the bottom rows with the nearest floor among them.
//
// image, codes: same size. `codes` must not overlap `image`. size_mismatch, bad_argument (rows outside).
Status census_ref(ImageView<const std::uint8_t> image, Rows rows, ImageView<CensusCode> codes);
Status census_simd(ImageView<const std::uint8_t> image, Rows rows, ImageView<CensusCode> codes);

}  // namespace lakshya

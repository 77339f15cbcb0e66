// Centre-symmetric census transform, 9 x 7 window, 31 bits per pixel.
//
// Bit k of the code is set when I(p + o_k) >= I(p - o_k), for the 31 offsets o_k = (x, y) of the window's upper
// half in raster order: y = -3 to -1 with x = -4 to 4 (27 offsets), then y = 0 with x = -4 to -1. Comparing
// opposite pixels instead of each with the centre halves the bits and keeps the noise of the centre pixel out of
// all of them. Source: R. Zabih, J. Woodfill, "Non-parametric Local Transforms", ECCV 1994 (census); R.
// Spangenberg, T. Langner, R. Rojas, "Weighted Semi-Global Matching and Center-Symmetric Census Transform", CAIP
// 2013 (centre-symmetric).
#pragma once

#include <cstdint>

#include "kernels/base/image_view.h"
#include "kernels/base/status.h"

namespace lakshya {

inline constexpr int kCensusRadiusU = 4;
inline constexpr int kCensusRadiusV = 3;
inline constexpr int kCensusBits = 31;

// Outside the image its border is repeated, so that every pixel has a code: two to three percent of an image lie
// within the window's radius of its border, the bottom rows with the nearest floor among them.
//
// image, codes: same size. `codes` must not overlap `image`. size_mismatch, bad_argument (rows outside).
Status census_ref(ImageView<const std::uint8_t> image, Rows rows, ImageView<std::uint32_t> codes);
Status census_simd(ImageView<const std::uint8_t> image, Rows rows, ImageView<std::uint32_t> codes);

}  // namespace lakshya

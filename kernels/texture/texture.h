// Texture test: is there enough horizontal structure around a pixel to match it along its row?
//
//   t(u,v) = sum over the 9 x 7 census window of |I(x+1,y) - I(x-1,y)|;  textured when t >= threshold
//
// Only the horizontal gradient counts: rows are what stereo searches. Source: the texture threshold of K. Konolige,
// "Small Vision Systems", ISRR 1997 (sum of gradients over the matching window).
#pragma once

#include <cstdint>

#include "kernels/base/image_view.h"
#include "kernels/base/status.h"

namespace lakshya {

inline constexpr int kTextureRadiusU = 4;
inline constexpr int kTextureRadiusV = 3;

// Outside the image its border is repeated. image, textured: same size; textured is 1 or 0.
// threshold in grey levels, >= 0. `textured` must not overlap `image`. size_mismatch, bad_argument.
Status texture_ref(ImageView<const std::uint8_t> image, int threshold, Rows rows, ImageView<std::uint8_t> textured);
Status texture_simd(ImageView<const std::uint8_t> image, int threshold, Rows rows,
                    ImageView<std::uint8_t> textured);

}  // namespace lakshya

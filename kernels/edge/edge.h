// Edge pre-filters of the `sad` matcher: absolute differences of grey values see every difference of brightness
// between the two cameras, differences of edge strength do not (figures 3 and 4 of the paper).
//
//   out(u,v) = clamp(g(u,v), -cap, cap) + cap,   0 .. 2 cap, no edge = cap
//
// with one of
//   x-Sobel:  g = I(u+1,v-1) - I(u-1,v-1) + 2 (I(u+1,v) - I(u-1,v)) + I(u+1,v+1) - I(u-1,v+1)
//   Laplacian of Gaussian, 9 x 9, sigma = 1.4 px:
//             g = floor((sum over |x|, |y| <= 4 of k(x,y) I(u+x,v+y) + 16) / 32)
//             k = round(72 (1 - q) exp(-q)),  q = (x^2 + y^2) / (2 sigma^2)
// The scale 72 makes the rounded coefficients add up to exactly 0 (of 1 to 599 it is the only one), so a flat
// image gives 0 without a correction. The shift by 5 brings both filters to one scale for one cap: a step of c grey
// levels peaks at 4 c (x-Sobel) and 3.5 c, white noise is multiplied by 3.5 (x-Sobel) and 4.0. The cap keeps one
// strong edge, or one wrong pixel, from deciding a whole window.
// Source: K. Konolige, "Small Vision Systems: Hardware and Implementation", ISRR 1997 (LoG before absolute
// differences); the capped x-Sobel is the pre-filter XSOBEL of OpenCV's StereoBM; D. Marr, E. Hildreth, "Theory of
// Edge Detection", Proc. R. Soc. Lond. B 207, 1980 (LoG).
#pragma once

#include <cstdint>

#include "kernels/base/image_view.h"
#include "kernels/base/status.h"

namespace lakshya {

inline constexpr int kEdgeSobelRadius = 1;
inline constexpr int kEdgeLogRadius = 4;
inline constexpr int kMaxEdgeCap = 127;  // 2 cap fits a byte

// image, out: same size; cap 1..kMaxEdgeCap grey levels. Pixels within the radius of the image's border are cap
// ("no edge") and mean nothing. `out` is written on `rows` only and must not overlap `image`.
// size_mismatch, bad_argument.
Status edge_sobel_ref(ImageView<const std::uint8_t> image, int cap, Rows rows, ImageView<std::uint8_t> out);
Status edge_log_ref(ImageView<const std::uint8_t> image, int cap, Rows rows, ImageView<std::uint8_t> out);
Status edge_sobel_simd(ImageView<const std::uint8_t> image, int cap, Rows rows, ImageView<std::uint8_t> out);
Status edge_log_simd(ImageView<const std::uint8_t> image, int cap, Rows rows, ImageView<std::uint8_t> out);

}  // namespace lakshya

// Local support: a disparity that too few neighbours share is a speckle.
//
//   n(p) = number of q in the (2 r + 1)^2 window around p, inside the image, with a disparity and
//          |d(q) - d(p)| <= max_difference, p itself included
//   out(p) = d(p) when 100 n(p) >= min_percent * (pixels of the window inside the image), else kNoSupport;
//            codes < 0 pass through
//
// A window instead of connected components: it needs a few rows only, costs the same for every image, and does not
// depend on the order of scanning. Purpose as of the speckle filter in Hirschmueller 2008 (section 2.5.1, peak
// removal).
#pragma once

#include <cstdint>

#include "kernels/base/image_view.h"
#include "kernels/base/status.h"

namespace lakshya {

struct SupportParams {
  int radius = 4;           // px, 0..15
  int min_percent = 30;     // 0..100
  int max_difference = 16;  // 1/16 px, >= 0
};

// disparity, out: same size, no overlap (a pixel's neighbours must stay unfiltered).
// size_mismatch, bad_argument.
Status support_ref(ImageView<const std::int16_t> disparity, const SupportParams& params, Rows rows,
                   ImageView<std::int16_t> out);
Status support_simd(ImageView<const std::int16_t> disparity, const SupportParams& params, Rows rows,
                    ImageView<std::int16_t> out);

}  // namespace lakshya

// Semi-global matching in one top-to-bottom pass over a band of rows.
//
//   L_r(p,d) = C(p,d) + min(L_r(p-r,d), L_r(p-r,d-1) + P1, L_r(p-r,d+1) + P1, min_k L_r(p-r,k) + P2)
//              - min_k L_r(p-r,k)                                                     S = min(sum over r of L_r, 255)
//
// with C the averaged Hamming distance of census codes (smooth_cost_row_ref, the rows beyond the descriptors
// repeated), P2 = max(p2 - p2_slope |I(p) - I(p-r)|, p2_min) smaller across an edge of the left image, where depth
// may jump; uint8 saturating, disparities outside the range 255, and L_r = C where p-r has no descriptor. S keeps to
// eight bits as well: where it saturates nothing can win, and the means over 17 pairs with ground truth stay within
// 0.04 % of those with 16 bits. Five paths come from the left, right, top, top-left and top-right; three from left,
// right, top: the paths that a single pass can see, so only a few rows x disparities are ever stored and the scratch
// does not depend on the image's height. Each row then goes through select.h. Source: H. Hirschmueller, "Stereo
// Processing by Semiglobal Matching and Mutual Information", PAMI 30(2), 2008, eq. 13; a single pass with the paths
// that it can see: OpenCV's StereoSGBM and S. Gehrig et al., ICVS 2009.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/base/image_view.h"
#include "kernels/base/search_range.h"
#include "kernels/base/status.h"
#include "kernels/census/census.h"
#include "kernels/select/select.h"

namespace lakshya {

struct SgmParams {
  SearchRange range;
  SelectParams select;
  int paths = 3;  // 5 or 3
  int p1 = 14;    // 0 <= p1 <= p2_min
  int p2 = 135;   // p2_min <= p2 <= 182: C + P2 stays below 255
  int p2_min = 36;
  int p2_slope = 2;     // per grey level, 0..255
  int warmup_rows = 4;  // rows above the band that start its top paths, >= 0
};

// Bytes of scratch for one band; independent of the height.
std::size_t sgm_scratch_bytes(int width, int disparities);

// image: the left image, grey; left, right: census codes of the whole images; textured: flags of the left image;
// disparity: int16, 1/16 px or a NoDisparity code, written on `rows` only. All the same size. `descriptor_rows` of the images have
// descriptors; the others become kNotSearched and no path crosses them. `scratch` aligned to 64 bytes.
// The result depends on the rows of the band and on warmup_rows, never on threads.
// size_mismatch, bad_argument, scratch_too_small.
Status sgm_simd(ImageView<const std::uint8_t> image, ImageView<const CensusCode> left,
                ImageView<const CensusCode> right, ImageView<const std::uint8_t> textured, Rows descriptor_rows,
                const SgmParams& params, Rows rows, std::span<std::byte> scratch,
                ImageView<std::int16_t> disparity);
Status sgm_ref(ImageView<const std::uint8_t> image, ImageView<const CensusCode> left,
               ImageView<const CensusCode> right, ImageView<const std::uint8_t> textured, Rows descriptor_rows,
               const SgmParams& params, Rows rows, std::span<std::byte> scratch, ImageView<std::int16_t> disparity);

}  // namespace lakshya

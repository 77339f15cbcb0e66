// From the aggregated costs of one row to its disparities: winner, uniqueness, left-right check, sub-pixel.
// Every matcher ends here, so all of them have the same post-processing.
//
// S[u][i]: cost of candidate i, raw disparity first + i. In this order (docs/contract.md section 2):
//   winner:      smallest S, the smaller disparity on a tie; when its right pixel is outside: kNotSearched
//   uniqueness:  a candidate outside winner +-1 with S * (100 - uniqueness_percent) < 100 * S_min: kNotUnique
//   sub-pixel:   num = S(i-1) - S(i+1), den = max(S(i-1) + S(i+1) - 2 S(i), 1),
//                d16 = 16 d + floor((16 num + den) / (2 den)): the vertex of the parabola through the three costs,
//                rounded half up; none at the ends of the range
//   left-right:  the disparity is rounded down and up to whole pixels; when of each right pixel that these name its
//                own winner over the same costs differs from the left one by more than left_right_max:
//                kLeftRightFailed (both, as OpenCV's StereoSGBM does: a disparity of 10.5 belongs to 10 and 11, and
//                asking only one costs 0.6 % of the pixels)
//   output:      d16 + offset16, so that 1/16 px disparities include doffs; a pixel without texture is kLowTexture
// Source: H. Hirschmueller, "Stereo Processing by Semiglobal Matching and Mutual Information", PAMI 2008 (left-right
// check, quadratic sub-pixel).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/base/search_range.h"
#include "kernels/base/status.h"

namespace lakshya {

struct SelectParams {
  int uniqueness_percent = 10;  // 0..99; 0 switches the test off
  int left_right_max = 1;       // px, >= 0; negative switches the test off
  int offset16 = 0;             // added to every disparity, 1/16 px; 16 * first + offset16 >= 0
};

// Scratch of select_row_ref in elements of std::int16_t: the right image's winners.
constexpr std::size_t select_scratch_elements(int width) {
  return static_cast<std::size_t>(width);
}

// sums: width * range.disparities, of 16 bits (windows) or 8 (paths). textured: width flags. disparity: width, columns outside the valid ones become
// kNotSearched. No overlap. size_mismatch, bad_argument, scratch_too_small.
Status select_row_ref(std::span<const std::uint16_t> sums, std::span<const std::uint8_t> textured,
                      const SearchRange& range, const SelectParams& params, std::span<std::int16_t> scratch,
                      std::span<std::int16_t> disparity);
Status select_row_ref(std::span<const std::uint8_t> sums, std::span<const std::uint8_t> textured,
                      const SearchRange& range, const SelectParams& params, std::span<std::int16_t> scratch,
                      std::span<std::int16_t> disparity);

}  // namespace lakshya

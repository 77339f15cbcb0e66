// Matching cost of one image row: absolute difference of edge strengths (kernels/edge).
//
//   cost[u][i] = |left[u] - right[u - (first + i)]|,  i = 0 .. disparities-1
//
// where the right pixel lies outside its valid columns the cost is `outside_cost`. Source: the paper's SAD.
#pragma once

#include <cstdint>
#include <span>

#include "kernels/base/search_range.h"
#include "kernels/base/status.h"

namespace lakshya {

// For edges of kernels/edge with this cap: between a good match and a random pair, so that it speaks neither for
// nor against. Means over seven pairs with ground truth, cap 31: x-Sobel 7 and 21, Laplacian of Gaussian 6 and 23.
// Too small a cost wins against true matches; too large a one makes the pixels of the left border, whose true match
// is outside, take wrong ones inside. The same pairs with 9 x 9 windows, Laplacian, cap 63: cap / 3 matched 86.2 %
// of the pixels whose true match is inside and gave 0.1 % of the others a disparity off by more than 2 px; cap / 6
// 84.5 % and 0.0 %; the largest cost, 2 cap, 85.9 % and 3.9 %.
constexpr std::uint8_t sad_outside_cost(int cap) {
  return static_cast<std::uint8_t>(cap < 3 ? 1 : cap / 3);
}

// left, right: width edges. cost: width * disparities bytes, disparity contiguous; columns outside the valid ones
// are not written. size_mismatch, bad_argument.
Status sad_row_ref(std::span<const std::uint8_t> left, std::span<const std::uint8_t> right,
                   const SearchRange& range, std::uint8_t outside_cost, std::span<std::uint8_t> cost);

}  // namespace lakshya

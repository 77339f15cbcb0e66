#include "kernels/sgm/sgm_input.h"

#include <algorithm>

#include "kernels/base/units.h"
#include "kernels/hamming/hamming.h"

namespace lakshya {
namespace {

bool params_ok(const SgmParams& p, int width) {
  return search_range_ok(p.range, width) && (p.paths == 3 || p.paths == 5) && 0 <= p.p1 && p.p1 <= p.p2_min &&
         p.p2_min <= p.p2 && p.p2 < 255 - kMaxSmoothCost && 0 <= p.p2_slope && p.p2_slope <= 255 &&
         p.warmup_rows >= 0 && 0 <= p.select.uniqueness_percent && p.select.uniqueness_percent <= 99 &&
         kDisparityScale * p.range.first + p.select.offset16 >= 0;
}

}  // namespace

std::size_t sgm_scratch_bytes(int width, int disparities) {
  return std::max(sgm_ref_scratch_bytes(width, disparities), sgm_simd_scratch_bytes(width, disparities));
}

Status check_sgm(const SgmInput& input, const SgmParams& params, std::size_t scratch_bytes,
                 const ImageView<std::int16_t>& disparity) {
  const ImageView<const CensusCode>& left = input.left;
  if (!same_size(left, input.image) || !same_size(left, input.right) || !same_size(left, input.textured) ||
      !same_size(left, disparity)) {
    return Status::size_mismatch;
  }
  if (!params_ok(params, left.width) || !rows_inside(input.rows, left) ||
      !rows_inside(input.descriptor_rows, left)) {
    return Status::bad_argument;
  }
  return scratch_bytes < sgm_scratch_bytes(left.width, params.range.disparities) ? Status::scratch_too_small
                                                                                 : Status::ok;
}

Rows rows_to_aggregate(const SgmInput& input, const SgmParams& params) {
  const int begin = std::max(input.descriptor_rows.begin, input.rows.begin - params.warmup_rows);
  return {begin, std::max(begin, std::min(input.descriptor_rows.end, input.rows.end))};
}

void fill_not_searched(const SgmInput& input, Rows aggregated, const ImageView<std::int16_t>& disparity) {
  for (int v = input.rows.begin; v < input.rows.end; ++v) {
    if (v < aggregated.begin || v >= aggregated.end)
      std::fill_n(disparity.row(v), disparity.width, std::int16_t{kNotSearched});
  }
}

}  // namespace lakshya

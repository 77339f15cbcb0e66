// What both implementations of sgm do before they begin.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/base/image_view.h"
#include "kernels/base/status.h"
#include "kernels/census/census.h"
#include "kernels/sgm/sgm.h"

namespace lakshya {

struct SgmInput {
  ImageView<const std::uint8_t> image;
  ImageView<const CensusCode> left, right;
  ImageView<const std::uint8_t> textured;
  Rows descriptor_rows;
  Rows rows;
};

std::size_t sgm_ref_scratch_bytes(int width, int disparities);
std::size_t sgm_simd_scratch_bytes(int width, int disparities);

Status check_sgm(const SgmInput& input, const SgmParams& params, std::size_t scratch_bytes,
                 const ImageView<std::int16_t>& disparity);

// The rows to aggregate: those that are wanted, with their warm-up rows above. Empty when none has descriptors.
Rows rows_to_aggregate(const SgmInput& input, const SgmParams& params);

// Rows that are wanted and have no descriptors become kNotSearched.
void fill_not_searched(const SgmInput& input, Rows aggregated, const ImageView<std::int16_t>& disparity);

}  // namespace lakshya

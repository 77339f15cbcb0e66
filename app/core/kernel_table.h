// Which implementation of each kernel the pipeline calls. A backend is one table; a new one is an addition.
#pragma once

#include <array>
#include <string_view>

#include "kernels/base/memory.h"
#include "kernels/block/block.h"
#include "kernels/census/census.h"
#include "kernels/edge/edge.h"
#include "kernels/ground/ground.h"
#include "kernels/polar_histogram/polar_histogram.h"
#include "kernels/project/project.h"
#include "kernels/rectify/rectify.h"
#include "kernels/score/score.h"
#include "kernels/sgm/sgm.h"
#include "kernels/support/support.h"
#include "kernels/texture/texture.h"

namespace lakshya {

struct KernelTable {
  Memory memory;  // where the buffers that these kernels are given lie
  decltype(&rectify_ref) rectify;
  decltype(&census_ref) census;
  decltype(&texture_ref) texture;
  decltype(&edge_sobel_ref) edge_sobel;
  decltype(&edge_log_ref) edge_log;
  decltype(&sgm_ref) sgm;
  decltype(&census_block_ref) census_block;
  decltype(&sad_block_ref) sad_block;
  decltype(&support_ref) support;
  decltype(&ground_residuals_ref) ground_residuals;
  decltype(&project_rows_ref) project_rows;
  decltype(&score_ref) score;
  decltype(&polar_histogram_ref) polar_histogram;
};

inline constexpr KernelTable kReferenceKernels = {
    .memory = Memory::host,
    .rectify = rectify_ref,
    .census = census_ref,
    .texture = texture_ref,
    .edge_sobel = edge_sobel_ref,
    .edge_log = edge_log_ref,
    .sgm = sgm_ref,
    .census_block = census_block_ref,
    .sad_block = sad_block_ref,
    .support = support_ref,
    .ground_residuals = ground_residuals_ref,
    .project_rows = project_rows_ref,
    .score = score_ref,
    .polar_histogram = polar_histogram_ref,
};

// On the instruction set of kernels/base/isa.h; bit for bit what the reference gives.
inline constexpr KernelTable kSimdKernels = {
    .memory = Memory::host,
    .rectify = rectify_simd,
    .census = census_simd,
    .texture = texture_simd,
    .edge_sobel = edge_sobel_simd,
    .edge_log = edge_log_simd,
    .sgm = sgm_simd,
    .census_block = census_block_simd,
    .sad_block = sad_block_simd,
    .support = support_simd,
    .ground_residuals = ground_residuals_simd,
    .project_rows = project_rows_simd,
    .score = score_simd,
    .polar_histogram = polar_histogram_simd,
};

struct Backend {
  const char* name;
  const KernelTable* kernels;
};
inline constexpr std::array<Backend, 2> kBackends = {{
    {"ref", &kReferenceKernels},
    {"simd", &kSimdKernels},
}};

// "simd" or "ref" for all kernels, or with exceptions, "simd,sgm=ref,score=ref" (names are the members of KernelTable).
// Throws InputError: an unknown backend or kernel, or backends whose buffers live in different places.
KernelTable kernels_by_name(std::string_view choice);

}  // namespace lakshya

// Which implementation of each kernel the pipeline calls. A backend is one table; a new one is an addition.
#pragma once

#include "kernels/block/block.h"
#include "kernels/census/census.h"
#include "kernels/edge/edge.h"
#include "kernels/grid_bin/grid_bin.h"
#include "kernels/ground/ground.h"
#include "kernels/prune/prune.h"
#include "kernels/rectify/rectify.h"
#include "kernels/score/score.h"
#include "kernels/sgm/sgm.h"
#include "kernels/support/support.h"
#include "kernels/texture/texture.h"

namespace lakshya {

struct KernelTable {
  decltype(&rectify_ref) rectify;
  decltype(&census_ref) census;
  decltype(&texture_ref) texture;
  decltype(&edge_sobel_ref) edge_sobel;
  decltype(&edge_log_ref) edge_log;
  decltype(&sgm_ref) sgm;
  decltype(&census_block_ref) census_block;
  decltype(&sad_block_ref) sad_block;
  decltype(&support_ref) support;
  decltype(&ground_residuals_row_ref) ground_residuals_row;
  decltype(&reproject_prune_row_ref) reproject_prune_row;
  decltype(&bin_obstacles_ref) bin_obstacles;
  decltype(&bin_ground_ref) bin_ground;
  decltype(&score_ref) score;
};

inline constexpr KernelTable kReferenceKernels = {
    rectify_ref,
    census_ref,
    texture_ref,
    edge_sobel_ref,
    edge_log_ref,
    sgm_ref,
    census_block_ref,
    sad_block_ref,
    support_ref,
    ground_residuals_row_ref,
    reproject_prune_row_ref,
    bin_obstacles_ref,
    bin_ground_ref,
    score_ref,
};

}  // namespace lakshya

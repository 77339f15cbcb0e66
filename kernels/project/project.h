// Pruning and binning of whole rows: what reproject_prune_row_ref, bin_obstacles_ref and bin_ground_ref do one after
// the other (kernels/prune, kernels/grid_bin have the definitions), without their arrays in between where an
// implementation can do without.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/base/image_view.h"
#include "kernels/base/nav_grid.h"
#include "kernels/base/status.h"
#include "kernels/base/units.h"
#include "kernels/prune/prune.h"

namespace lakshya {

// Scratch of the two functions below, for images of this width.
std::size_t project_scratch_bytes(int width);

// Adds the rows' pixels to the counts of `grid`, which no other thread may use meanwhile, and to `counts`. `classes`
// gets the class of every pixel of the rows; an empty view: nobody wants to know. size_mismatch (classes),
// bad_argument (rows; grid, see grid_ok), scratch_too_small; then nothing was added.
Status project_rows_ref(const PruneModel& model, ImageView<const std::int16_t> disparity, Rows rows,
                        const NavGrid& grid, PixelCounts& counts, ImageView<PixelClass> classes,
                        std::span<std::byte> scratch);
Status project_rows_simd(const PruneModel& model, ImageView<const std::int16_t> disparity, Rows rows,
                         const NavGrid& grid, PixelCounts& counts, ImageView<PixelClass> classes,
                         std::span<std::byte> scratch);

}  // namespace lakshya

#include "kernels/base/scratch.h"
#include "kernels/grid_bin/grid_bin.h"
#include "kernels/project/project.h"

namespace lakshya {
namespace {

PrunedRow take_row(ScratchLayout& layout, int width) {
  const auto pixels = static_cast<std::size_t>(width);
  PrunedRow row;
  row.obstacles = layout.take<ObstaclePoint>(pixels);
  row.floor = layout.take<GroundStrip>(pixels);
  row.below = layout.take<GroundStrip>(pixels);
  return row;
}

}  // namespace

std::size_t project_scratch_bytes(int width) {
  ScratchLayout layout;
  (void)take_row(layout, width);
  return layout.used();
}

Status project_rows_ref(const PruneModel& model, ImageView<const std::int16_t> disparity, Rows rows,
                        const NavGrid& grid, PixelCounts& counts, ImageView<PixelClass> classes,
                        std::span<std::byte> scratch) {
  const bool classify = classes.data != nullptr;
  if (classify && !same_size(classes, disparity)) return Status::size_mismatch;
  if (!rows_inside(rows, disparity) || !grid_ok(grid)) return Status::bad_argument;
  if (scratch.size() < project_scratch_bytes(disparity.width)) return Status::scratch_too_small;
  ScratchLayout layout(scratch.data());
  PrunedRow row = take_row(layout, disparity.width);
  for (int v = rows.begin; v < rows.end; ++v) {
    const Status statuses[] = {
        reproject_prune_row_ref(model, v, row_span(disparity, v), row, counts,
                                classify ? row_span(classes, v) : std::span<PixelClass>()),
        bin_obstacles_ref(row.obstacles.first(row.obstacle_count), grid),
        bin_ground_ref(row.floor.first(row.floor_count), grid, grid.floor_count),
        bin_ground_ref(row.below.first(row.below_count), grid, grid.below_count),
    };
    for (const Status status : statuses) {
      if (status != Status::ok) return status;
    }
  }
  return Status::ok;
}

}  // namespace lakshya

// The navigation map's shape and storage: docs/contract.md section 4. Plain data, no logic.
#pragma once

#include <cstdint>

#include "kernels/base/image_view.h"

namespace lakshya {

// Row r holds forward in [r, r+1) cells; column c holds left in (half - (c+1) cells, half - c cells], where
// half = cols * cell_mm / 2. Row 0 is nearest, column 0 leftmost. Origin: the turning centre.
struct GridGeometry {
  int rows = 200;
  int cols = 200;
  std::int32_t cell_mm = 100;
  friend bool operator==(const GridGeometry&, const GridGeometry&) = default;
};

// One plane per quantity, all rows x cols (image height = rows, width = cols).
struct NavGrid {
  GridGeometry geometry;
  ImageView<std::uint32_t> count;        // obstacle points
  ImageView<std::int64_t> height_sum;    // sum of their heights above the floor, mm
  ImageView<std::uint32_t> floor_count;  // floor pixels whose footprint covers the cell
  ImageView<std::uint32_t> below_count;  // drop-off evidence
  ImageView<std::uint8_t> type;          // CellType
};

}  // namespace lakshya

// What project_rows_simd needs to know of one row, in 16 and 32 bits.
#pragma once

#include <cstdint>

#include "kernels/base/nav_grid.h"
#include "kernels/base/units.h"
#include "kernels/prune/prune.h"
#include "kernels/prune/row_line.h"

namespace lakshya {

// The tests of kernels/prune/prune.h as comparisons of a disparity d >= 0 in 1/16 px, so that 16 bits are enough:
// d << 12 < bound is d <= (bound - 1) >> 12, and d << 12 <= bound is d <= bound >> 12, whatever the bound.
struct ClassLimits {
  std::int16_t nothing = -1;          // d <= nothing: nothing concluded
  std::int16_t drop = -1;             // d <= drop: drop-off
  std::int16_t floor = -1;            // d <= floor: floor, unless drop-off
  std::int16_t ceiling_low = -1;      // d <= ceiling_low: ceiling
  std::int16_t ceiling_high = 32767;  // d > ceiling_high: ceiling
};

// A direction's Q16 coordinate per depth, (A + u * per_u + 2^15) >> 16 with A and per_u in Q32, in two halves:
// whole + u * whole_per_u + ((part + u * part_per_u) >> 16), the parts below 2^16.
struct RowDirection {
  std::int32_t whole = 0;
  std::int32_t whole_per_u = 0;
  std::uint32_t part = 0;
  std::uint32_t part_per_u = 0;
  bool operator==(const RowDirection&) const = default;
};

// floor(x / cell) = ((x * multiplier >> 16) * shift) >> 16 for 0 <= x <= limit.
struct CellDivider {
  std::uint16_t multiplier = 0;
  std::uint16_t shift = 0;  // a power of two: a product's upper half is quicker than a shift by what is not known
  std::int64_t limit = -1;
};
CellDivider make_cell_divider(int cell_mm);

// Where the row's pixels lie, in 16 bits: millimetres from a cell's border so far behind the map, and so far to its
// left, that none is negative.
struct NarrowTerms {
  bool fits = false;
  bool straight = false;        // level, and `forward` is the same in the whole row
  std::uint16_t ahead_mm = 0;   // what the mount adds
  std::uint16_t across_mm = 0;  // what the distance to the left is taken from
  std::int16_t first_row = 0;   // the map's, in cells from there
  std::int16_t first_col = 0;
  std::int16_t last_depth = 0;  // last entry of the tables that a disparity reaches
  // Depth of a strip's near and far end at the floor's own disparity, in straight rows.
  std::uint16_t near_floor_mm = 0;
  std::uint16_t far_floor_mm = 0;
};

struct RowTerms {
  std::int16_t far = 0;  // d <= far: too far
  bool level = false;    // the limits are the same in the whole row: `limits`; else they come from the lines
  ClassLimits limits;
  RowLine floor, drop_relative, drop_absolute, floor_relative, floor_absolute, ceiling;
  std::int32_t max_floor_disparity = 0;
  std::int32_t min_disparity = 0;
  std::int32_t half_row = 0;  // what half a row changes the floor's disparity by
  RowDirection forward, left;
  NarrowTerms narrow;
};

// Coordinates within which a millimetre and its cell are exact in float arithmetic.
inline constexpr std::int64_t kProjectMaxMm = 1 << 19;

// The tables' entry for a disparity.
constexpr std::int64_t table_entry(std::int64_t disparity_q16) {
  return (disparity_q16 + (1 << (kDisparityToQ16 - 1))) >> kDisparityToQ16;
}

// False: the model, the map or the row has numbers that do not fit, and the row is the reference's.
bool make_row_terms(const PruneModel& model, const GridGeometry& grid, int v, int width, RowTerms& terms);

}  // namespace lakshya

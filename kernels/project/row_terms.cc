#include "kernels/project/row_terms.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <limits>

#include "kernels/base/units.h"

namespace lakshya {
namespace {

std::int16_t saturated(std::int64_t x) {
  using Limits = std::numeric_limits<std::int16_t>;
  return static_cast<std::int16_t>(std::clamp<std::int64_t>(x, Limits::min(), Limits::max()));
}

// d << 12 < bound
std::int16_t below(std::int64_t bound) {
  return saturated((bound - 1) >> kDisparityToQ16);
}

// d << 12 <= bound
std::int16_t up_to(std::int64_t bound) {
  return saturated(bound >> kDisparityToQ16);
}

bool level(const PruneModel& m) {
  return m.floor.per_u == 0 && m.drop_relative.per_u == 0 && m.drop_absolute.per_u == 0 &&
         m.floor_relative.per_u == 0 && m.floor_absolute.per_u == 0 && m.ceiling.per_u == 0;
}

ClassLimits limits_of_row(const PruneModel& m, int v) {
  constexpr std::int16_t kAll = std::numeric_limits<std::int16_t>::max();
  ClassLimits limits;
  const std::int64_t floor = m.floor.at(0, v);
  if (floor > m.max_floor_disparity) limits.nothing = kAll;
  if (floor > 0) {
    limits.drop = below(std::min(m.drop_relative.at(0, v), m.drop_absolute.at(0, v)));
    limits.floor = up_to(std::max(m.floor_relative.at(0, v), m.floor_absolute.at(0, v)));
  }
  switch (m.ceiling_test) {
    case CeilingTest::above_camera:
      if (floor < 0) limits.ceiling_low = below(m.ceiling.at(0, v));
      break;
    case CeilingTest::at_camera:
      if (floor < 0) limits.ceiling_low = kAll;
      break;
    case CeilingTest::below_camera:
      limits.ceiling_high = up_to(m.ceiling.at(0, v));
      break;
  }
  return limits;
}

std::int64_t depth_at(const PruneModel& m, std::int64_t entry) {
  const auto last = static_cast<std::int64_t>(m.depth_mm.size()) - 1;
  return m.depth_mm[static_cast<std::size_t>(std::clamp<std::int64_t>(entry, 1, last))];
}

// The largest depth that a pixel kept can have.
std::int64_t largest_depth(const PruneModel& m) {
  return depth_at(m, table_entry(m.min_disparity));
}

bool row_direction(const Affine& a, int v, int width, std::int64_t depth, std::int64_t mount, RowDirection& out) {
  constexpr std::int64_t kLimit = std::int64_t{1} << 40;  // Q32: 256 per depth
  const std::int64_t first = a.at(0, v);
  const std::int64_t last = a.at(width, v);
  if (std::abs(first) > kLimit || std::abs(last) > kLimit || std::abs(a.per_u) > kLimit) return false;
  const std::int64_t steepest = (std::max(std::abs(first), std::abs(last)) >> 16) + 1;
  if ((depth * steepest >> 16) + std::abs(mount) >= kProjectMaxMm) return false;
  const std::int64_t rounded = first + (1 << 15);
  out = {static_cast<std::int32_t>(rounded >> 16), static_cast<std::int32_t>(a.per_u >> 16),
         static_cast<std::uint32_t>(rounded & 0xFFFF), static_cast<std::uint32_t>(a.per_u & 0xFFFF)};
  return true;
}

// The least and the largest coordinate that a row's pixels can have, mount included.
struct Reach {
  std::int64_t least, most;
};

Reach reach_of(const Affine& a, int v, int width, std::int64_t depth, std::int64_t mount) {
  const std::int64_t first = a.at(0, v) >> 16;
  const std::int64_t last = a.at(width, v) >> 16;
  const std::int64_t low = std::min({first, last, std::int64_t{0}}) - 1;
  const std::int64_t high = std::max({first, last, std::int64_t{0}}) + 2;
  return {(depth * low >> 16) - 1 + mount, (depth * high >> 16) + 1 + mount};
}

NarrowTerms narrow_terms(const PruneModel& m, const GridGeometry& g, int v, int width, const RowTerms& t) {
  constexpr std::int64_t kMostDepth = 1 << 15;
  constexpr std::int64_t kMost = 1 << 14;  // cells
  const CellDivider divider = make_cell_divider(g.cell_mm);
  NarrowTerms n;
  const std::int64_t depth = largest_depth(m);
  const std::int64_t map_border = std::int64_t{g.cols / 2} * g.cell_mm;
  const Reach ahead = reach_of(m.forward, v, width, depth, m.forward_mm);
  const Reach left = reach_of(m.left, v, width, depth, m.left_mm);
  const Reach across{map_border - left.most, map_border - left.least};
  const auto cells_before = [&](const Reach& r) {
    return r.least >= 0 ? 0 : (-r.least + g.cell_mm - 1) / g.cell_mm;
  };
  const std::int64_t rows_before = cells_before(ahead);
  const std::int64_t cols_before = cells_before(across);
  n.fits = depth < kMostDepth && ahead.most + rows_before * g.cell_mm <= divider.limit &&
           across.most + cols_before * g.cell_mm <= divider.limit && std::max(rows_before, cols_before) < kMost;
  if (!n.fits) return n;
  n.straight = t.level && t.forward.whole_per_u == 0 && t.forward.part_per_u == 0;
  // Sums that may be negative, as the mount's, are right modulo 2^16.
  n.ahead_mm = static_cast<std::uint16_t>(m.forward_mm + rows_before * g.cell_mm);
  n.across_mm = static_cast<std::uint16_t>(map_border - m.left_mm + cols_before * g.cell_mm);
  n.first_row = static_cast<std::int16_t>(rows_before);
  n.first_col = static_cast<std::int16_t>(cols_before);
  n.last_depth = saturated(static_cast<std::int64_t>(m.depth_mm.size()) - 1);
  const std::int64_t farthest = std::max<std::int64_t>(table_entry(t.min_disparity), 1);
  const auto depth_of = [&](std::int64_t floor) {
    return static_cast<std::uint16_t>(depth_at(m, std::max(table_entry(floor), farthest)));
  };
  n.near_floor_mm = depth_of(std::int64_t{t.floor.at_0} + t.half_row);
  n.far_floor_mm = depth_of(std::int64_t{t.floor.at_0} - t.half_row);
  return n;
}

bool bounds_fit(const PruneModel& m, int v, int width, RowTerms& t) {
  return narrow_to_row(m.drop_relative, v, width, t.drop_relative) &&
         narrow_to_row(m.drop_absolute, v, width, t.drop_absolute) &&
         narrow_to_row(m.floor_relative, v, width, t.floor_relative) &&
         narrow_to_row(m.floor_absolute, v, width, t.floor_absolute) &&
         narrow_to_row(m.ceiling, v, width, t.ceiling);
}

bool grid_fits(const GridGeometry& g) {
  return std::int64_t{g.rows} * g.cell_mm <= kProjectMaxMm && std::int64_t{g.cols} * g.cell_mm <= kProjectMaxMm;
}

}  // namespace

// The multiplier 2^k / cell, rounded up, has its highest bit set, so that the quotient is right at least up to 2^15: what
// multiplier * cell is more than 2^k is below cell <= 2^(k - 15).
CellDivider make_cell_divider(int cell_mm) {
  CellDivider divider;
  if (cell_mm < 3 || cell_mm > 1 << 15) return divider;
  const int k = 15 + static_cast<int>(std::bit_width(static_cast<unsigned>(cell_mm - 1)));  // > 16
  const std::int64_t scale = std::int64_t{1} << k;
  const std::int64_t multiplier = (scale + cell_mm - 1) / cell_mm;
  const std::int64_t excess = multiplier * cell_mm - scale;
  divider.multiplier = static_cast<std::uint16_t>(multiplier);
  divider.shift = static_cast<std::uint16_t>(1 << (32 - k));
  divider.limit = excess == 0 ? 0xFFFF : std::min<std::int64_t>((scale - 1) / excess, 0xFFFF);
  return divider;
}

bool make_row_terms(const PruneModel& m, const GridGeometry& grid, int v, int width, RowTerms& t) {
  if (width > kRowLineMaxWidth || !grid_fits(grid) || m.depth_mm.size() < 2 ||
      m.height_scale.size() < m.depth_mm.size())
    return false;
  t.level = level(m);
  if (!narrow_to_row(m.floor, v, width, t.floor) || !(t.level || bounds_fit(m, v, width, t))) return false;
  const std::int64_t half_row = m.floor.per_v / 2;
  if (half_row < 0 || half_row > kRowLineLimit / 2 || m.min_disparity < 0 || m.min_disparity > kRowLineLimit / 2 ||
      std::abs(m.max_floor_disparity) > kRowLineLimit)
    return false;
  const std::int64_t depth = largest_depth(m);
  if (depth < 0 || !row_direction(m.forward, v, width, depth, m.forward_mm, t.forward) ||
      !row_direction(m.left, v, width, depth, m.left_mm, t.left))
    return false;
  t.far = std::max<std::int16_t>(below(m.min_disparity), 0);
  if (t.level) t.limits = limits_of_row(m, v);
  t.max_floor_disparity = static_cast<std::int32_t>(m.max_floor_disparity);
  t.min_disparity = static_cast<std::int32_t>(m.min_disparity);
  t.half_row = static_cast<std::int32_t>(half_row);
  t.narrow = narrow_terms(m, grid, v, width, t);
  return true;
}

}  // namespace lakshya

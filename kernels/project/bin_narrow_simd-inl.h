// Second pass of project_simd.cc where coordinates and cells fit in 16 bits (NarrowTerms), which is twice as many pixels
// a vector: the pixels stay in their columns, those of other classes are left out at the end. Strips of more than
// two cells go on to bin_pixels_simd-inl.h.
#if defined(KERNELS_PROJECT_BIN_NARROW_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef KERNELS_PROJECT_BIN_NARROW_SIMD_INL_H
#undef KERNELS_PROJECT_BIN_NARROW_SIMD_INL_H
#else
#define KERNELS_PROJECT_BIN_NARROW_SIMD_INL_H
#endif

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/compress_simd-inl.h"
#include "kernels/project/bin_pixels_simd-inl.h"
#include "kernels/project/narrow_simd-inl.h"
#include "kernels/project/pixels_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Lists where each run of equal cells ends, and returns their number.
HWY_INLINE int find_runs(Cells16& cells) {
  const D16 d;
  const DU16 du;
  const D32 d32;
  const int half = static_cast<int>(hn::Lanes(d32));
  const int count = cells.count;
  cells.index[count] = static_cast<std::uint16_t>(~cells.index[count - 1]);  // ends the last run
  int runs = 0;
  for (int i = 0; i < count; i += 2 * half) {
    const auto here = hn::LoadU(du, cells.index + i);
    const auto next = hn::LoadU(du, cells.index + i + 1);
    const auto ends = hn::RebindMask(d, hn::Ne(here, next));
    runs += static_cast<int>(compress_store_two(from(i), from(i + half), ends, d32, d, cells.ends + runs));
  }
  return runs;
}

// plane[cell] += how often it stands in `cells`; empties them.
void count_cells(Cells16& cells, std::uint32_t* plane) {
  if (cells.count == 0) return;
  const int runs = find_runs(cells);
  std::int32_t before = -1;
  for (int r = 0; r < runs; ++r) {
    const std::int32_t last = cells.ends[r];
    const std::uint16_t cell = cells.index[last];
    if (cell != kOutside16) plane[cell] += static_cast<std::uint32_t>(last - before);
    before = last;
  }
  cells.count = 0;
}

template <bool kStraight>
void bin_obstacles_narrow(const Frame& f, const RowTerms& t, const std::int16_t* disparity, int begin, int count,
                          Work& w) {
  const D16 d;
  const DU16 du;
  const D32 d32;
  const int half = static_cast<int>(hn::Lanes(d32));
  const PruneModel& m = f.model;
  const NarrowTerms n = t.narrow;
  const CellDivider divider = f.divider;
  const Plane16 plane(f.grid.geometry, n, f.grid.count.stride);
  const RowLine floor = t.floor;
  const std::int32_t camera_height = m.height_mm;
  const std::int32_t* depths = m.depth_mm.data();
  const std::int32_t* scales = m.height_scale.data();
  const auto code = hn::Set(d, static_cast<std::int16_t>(PixelClass::obstacle));
  const auto row_whole = hn::Set(d, static_cast<std::int16_t>(t.forward.whole >> 16));
  const auto row_part = hn::Set(du, static_cast<std::uint16_t>(t.forward.whole & 0xFFFF));
  const auto map_begin = hn::Set(du, static_cast<std::uint16_t>(n.first_row * f.grid.geometry.cell_mm));
  Cells16& cells = w.near_cells;
  cells.count = 0;
  for (int i = 0; i < count; i += 2 * half) {
    const auto is_obstacle = hn::Eq(hn::Load(d, w.classes + i), code);
    if (hn::AllFalse(d, is_obstacle)) continue;
    const auto entry = hn::Min(hn::Max(hn::LoadU(d, disparity + i), hn::Set(d, 1)), hn::Set(d, n.last_depth));
    const auto low = low_half(entry);
    const auto high = high_half(entry);
    const auto depth = narrowed(hn::GatherIndex(d32, depths, low), hn::GatherIndex(d32, depths, high));
    const auto forward_whole = kStraight ? row_whole : hn::Load(d, w.forward.whole + i);
    const auto forward_part = kStraight ? row_part : hn::Load(du, w.forward.part + i);
    const auto ahead = hn::Add(times_depth(depth, forward_whole, forward_part), hn::Set(du, n.ahead_mm));
    const auto left = times_depth(depth, hn::Load(d, w.left.whole + i), hn::Load(du, w.left.part + i));
    const auto across = hn::Sub(hn::Set(du, n.across_mm), left);
    const auto cell =
        plane.cells(cells_of(divider, hn::Max(ahead, map_begin)), cells_of(divider, across), is_obstacle);
    hn::StoreU(cell, du, cells.index + cells.count);
    const auto height = hn::Set(d32, camera_height);
    const auto low_floor = kStraight ? hn::Set(d32, floor.at_0) : value_at(floor, from(begin + i));
    const auto high_floor = kStraight ? hn::Set(d32, floor.at_0) : value_at(floor, from(begin + i + half));
    hn::StoreU(hn::Sub(height, scaled_product<28>(low_floor, hn::GatherIndex(d32, scales, low))), d32,
               w.heights + cells.count);
    hn::StoreU(hn::Sub(height, scaled_product<28>(high_floor, hn::GatherIndex(d32, scales, high))), d32,
               w.heights + cells.count + half);
    cells.count += 2 * half;
  }
  if (cells.count == 0) return;
  const int runs = find_runs(cells);
  std::int64_t sum = 0;
#pragma GCC unroll 8
  for (int i = 0; i < cells.count; ++i)
    w.height_sums[i] = sum += w.heights[i];
  std::int32_t before = -1;
  std::int64_t sum_before = 0;
  for (int r = 0; r < runs; ++r) {
    const std::int32_t last = cells.ends[r];
    const std::uint16_t cell = cells.index[last];
    if (cell != kOutside16) {
      f.grid.count.data[cell] += static_cast<std::uint32_t>(last - before);
      f.grid.height_sum.data[cell] += w.height_sums[last] - sum_before;
    }
    before = last;
    sum_before = w.height_sums[last];
  }
}

// `longer` gets the pixels whose strips are longer than two cells.
template <bool kStraight>
void bin_ground_narrow(const Frame& f, const RowTerms& t, PixelClass which, const ImageView<std::uint32_t>& plane,
                       const std::int16_t* disparity, int begin, int count, Pixels& longer, Work& w) {
  const D16 d;
  const DU16 du;
  const D32 d32;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const NarrowTerms n = t.narrow;
  const CellDivider divider = f.divider;
  const Plane16 cells(f.grid.geometry, n, plane.stride);
  const auto code = hn::Set(d, static_cast<std::int16_t>(which));
  const auto row_whole = hn::Set(d, static_cast<std::int16_t>(t.forward.whole >> 16));
  const auto row_part = hn::Set(du, static_cast<std::uint16_t>(t.forward.whole & 0xFFFF));
  const auto last_pair = hn::Set(d, static_cast<std::int16_t>(w.depth_pair_count - 1));
  const auto one = hn::Set(d, 1);
  Cells16& near_cells = w.near_cells;
  Cells16& far_cells = w.far_cells;
  int near_count = 0, far_count = 0;
  longer.count = 0;
  for (int i = 0; i < count; i += lanes) {
    const auto is_ground = hn::Eq(hn::Load(d, w.classes + i), code);
    if (hn::AllFalse(d, is_ground)) continue;
    const auto here = hn::LoadU(d, disparity + i);
    const auto entry = hn::Min(hn::Max(here, hn::Zero(d)), last_pair);
    const auto low = hn::BitCast(du, hn::GatherIndex(d32, w.depth_pairs, low_half(entry)));
    const auto high = hn::BitCast(du, hn::GatherIndex(d32, w.depth_pairs, high_half(entry)));
    const auto near_floor = kStraight ? hn::Set(du, n.near_floor_mm) : hn::Load(du, w.near_floor + i);
    const auto far_floor = kStraight ? hn::Set(du, n.far_floor_mm) : hn::Load(du, w.far_floor + i);
    const auto near_depth = hn::Min(hn::ConcatEven(du, high, low), near_floor);
    const auto far_depth = hn::Min(hn::ConcatOdd(du, high, low), far_floor);
    const auto forward_whole = kStraight ? row_whole : hn::Load(d, w.forward.whole + i);
    const auto forward_part = kStraight ? row_part : hn::Load(du, w.forward.part + i);
    const auto left_whole = hn::Load(d, w.left.whole + i);
    const auto left_part = hn::Load(du, w.left.part + i);
    const auto ahead = hn::Set(du, n.ahead_mm);
    const auto across = hn::Set(du, n.across_mm);
    const auto near_row = cells_of(divider, hn::Add(times_depth(near_depth, forward_whole, forward_part), ahead));
    const auto far_row = cells_of(divider, hn::Add(times_depth(far_depth, forward_whole, forward_part), ahead));
    const auto near_col = cells_of(divider, hn::Sub(across, times_depth(near_depth, left_whole, left_part)));
    const auto far_col = cells_of(divider, hn::Sub(across, times_depth(far_depth, left_whole, left_part)));
    const auto steps = hn::IfThenElseZero(
        is_ground, hn::Max(hn::Abs(hn::Sub(far_row, near_row)), hn::Abs(hn::Sub(far_col, near_col))));
    const auto long_ones = hn::Gt(steps, one);
    append(begin + i, here, long_ones, longer);
    hn::StoreU(cells.cells(near_row, near_col, hn::AndNot(long_ones, is_ground)), du,
               near_cells.index + near_count);
    near_count += lanes;
    const auto two_cells = hn::Eq(steps, one);
    if (hn::AllFalse(d, two_cells)) continue;
    hn::StoreU(cells.cells(far_row, far_col, two_cells), du, far_cells.index + far_count);
    far_count += lanes;
  }
  near_cells.count = near_count;
  far_cells.count = far_count;
  count_cells(near_cells, plane.data);
  count_cells(far_cells, plane.data);
}

template <bool kStraight>
void bin_narrow_piece(const Frame& f, const RowTerms& t, const ClassCounts& found, const std::int16_t* disparity,
                      int begin, int count, Work& w) {
  const NavGrid& grid = f.grid;
  if (found.obstacles > 0) bin_obstacles_narrow<kStraight>(f, t, disparity, begin, count, w);
  if (found.floor > 0) {
    bin_ground_narrow<kStraight>(f, t, PixelClass::floor, grid.floor_count, disparity, begin, count, w.floor, w);
    bin_ground(f, t, w.floor, grid.floor_count, w);
  }
  if (found.below > 0) {
    bin_ground_narrow<kStraight>(f, t, PixelClass::drop_off, grid.below_count, disparity, begin, count, w.below, w);
    bin_ground(f, t, w.below, grid.below_count, w);
  }
}

void bin_narrow(const Frame& f, const RowTerms& t, const ClassCounts& found, const std::int16_t* disparity,
                int begin, int count, Work& w) {
  if (found.obstacles + found.floor + found.below == 0) return;
  fill_direction(t.left, begin, count, w.left);
  if (t.narrow.straight) {
    bin_narrow_piece<true>(f, t, found, disparity, begin, count, w);
    return;
  }
  fill_direction(t.forward, begin, count, w.forward);
  fill_floor_depth(f, t.floor, t.half_row, begin, count, w.near_floor);
  fill_floor_depth(f, t.floor, -t.half_row, begin, count, w.far_floor);
  bin_narrow_piece<false>(f, t, found, disparity, begin, count, w);
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

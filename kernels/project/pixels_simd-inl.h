// What the passes of project_simd.cc hand on, and where a pixel lies: vectors of columns and disparities to millimetres
// and cells.
#if defined(KERNELS_PROJECT_PIXELS_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef KERNELS_PROJECT_PIXELS_SIMD_INL_H
#undef KERNELS_PROJECT_PIXELS_SIMD_INL_H
#else
#define KERNELS_PROJECT_PIXELS_SIMD_INL_H
#endif

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/compress_simd-inl.h"
#include "kernels/base/nav_grid.h"
#include "kernels/project/row_terms.h"
#include "kernels/prune/prune.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D16 = hn::ScalableTag<std::int16_t>;
using D32 = hn::ScalableTag<std::int32_t>;
using DU16 = hn::RebindToUnsigned<D16>;
using Half16 = hn::Rebind<std::int16_t, D32>;  // as many as D32 has
using DFloat = hn::RebindToFloat<D32>;
using V16 = hn::Vec<D16>;
using VU16 = hn::Vec<DU16>;
using M16 = hn::Mask<D16>;
using V32 = hn::Vec<D32>;
using M32 = hn::Mask<D32>;

constexpr int kPiece = 1024;                                         // pixels
constexpr int kRoom = kPiece + static_cast<int>(HWY_MAX_BYTES) / 2;  // a vector may hang over
constexpr int kCellRoom = 1024;
constexpr int kDepthPairs = 8 << 10;  // entries; 512 px and more are seldom searched

// Pixels of one class: column << 16 | disparity.
struct Pixels {
  alignas(64) std::int32_t pixel[kRoom] = {};
  int count = 0;
};

// A direction in a piece's columns: per depth, whole millimetres and 2^-16 of them.
struct Direction16 {
  alignas(64) std::int16_t whole[kRoom];
  alignas(64) std::uint16_t part[kRoom];
  RowDirection of;  // what the arrays were made from, and for which columns
  int begin = -1, count = 0;
};

// Cells of a map of less than 2^16, and where a run of equal ones ends.
struct Cells16 {
  alignas(64) std::uint16_t index[kRoom];
  alignas(64) std::int32_t ends[kRoom];
  int count = 0;
};

// Cells to be counted in one plane of the map, in order.
struct Cells {
  alignas(64) std::int32_t index[kCellRoom + kRoom];
  alignas(64) std::int32_t ends[kCellRoom + kRoom];
  int count = 0;
};

// Pixels of a piece that go into the map.
struct ClassCounts {
  std::uint32_t obstacles, floor, below;
};

struct Work {
  Pixels obstacles, floor, below;
  alignas(64) std::int16_t disparity[kRoom] = {};  // a piece shorter than a whole number of vectors
  alignas(64) std::int16_t nothing[kRoom], drop[kRoom], floor_limit[kRoom], ceiling_low[kRoom], ceiling_high[kRoom];
  alignas(64) std::int16_t classes[kRoom];
  Direction16 forward, left;
  alignas(64) std::uint16_t near_floor[kRoom], far_floor[kRoom];
  Cells16 near_cells, far_cells;
  // By disparity: depth of a strip's near end, and of its far end << 16, where the floor's own disparity is not larger.
  alignas(64) std::int32_t depth_pairs[kDepthPairs + static_cast<int>(HWY_MAX_BYTES) / 4];
  int depth_pair_count = 0;
  alignas(64) std::int32_t heights[kRoom];
  alignas(64) std::int64_t height_sums[kRoom];
  Cells obstacle_cells, first_cells, further_cells;
};

struct Frame {
  const PruneModel& model;
  const NavGrid& grid;
  float cells_per_mm;
  float to_middle;  // half a millimetre less half a cell, in cells
  bool narrow;      // the map's cells can be counted in 16 bits
  CellDivider divider;
};

// Pixels of a vector, as they are gathered: in two halves of 32-bit lanes.
HWY_INLINE void append(int u, V16 disparity, M16 mask, Pixels& to) {
  const D16 d;
  const D32 d32;
  const Half16 half;
  if (hn::AllFalse(d, mask)) return;
  const auto first = hn::Add(hn::ShiftLeft<16>(hn::Iota(d32, 0)), hn::Set(d32, u << 16));
  const auto half_way = hn::Set(d32, static_cast<std::int32_t>(hn::Lanes(d32)) << 16);
  const auto low = hn::Or(first, hn::PromoteTo(d32, hn::LowerHalf(half, disparity)));
  const auto high = hn::Or(hn::Add(first, half_way), hn::PromoteTo(d32, hn::UpperHalf(half, disparity)));
  to.count += static_cast<int>(compress_store_two(low, high, mask, d32, d, to.pixel + to.count));
}

// first, first + 1, ...; Highway's Iota with a first that is not known stores the lanes one by one.
HWY_INLINE V32 from(std::int32_t first) {
  const D32 d;
  return hn::Add(hn::Iota(d, 0), hn::Set(d, first));
}

HWY_INLINE V32 value_at(const RowLine& line, V32 u) {
  const D32 d;
  const auto start = hn::Set(d, line.at_0);
  return line.per_u == 0 ? start : hn::Add(start, hn::Mul(u, hn::Set(d, line.per_u)));
}

// (a * b + half) >> kShift of every lane, by way of 64 bits; the result's low 32.
template <int kShift>
HWY_INLINE V32 scaled_product(V32 a, V32 b) {
  const D32 d;
  const hn::RepartitionToWide<hn::RebindToUnsigned<D32>> wide;
  const auto round = hn::Set(wide, std::uint64_t{1} << (kShift - 1));
  const auto odd = [&](V32 x) { return hn::BitCast(d, hn::ShiftRight<32>(hn::BitCast(wide, x))); };
  const auto even_product = hn::Add(hn::BitCast(wide, hn::MulEven(a, b)), round);
  const auto odd_product = hn::Add(hn::BitCast(wide, hn::MulEven(odd(a), odd(b))), round);
  return hn::OddEven(hn::BitCast(d, hn::ShiftLeft<32 - kShift>(odd_product)),
                     hn::BitCast(d, hn::ShiftRight<kShift>(even_product)));
}

HWY_INLINE V32 per_depth(const RowDirection& a, V32 u) {
  const D32 d;
  const hn::RebindToUnsigned<D32> unsigned_d;
  const auto whole = hn::Set(d, a.whole);
  if (a.whole_per_u == 0 && a.part_per_u == 0) return whole;
  const auto part =
      hn::Add(hn::Set(unsigned_d, a.part), hn::Mul(hn::BitCast(unsigned_d, u), hn::Set(unsigned_d, a.part_per_u)));
  return hn::Add(hn::Add(whole, hn::Mul(u, hn::Set(d, a.whole_per_u))), hn::BitCast(d, hn::ShiftRight<16>(part)));
}

// floor(mm / cell), exactly: half a millimetre more is at least half a millimetre away from every border, which is
// more than what float rounds at kProjectMaxMm. Less half a cell and rounded to the nearest integer it is the floor;
// adding 1.5 * 2^23 rounds, and leaves the integer in the low bits.
HWY_INLINE V32 cell_of(const Frame& f, V32 mm) {
  const DFloat d;
  const D32 ints;
  constexpr float kRound = 12582912.0F;
  const auto cells = hn::Mul(hn::ConvertTo(d, mm), hn::Set(d, f.cells_per_mm));
  const auto rounded = hn::Add(hn::Add(cells, hn::Set(d, f.to_middle)), hn::Set(d, kRound));
  return hn::Sub(hn::BitCast(ints, rounded), hn::BitCast(ints, hn::Set(d, kRound)));
}

HWY_INLINE V32 depth_at(const PruneModel& m, V32 index) {
  const D32 d;
  const auto last = hn::Set(d, static_cast<std::int32_t>(m.depth_mm.size()) - 1);
  return hn::GatherIndex(d, m.depth_mm.data(), hn::Min(hn::Max(index, hn::Set(d, 1)), last));
}

HWY_INLINE V32 columns_of(V32 pixels) {
  return hn::ShiftRight<16>(pixels);
}

HWY_INLINE V32 disparities_of(V32 pixels) {
  return hn::And(pixels, hn::Set(D32(), 0xFFFF));
}

// How far right of the map's left border.
HWY_INLINE V32 across_at(const Frame& f, V32 left) {
  const GridGeometry& g = f.grid.geometry;
  return hn::Sub(hn::Set(D32(), g.cols / 2 * g.cell_mm - f.model.left_mm), left);
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

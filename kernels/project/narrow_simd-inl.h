// Where a pixel lies, in 16 bits (NarrowTerms): what bin_narrow_simd-inl.h looks up and computes with.
#if defined(KERNELS_PROJECT_NARROW_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef KERNELS_PROJECT_NARROW_SIMD_INL_H
#undef KERNELS_PROJECT_NARROW_SIMD_INL_H
#else
#define KERNELS_PROJECT_NARROW_SIMD_INL_H
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/project/pixels_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::uint16_t kOutside16 = 0xFFFF;

HWY_INLINE V32 low_half(V16 v) {
  return hn::PromoteTo(D32(), hn::LowerHalf(Half16(), v));
}

HWY_INLINE V32 high_half(V16 v) {
  return hn::PromoteTo(D32(), hn::UpperHalf(Half16(), v));
}

// The low 16 bits of every lane.
HWY_INLINE VU16 narrowed(V32 low, V32 high) {
  const DU16 d;
  return hn::ConcatEven(d, hn::BitCast(d, high), hn::BitCast(d, low));
}

// scaled_product<16>(depth, whole * 2^16 + part), modulo 2^16.
HWY_INLINE VU16 times_depth(VU16 depth, V16 whole, VU16 part) {
  const DU16 d;
  const auto rounded = hn::Add(hn::MulHigh(depth, part), hn::ShiftRight<15>(hn::Mul(depth, part)));
  return hn::Add(rounded, hn::Mul(depth, hn::BitCast(d, whole)));
}

HWY_INLINE V16 cells_of(const CellDivider& divider, VU16 mm) {
  const DU16 d;
  const auto scaled = hn::MulHigh(mm, hn::Set(d, divider.multiplier));
  return hn::BitCast(D16(), hn::MulHigh(scaled, hn::Set(d, divider.shift)));
}

// A map's plane seen from the 16-bit coordinates.
class Plane16 {
 public:
  HWY_INLINE Plane16(const GridGeometry& g, const NarrowTerms& t, std::ptrdiff_t stride)
      : first_row_(t.first_row),
        first_col_(t.first_col),
        last_row_(static_cast<std::uint16_t>(g.rows - 1)),
        last_col_(static_cast<std::uint16_t>(g.cols - 1)),
        stride_(static_cast<std::uint16_t>(stride)) {}

  // kOutside16 where a lane is not in `which` or not on the map.
  HWY_INLINE VU16 cells(V16 row_there, V16 col_there, M16 which) const {
    const DU16 d;
    const D16 d_signed;
    const auto row = hn::BitCast(d, hn::Sub(row_there, hn::Set(d_signed, first_row_)));
    const auto col = hn::BitCast(d, hn::Sub(col_there, hn::Set(d_signed, first_col_)));
    const auto inside =
        hn::And(hn::Eq(hn::Min(row, hn::Set(d, last_row_)), row), hn::Eq(hn::Min(col, hn::Set(d, last_col_)), col));
    const auto cell = hn::Add(hn::Mul(row, hn::Set(d, stride_)), col);
    return hn::IfThenElse(hn::And(inside, hn::RebindMask(d, which)), cell, hn::Set(d, kOutside16));
  }

 private:
  std::int16_t first_row_, first_col_;
  std::uint16_t last_row_, last_col_, stride_;
};

// Mostly they are those of the row before.
void fill_direction(const RowDirection& a, int begin, int count, Direction16& to) {
  if (to.of == a && to.begin == begin && to.count == count) return;
  to.of = a;
  to.begin = begin;
  to.count = count;
  const D16 d;
  const DU16 du;
  const D32 d32;
  const int half = static_cast<int>(hn::Lanes(d32));
  for (int i = 0; i < count; i += 2 * half) {
    const auto low = per_depth(a, from(begin + i));
    const auto high = per_depth(a, from(begin + i + half));
    hn::Store(narrowed(low, high), du, to.part + i);
    hn::Store(hn::BitCast(d, narrowed(hn::ShiftRight<16>(low), hn::ShiftRight<16>(high))), d, to.whole + i);
  }
}

// Fills w.depth_pairs, or returns false: the tables are too long, or depth does not fall with the disparity.
bool make_depth_pairs(const PruneModel& m, Work& w) {
  const D32 d;
  const std::int64_t half_row = m.floor.per_v / 2;
  const std::int64_t last = static_cast<std::int64_t>(m.depth_mm.size()) - 1;
  const std::int64_t near_step = table_entry(half_row);
  const std::int64_t far_step = table_entry(-half_row);
  const std::int64_t farthest = std::max<std::int64_t>(table_entry(m.min_disparity), 1);
  // Beyond, both ends are the last entry.
  const std::int64_t count = last + 1 - far_step;
  if (last < 1 || half_row < 0 || count > kDepthPairs || near_step > kDepthPairs || farthest > kDepthPairs)
    return false;
  for (std::int64_t i = 1; i < last; ++i) {
    if (m.depth_mm[static_cast<std::size_t>(i)] < m.depth_mm[static_cast<std::size_t>(i + 1)]) return false;
  }
  w.depth_pair_count = static_cast<int>(count);
  const auto most = hn::Set(d, static_cast<std::int32_t>(last));
  const auto near = hn::Set(d, static_cast<std::int32_t>(near_step));
  const auto far = hn::Set(d, static_cast<std::int32_t>(far_step));
  const auto least = hn::Set(d, static_cast<std::int32_t>(farthest));
  for (int i = 0; i < w.depth_pair_count; i += static_cast<int>(hn::Lanes(d))) {
    const auto here = from(i);
    const auto near_mm = hn::GatherIndex(d, m.depth_mm.data(), hn::Min(hn::Max(hn::Add(here, near), least), most));
    const auto far_mm = hn::GatherIndex(d, m.depth_mm.data(), hn::Min(hn::Max(hn::Add(here, far), least), most));
    hn::Store(hn::Or(near_mm, hn::ShiftLeft<16>(far_mm)), d, w.depth_pairs + i);
  }
  return true;
}

// Depth at the floor's own disparity plus `add` (Q16) in every column.
void fill_floor_depth(const Frame& f, const RowLine& floor, std::int32_t add, int begin, int count,
                      std::uint16_t* to) {
  const DU16 d;
  const D32 d32;
  const int half = static_cast<int>(hn::Lanes(d32));
  const auto round = hn::Set(d32, add + (1 << (kDisparityToQ16 - 1)));
  const auto farthest = hn::Set(d32, static_cast<std::int32_t>(table_entry(f.model.min_disparity)));
  for (int i = 0; i < count; i += 2 * half) {
    const auto low = hn::ShiftRight<kDisparityToQ16>(hn::Add(value_at(floor, from(begin + i)), round));
    const auto high = hn::ShiftRight<kDisparityToQ16>(hn::Add(value_at(floor, from(begin + i + half)), round));
    hn::Store(narrowed(depth_at(f.model, hn::Max(low, farthest)), depth_at(f.model, hn::Max(high, farthest))), d,
              to + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

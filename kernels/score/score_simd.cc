// The reference's comparisons on as many cells at once as a vector of 32-bit numbers holds.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/score/score_simd.cc"
#include "hwy/foreach_target.h"
// foreach_target.h comes first, whatever the alphabet says.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/units.h"
#include "kernels/score/score.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D32 = hn::ScalableTag<std::uint32_t>;
using Half32 = hn::Half<D32>;
using D64 = hn::RepartitionToWide<hn::RebindToSigned<D32>>;  // half as many
using V32 = hn::Vec<D32>;

// All ones in the 64-bit lanes of cells whose sum of heights is above min_height * count, half a vector of cells.
hn::Vec<D32> is_high(const std::int64_t* sums, hn::Vec<Half32> counts, std::int32_t min_height_mm) {
  const D32 d32;
  const D64 d;
  const hn::RepartitionToWide<D32> wide;
  // MulEven multiplies the low halves of 64-bit lanes.
  const auto count = hn::BitCast(d32, hn::PromoteTo(wide, counts));
  const auto bound = hn::BitCast(d, hn::MulEven(count, hn::Set(d32, static_cast<std::uint32_t>(min_height_mm))));
  return hn::BitCast(d32, hn::VecFromMask(d, hn::Gt(hn::LoadU(d, sums), bound)));
}

// a >= b; unsigned comparisons come out of Max.
hn::Mask<D32> at_least(V32 a, V32 b) {
  return hn::Eq(hn::Max(a, b), a);
}

// One row of the map from column 0; returns how many cells it has done, a whole number of vectors.
std::size_t score_vectors(const CellThresholds* thresholds, std::int32_t min_height_mm, const NavGrid& grid,
                          int row) {
  const D32 d;
  const Half32 half;
  const hn::Rebind<std::uint8_t, D32> bytes;
  const std::size_t lanes = hn::Lanes(d);
  const auto cols = static_cast<std::size_t>(grid.geometry.cols);
  std::size_t col = 0;
  for (; col + lanes <= cols; col += lanes) {
    V32 points, floor_least, below_least, streak;
    hn::LoadInterleaved4(d, reinterpret_cast<const std::uint32_t*>(thresholds + col), points, floor_least,
                         below_least, streak);
    const auto count = hn::LoadU(d, grid.count.row(row) + col);
    const auto floor_count = hn::LoadU(d, grid.floor_count.row(row) + col);
    const auto below_count = hn::LoadU(d, grid.below_count.row(row) + col);
    const std::int64_t* sums = grid.height_sum.row(row) + col;
    const auto high_low = is_high(sums, hn::LowerHalf(half, count), min_height_mm);
    const auto high_high = is_high(sums + lanes / 2, hn::UpperHalf(half, count), min_height_mm);
    const auto high = hn::MaskFromVec(hn::ConcatEven(d, high_high, high_low));
    const auto seen = at_least(count, points);
    const auto below = hn::And(at_least(below_count, below_least), hn::Not(at_least(floor_count, below_count)));
    const auto free = hn::Or(seen, at_least(floor_count, floor_least));
    const auto obstacle = hn::Or(hn::And(seen, high), below);
    const auto type = hn::IfThenElse(
        obstacle, hn::Set(d, std::uint32_t{kCellObstacle}),
        hn::IfThenElse(free, hn::Set(d, std::uint32_t{kCellUnoccupied}), hn::Set(d, std::uint32_t{kCellUnknown})));
    hn::StoreU(hn::DemoteTo(bytes, hn::BitCast(hn::RebindToSigned<D32>(), type)), bytes, grid.type.row(row) + col);
  }
  return col;
}

void score_map(const CellThresholds* thresholds, std::int32_t min_height_mm, const NavGrid& grid) {
  const auto cols = static_cast<std::size_t>(grid.geometry.cols);
  for (int row = 0; row < grid.geometry.rows; ++row) {
    const CellThresholds* of_row = thresholds + static_cast<std::size_t>(row) * cols;
    const std::size_t done = score_vectors(of_row, min_height_mm, grid, row);
    score_cells_ref({of_row, cols}, min_height_mm, grid, row, static_cast<int>(done));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lakshya {

HWY_EXPORT(score_map);

Status score_simd(std::span<const CellThresholds> thresholds, std::int32_t min_height_mm, const NavGrid& grid) {
  const Status checked = check_score_arguments(thresholds, min_height_mm, grid);
  if (checked != Status::ok) return checked;
  HWY_DYNAMIC_DISPATCH(score_map)(thresholds.data(), min_height_mm, grid);
  check_weak_cells(thresholds, min_height_mm, grid);
  return Status::ok;
}

}  // namespace lakshya
#endif

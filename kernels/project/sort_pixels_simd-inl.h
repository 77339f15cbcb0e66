// First pass of project_simd.cc: which class each pixel has.
#if defined(KERNELS_PROJECT_SORT_PIXELS_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef KERNELS_PROJECT_SORT_PIXELS_SIMD_INL_H
#undef KERNELS_PROJECT_SORT_PIXELS_SIMD_INL_H
#else
#define KERNELS_PROJECT_SORT_PIXELS_SIMD_INL_H
#endif

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/compress_simd-inl.h"
#include "kernels/base/units.h"
#include "kernels/project/pixels_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The limits of every column of a piece, for a camera that rolls.
void fill_limits(const PruneModel& model, const RowTerms& t, int begin, int count, Work& w) {
  const D32 d;
  const Half16 half;
  const auto store = [&](V32 limit, std::int16_t* to) { hn::StoreU(hn::DemoteTo(half, limit), half, to); };
  const auto none = hn::Set(d, -1);
  const auto all = hn::Set(d, 32767);
  const auto below = [&](V32 bound) { return hn::ShiftRight<kDisparityToQ16>(hn::Add(bound, none)); };
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
    const auto u = from(begin + i);
    const auto floor = value_at(t.floor, u);
    const auto is_below = hn::Gt(floor, hn::Zero(d));
    const auto drop = hn::Min(value_at(t.drop_relative, u), value_at(t.drop_absolute, u));
    const auto up_to = hn::Max(value_at(t.floor_relative, u), value_at(t.floor_absolute, u));
    store(hn::IfThenElse(hn::Gt(floor, hn::Set(d, t.max_floor_disparity)), all, none), w.nothing + i);
    store(hn::IfThenElse(is_below, below(drop), none), w.drop + i);
    store(hn::IfThenElse(is_below, hn::ShiftRight<kDisparityToQ16>(up_to), none), w.floor_limit + i);
    const auto ceiling = value_at(t.ceiling, u);
    const auto is_above = hn::Lt(floor, hn::Zero(d));
    const auto low = model.ceiling_test == CeilingTest::above_camera ? below(ceiling) : all;
    const bool from_above = model.ceiling_test != CeilingTest::below_camera;
    store(from_above ? hn::IfThenElse(is_above, low, none) : none, w.ceiling_low + i);
    store(from_above ? all : hn::ShiftRight<kDisparityToQ16>(ceiling), w.ceiling_high + i);
  }
}

// A vector of pixels, in two halves of 32-bit lanes.
struct TwoHalves {
  V32 low, high;
};

HWY_INLINE void append(const TwoHalves& pixels, hn::Mask<D16> mask, Pixels& to) {
  const D16 d;
  if (hn::AllFalse(d, mask)) return;
  to.count += static_cast<int>(compress_store_two(pixels.low, pixels.high, mask, D32(), d, to.pixel + to.count));
}

void count_reasons(const D16 d, V16 disparity, std::size_t negative, PixelCounts& counts) {
  for (int reason = 1; reason < kNoDisparityReasons; ++reason) {
    const auto code = hn::Set(d, static_cast<std::int16_t>(-1 - reason));
    const std::size_t found = hn::CountTrue(d, hn::Eq(disparity, code));
    counts.by_reason[reason] += static_cast<std::uint32_t>(found);
    negative -= found;
  }
  counts.by_reason[0] += static_cast<std::uint32_t>(negative);
}

// Pixels [begin, begin + count) of a row, count a whole number of vectors, at `disparity`.
template <bool kLevel>
void sort_pixels(const RowTerms& t, const std::int16_t* disparity, int begin, int count, bool want_classes,
                 PixelCounts& counts, Work& w) {
  const D16 d;
  const D32 d32;
  const Half16 half;
  const hn::Rebind<std::uint8_t, D16> bytes;
  const auto limit = [&](std::int16_t of_row, const std::int16_t* of_column) {
    return kLevel ? hn::Set(d, of_row) : hn::Load(d, of_column);
  };
  const auto far_limit = hn::Set(d, t.far);
  std::size_t far_or_negative = 0, negative = 0, nothing_count = 0, drop_count = 0, floor_count = 0,
              ceiling_count = 0;
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
    const auto x = hn::LoadU(d, disparity + i);
    const auto is_negative = hn::Lt(x, hn::Zero(d));
    const std::size_t negatives = hn::CountTrue(d, is_negative);
    if (negatives > 0) count_reasons(d, x, negatives, counts);
    negative += negatives;
    const auto near = hn::Gt(x, far_limit);
    far_or_negative += hn::CountTrue(d, hn::Not(near));
    const auto known = hn::And(near, hn::Gt(x, limit(t.limits.nothing, w.nothing + i)));
    const auto above_drop = hn::Gt(x, limit(t.limits.drop, w.drop + i));
    const auto above_floor = hn::Gt(x, limit(t.limits.floor, w.floor_limit + i));
    const auto in_room = hn::AndNot(hn::Gt(x, limit(t.limits.ceiling_high, w.ceiling_high + i)),
                                    hn::Gt(x, limit(t.limits.ceiling_low, w.ceiling_low + i)));
    const auto drop = hn::AndNot(above_drop, known);
    const auto standing = hn::And(known, hn::And(above_drop, above_floor));
    const auto floor = hn::AndNot(above_floor, hn::And(known, above_drop));
    const auto obstacle = hn::And(standing, in_room);
    if (!kLevel || t.limits.nothing >= 0) nothing_count += hn::CountTrue(d, hn::AndNot(known, near));
    const auto first = hn::ShiftLeft<16>(from(begin + i));
    const auto half_way = hn::Set(d32, static_cast<std::int32_t>(hn::Lanes(d32)) << 16);
    const TwoHalves pixels = {hn::Or(first, hn::PromoteTo(d32, hn::LowerHalf(half, x))),
                              hn::Or(hn::Add(first, half_way), hn::PromoteTo(d32, hn::UpperHalf(half, x)))};
    append(pixels, obstacle, w.obstacles);
    append(pixels, floor, w.floor);
    append(pixels, drop, w.below);
    if (!want_classes) continue;
    const auto code = [&](PixelClass c) { return hn::Set(d, static_cast<std::int16_t>(c)); };
    auto classes = hn::IfThenElseZero(hn::Not(hn::Or(near, is_negative)), code(PixelClass::too_far));
    classes = hn::IfThenElse(standing, code(PixelClass::ceiling), classes);
    classes = hn::IfThenElse(obstacle, code(PixelClass::obstacle), classes);
    classes = hn::IfThenElse(floor, code(PixelClass::floor), classes);
    classes = hn::IfThenElse(drop, code(PixelClass::drop_off), classes);
    hn::StoreU(hn::DemoteTo(bytes, classes), bytes, w.classes + i);
  }
  drop_count = static_cast<std::size_t>(w.below.count);
  floor_count = static_cast<std::size_t>(w.floor.count);
  const auto obstacle_count = static_cast<std::size_t>(w.obstacles.count);
  ceiling_count =
      static_cast<std::size_t>(count) - far_or_negative - nothing_count - drop_count - floor_count - obstacle_count;
  const auto add = [&](PixelClass c, std::size_t n) {
    counts.by_class[static_cast<int>(c)] += static_cast<std::uint32_t>(n);
  };
  add(PixelClass::no_disparity, negative + nothing_count);
  add(PixelClass::too_far, far_or_negative - negative);
  add(PixelClass::drop_off, drop_count);
  add(PixelClass::floor, floor_count);
  add(PixelClass::ceiling, ceiling_count);
  add(PixelClass::obstacle, obstacle_count);
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

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

void count_reasons(const D16 d, V16 disparity, std::size_t negative, PixelCounts& counts) {
  for (int reason = 1; reason < kNoDisparityReasons; ++reason) {
    const auto code = hn::Set(d, static_cast<std::int16_t>(-1 - reason));
    const std::size_t found = hn::CountTrue(d, hn::Eq(disparity, code));
    counts.by_reason[reason] += static_cast<std::uint32_t>(found);
    negative -= found;
  }
  counts.by_reason[0] += static_cast<std::uint32_t>(negative);
}

HWY_INLINE std::int32_t sum_of_lanes(V16 lanes) {
  const D32 d;
  const Half16 half;
  const auto halves =
      hn::Add(hn::PromoteTo(d, hn::LowerHalf(half, lanes)), hn::PromoteTo(d, hn::UpperHalf(half, lanes)));
  return hn::GetLane(hn::SumOfLanes(d, halves));
}

// Classes of `count` pixels, a whole number of vectors, at `disparity`, into w.classes.
template <bool kLevel>
ClassCounts sort_pixels(const RowTerms& t, const std::int16_t* disparity, int count, PixelCounts& counts, Work& w) {
  const D16 d;
  const auto limit = [&](std::int16_t of_row, const std::int16_t* of_column) {
    return kLevel ? hn::Set(d, of_row) : hn::Load(d, of_column);
  };
  const auto code = [&](PixelClass c) { return hn::Set(d, static_cast<std::int16_t>(c)); };
  const ClassLimits limits = t.limits;  // stores to w cannot change a local
  const auto far_limit = hn::Set(d, t.far);
  // Minus the number found in each lane, which 16 bits hold for a piece.
  static_assert(kPiece < 1 << 15);
  auto negatives = hn::Zero(d), near_count = negatives, known_count = negatives, drop_count = negatives,
       floor_count = negatives, obstacle_count = negatives;
  const auto found = [&](V16& sum, M16 mask) { sum = hn::Add(sum, hn::VecFromMask(d, mask)); };
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
    const auto x = hn::LoadU(d, disparity + i);
    const auto is_negative = hn::Lt(x, hn::Zero(d));
    if (!hn::AllFalse(d, is_negative)) count_reasons(d, x, hn::CountTrue(d, is_negative), counts);
    found(negatives, is_negative);
    const auto near = hn::Gt(x, far_limit);
    const auto known = hn::And(near, hn::Gt(x, limit(limits.nothing, w.nothing + i)));
    const auto above_drop = hn::Gt(x, limit(limits.drop, w.drop + i));
    const auto above_floor = hn::Gt(x, limit(limits.floor, w.floor_limit + i));
    const auto in_room = hn::AndNot(hn::Gt(x, limit(limits.ceiling_high, w.ceiling_high + i)),
                                    hn::Gt(x, limit(limits.ceiling_low, w.ceiling_low + i)));
    const auto drop = hn::AndNot(above_drop, known);
    const auto standing = hn::And(known, hn::And(above_drop, above_floor));
    const auto floor = hn::AndNot(above_floor, hn::And(known, above_drop));
    const auto obstacle = hn::And(standing, in_room);
    found(near_count, near);
    found(known_count, known);
    found(drop_count, drop);
    found(floor_count, floor);
    found(obstacle_count, obstacle);
    auto classes = hn::IfThenElseZero(hn::Not(hn::Or(near, is_negative)), code(PixelClass::too_far));
    classes = hn::IfThenElse(standing, code(PixelClass::ceiling), classes);
    classes = hn::IfThenElse(obstacle, code(PixelClass::obstacle), classes);
    classes = hn::IfThenElse(floor, code(PixelClass::floor), classes);
    classes = hn::IfThenElse(drop, code(PixelClass::drop_off), classes);
    hn::Store(classes, d, w.classes + i);
  }
  const auto sum = [&](V16 lanes) { return static_cast<std::uint32_t>(-sum_of_lanes(lanes)); };
  const auto add = [&](PixelClass c, std::uint32_t n) { counts.by_class[static_cast<int>(c)] += n; };
  const std::uint32_t negative = sum(negatives), near = sum(near_count), known = sum(known_count);
  const ClassCounts in_map{sum(obstacle_count), sum(floor_count), sum(drop_count)};
  add(PixelClass::no_disparity, negative + near - known);
  add(PixelClass::too_far, static_cast<std::uint32_t>(count) - near - negative);
  add(PixelClass::drop_off, in_map.below);
  add(PixelClass::floor, in_map.floor);
  add(PixelClass::ceiling, known - in_map.below - in_map.floor - in_map.obstacles);
  add(PixelClass::obstacle, in_map.obstacles);
  return in_map;
}

// The pixels of one class, side by side.
void gather_class(PixelClass which, const std::int16_t* disparity, int begin, int count, const Work& w,
                  Pixels& to) {
  const D16 d;
  const auto code = hn::Set(d, static_cast<std::int16_t>(which));
  to.count = 0;
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d)))
    append(begin + i, hn::LoadU(d, disparity + i), hn::Eq(hn::Load(d, w.classes + i), code), to);
}

void write_classes(const Work& w, int count, PixelClass* to) {
  for (int i = 0; i < count; ++i)
    to[i] = static_cast<PixelClass>(w.classes[i]);
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

// The end of the selection (kernels/select): sub-pixel part, left-right check and the codes of a row of winners.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/units.h"
#include "kernels/select/select_simd-inl.h"
#include "kernels/select/sub_pixel_simd-inl.h"

#if defined(LAKSHYA_SELECT_FINISH_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LAKSHYA_SELECT_FINISH_SIMD_INL
#undef LAKSHYA_SELECT_FINISH_SIMD_INL
#else
#define LAKSHYA_SELECT_FINISH_SIMD_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

class Finish {
  using Ints = hn::CappedTag<std::int32_t, kMaxSumLanes / 2>;
  using Words = hn::Rebind<std::int16_t, Ints>;
  using Bytes = hn::Rebind<std::uint8_t, Ints>;
  using V = hn::Vec<Ints>;

 public:
  // Of sums times `scale`, of which every pixel's have the same part below.
  Finish(const SearchRange& range, const SelectParams& params, const SelectRows& rows, int scale)
      : range_(range), p_(params), rows_(rows), scale_(scale) {}

  void row(const std::uint8_t* textured, std::int16_t* disparity) const {
    const int lanes = static_cast<int>(hn::Lanes(Ints()));
    const int end = range_.valid_end;
    // The right pixels just outside agree with nobody.
    *rows_.right_of(range_.valid_begin - 1) = kNoRightWinner;
    *rows_.right_of(end) = kNoRightWinner;
    int u = range_.valid_begin;
    for (; u + lanes <= end; u += lanes)
      hn::StoreU(pixels(u, textured + u), Words(), disparity + u);
    if (u == end) return;
    std::uint8_t last_textured[kMaxSumLanes] = {};
    std::int16_t last[kMaxSumLanes];
    std::copy(textured + u, textured + end, last_textured);
    hn::StoreU(pixels(u, last_textured), Words(), last);
    std::copy_n(last, end - u, disparity + u);
  }

 private:
  static HWY_INLINE V lower(V pair) { return hn::ShiftRight<16>(hn::ShiftLeft<16>(pair)); }
  static HWY_INLINE V upper(V pair) { return hn::ShiftRight<16>(pair); }

  HWY_INLINE hn::Vec<Words> pixels(int u, const std::uint8_t* textured) const {
    const Ints d;
    const V zero = hn::Zero(d);
    const V first = hn::PromoteTo(d, hn::LoadU(Words(), rows_.first.data() + u));
    const V last = hn::PromoteTo(d, hn::LoadU(Words(), rows_.last.data() + u));
    V s01;
    V s23;
    V s45;
    V unused;
    const std::int16_t* near = rows_.near.data() + kNearSums * static_cast<std::ptrdiff_t>(u);
    hn::LoadInterleaved4(d, reinterpret_cast<const std::int32_t*>(near), s01, s23, s45, unused);
    // The winner is among the near candidates, which span at most three if they are only it and its neighbours.
    V before = lower(s01);
    V here = upper(s01);
    V after = lower(s23);
    const V next = upper(s23);
    const auto third = hn::Lt(next, hn::Min(here, after));
    const auto second = hn::Lt(after, here);
    V place = hn::IfThenElseZero(second, hn::Set(d, 1));
    before = hn::IfThenElse(third, after, hn::IfThenElse(second, here, before));
    const V after_second = hn::IfThenElse(second, next, after);
    here = hn::IfThenElse(third, next, hn::Min(here, after));
    after = hn::IfThenElse(third, lower(s45), after_second);
    place = hn::IfThenElse(third, hn::Set(d, 2), place);
    const V best = hn::Add(first, place);
    const V reach = hn::Max(hn::Sub(last, best), place);
    const V part = sub_pixel(d, range_.disparities, scale_, best, before, here, after);
    const V whole = hn::Add(best, hn::Set(d, range_.first));
    V result = hn::Add(hn::Add(hn::ShiftLeft<kDisparityBits>(whole), part), hn::Set(d, p_.offset16));
    if (p_.left_right_max >= 0) {
      // The right pixels of the disparity rounded down and up: the winner's, and with a fraction one beside it. Any, where
      // there is no winner.
      const V pixel = hn::Add(hn::Iota(d, 0), hn::Set(d, u));
      const V column =
          hn::Min(hn::Max(hn::Sub(pixel, whole), hn::Set(d, range_.valid_begin)), hn::Set(d, range_.valid_end - 1));
      const V pair = hn::Add(column, hn::VecFromMask(d, hn::Gt(part, zero)));  // from the one before
      const auto agrees = right_pair_agrees(d, rows_.right_of(0), pair, best, part, p_.left_right_max);
      result = hn::IfThenElse(agrees, result, hn::Set(d, std::int32_t{kLeftRightFailed}));
    }
    if (p_.uniqueness_percent != 0) {
      // No sum is less than 0.
      const auto rivals = hn::And(hn::Gt(reach, hn::Set(d, 1)), hn::Gt(here, hn::Set(d, scale_ - 1 - kSumBias)));
      result = hn::IfThenElse(rivals, hn::Set(d, std::int32_t{kNotUnique}), result);
    }
    result = hn::IfThenElse(hn::Lt(first, zero), hn::Set(d, std::int32_t{kNotSearched}), result);
    const auto flat = hn::Eq(hn::PromoteTo(d, hn::LoadU(Bytes(), textured)), zero);
    return hn::DemoteTo(Words(), hn::IfThenElse(flat, hn::Set(d, std::int32_t{kLowTexture}), result));
  }

  SearchRange range_;
  SelectParams p_;
  SelectRows rows_;
  int scale_;
};

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();
#endif

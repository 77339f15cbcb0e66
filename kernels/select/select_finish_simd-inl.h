// The end of the selection (kernels/select): sub-pixel part, left-right check and the codes of a row of winners.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/units.h"
#include "kernels/select/select_simd-inl.h"

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
  Finish(const SearchRange& range, const SelectParams& params, const SelectRows& rows)
      : range_(range), p_(params), rows_(rows) {}

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
  // 1/16 px: floor((16 num + den) / (2 den)). The quotient of a winner is between 0 and 16.5 away from 0 and differs from
  // every whole number by nothing or by at least 1 / (2 den) > 2^-19, so its rounding to a float (2^-20 at most) does
  // not change its floor.
  HWY_INLINE V fraction(int u, V best) const {
    const Ints d;
    const hn::RebindToFloat<Ints> df;
    V before_and_here;
    V after;
    const std::int16_t* sums = rows_.near.data() + kNearSums * static_cast<std::ptrdiff_t>(u);
    hn::LoadInterleaved2(d, reinterpret_cast<const std::int32_t*>(sums), before_and_here, after);
    const V before = hn::ShiftRight<16>(hn::ShiftLeft<16>(before_and_here));
    const V here = hn::ShiftRight<16>(before_and_here);
    after = hn::ShiftRight<16>(hn::ShiftLeft<16>(after));
    const V curvature = hn::Sub(hn::Add(before, after), hn::Add(here, here));
    const V denominator = hn::Max(curvature, hn::Set(d, 1));
    const V dividend = hn::Add(hn::ShiftLeft<kDisparityBits>(hn::Sub(before, after)), denominator);
    const auto quotient =
        hn::Div(hn::ConvertTo(df, dividend), hn::ConvertTo(df, hn::Add(denominator, denominator)));
    const auto inner = hn::And(hn::Gt(best, hn::Zero(d)), hn::Lt(best, hn::Set(d, range_.disparities - 1)));
    return hn::IfThenElseZero(inner, hn::ConvertTo(d, hn::Floor(quotient)));
  }

  // Whether the winner of right pixel `column` is near to `best`.
  HWY_INLINE hn::Mask<Ints> agrees(V column, V best) const {
    const Ints d;
    const V theirs = hn::GatherIndex(d, rows_.right_of(0), column);
    return hn::Lt(hn::Abs(hn::Sub(best, theirs)), hn::Set(d, std::min(p_.left_right_max, kMaxDisparities) + 1));
  }

  HWY_INLINE hn::Vec<Words> pixels(int u, const std::uint8_t* textured) const {
    const Ints d;
    const V zero = hn::Zero(d);
    const V best = hn::PromoteTo(d, hn::LoadU(Words(), rows_.best.data() + u));
    const V part = fraction(u, best);
    const V whole = hn::Add(best, hn::Set(d, range_.first));
    V result = hn::Add(hn::Add(hn::ShiftLeft<kDisparityBits>(whole), part), hn::Set(d, p_.offset16));
    if (p_.left_right_max >= 0) {
      // The right pixels of the disparity rounded down and up: the winner's, and with a fraction one beside it. Any, where
      // there is no winner.
      const V pixel = hn::Add(hn::Iota(d, 0), hn::Set(d, u));
      const V here =
          hn::Min(hn::Max(hn::Sub(pixel, whole), hn::Set(d, range_.valid_begin)), hn::Set(d, range_.valid_end - 1));
      const V right = hn::VecFromMask(d, hn::Gt(part, zero));  // -1
      const V left = hn::VecFromMask(d, hn::Lt(part, zero));
      const V beside = hn::Sub(hn::Add(here, right), left);
      result = hn::IfThenElse(hn::Or(agrees(here, best), agrees(beside, best)), result,
                              hn::Set(d, std::int32_t{kLeftRightFailed}));
    }
    result = hn::IfThenElse(hn::Lt(best, zero), best, result);
    const auto flat = hn::Eq(hn::PromoteTo(d, hn::LoadU(Bytes(), textured)), zero);
    return hn::DemoteTo(Words(), hn::IfThenElse(flat, hn::Set(d, std::int32_t{kLowTexture}), result));
  }

  SearchRange range_;
  SelectParams p_;
  SelectRows rows_;
};

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();
#endif

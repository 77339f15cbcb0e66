// Two steps of the selection (kernels/select) that every matcher takes, on 32-bit lanes of pixels.
#if defined(LAKSHYA_SUB_PIXEL_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LAKSHYA_SUB_PIXEL_SIMD_INL
#undef LAKSHYA_SUB_PIXEL_SIMD_INL
#else
#define LAKSHYA_SUB_PIXEL_SIMD_INL
#endif

#include <algorithm>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/search_range.h"
#include "kernels/base/units.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// 1/16 px relative to the winner, of sums times `scale`: floor((16 num + den) / (2 den)). The quotient of a winner is
// between 0 and 16.5 away from 0 and differs from every whole number by nothing or by at least 1 / (2 den) > 2^-19, so its
// rounding to a float (2^-20 at most) does not change its floor.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V sub_pixel(D d, int disparities, int scale, V best, V before, V here, V after) {
  const hn::RebindToFloat<D> df;
  const V curvature = hn::Sub(hn::Add(before, after), hn::Add(here, here));
  const V denominator = hn::Max(curvature, hn::Set(d, scale));
  const V dividend = hn::Add(hn::ShiftLeft<kDisparityBits>(hn::Sub(before, after)), denominator);
  const auto quotient = hn::Div(hn::ConvertTo(df, dividend), hn::ConvertTo(df, hn::Add(denominator, denominator)));
  const auto inner = hn::And(hn::Gt(best, hn::Zero(d)), hn::Lt(best, hn::Set(d, disparities - 1)));
  return hn::IfThenElseZero(inner, hn::ConvertTo(d, hn::Floor(quotient)));
}

// Whether a right pixel's own winner is near to `best`: that of right pixel `first`, or, where there is a fraction, of the
// one after it in `winners`. One load for the two.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> right_pair_agrees(D d, const std::int16_t* winners, V first, V best, V fraction,
                                         int left_right_max) {
  const V pair = hn::GatherOffset(d, reinterpret_cast<const std::int32_t*>(winners), hn::ShiftLeft<1>(first));
  const V limit = hn::Set(d, std::min(left_right_max, kMaxDisparities) + 1);
  const V lower = hn::ShiftRight<16>(hn::ShiftLeft<16>(pair));
  const V upper = hn::ShiftRight<16>(pair);
  const auto lower_agrees = hn::Lt(hn::Abs(hn::Sub(best, lower)), limit);
  const auto upper_agrees = hn::Lt(hn::Abs(hn::Sub(best, upper)), limit);
  return hn::Or(lower_agrees, hn::And(upper_agrees, hn::Ne(fraction, hn::Zero(d))));
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();
#endif

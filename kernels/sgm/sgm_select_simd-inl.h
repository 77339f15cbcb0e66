// From the winners of a row to its disparities, as kernels/select says: the right image's winners, then everything that
// decides about a pixel, for a vector of pixels.
#if defined(LAKSHYA_SGM_SELECT_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LAKSHYA_SGM_SELECT_SIMD_INL
#undef LAKSHYA_SGM_SELECT_SIMD_INL
#else
#define LAKSHYA_SGM_SELECT_SIMD_INL
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernels/base/units.h"
#include "kernels/select/sub_pixel_simd-inl.h"
#include "kernels/sgm/sgm.h"
#include "kernels/sgm/sgm_sums_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {

// Where there is no right pixel: far from every candidate.
inline constexpr std::int16_t kNoRightWinner = -10'000;

// The candidates that right pixels match best: as many of them as a vector has bytes, from y on (reversed). They keep
// their least sums and the places of these in registers, while the left pixels that can match them pass by: their sums
// for these right pixels lie side by side.
class RightWinners {
 public:
  RightWinners(const SearchRange& range, int width, const RowShape& shape, int y, const SgmSimdRows& rows)
      : width_(width),
        begin_(std::max(range.valid_begin, width - y - static_cast<int>(hn::Lanes(Bytes())))),
        end_(std::min(range.valid_end, width - 1 - y + static_cast<int>(shape.pitch))),
        y_(y),
        pitch_(shape.spaced),
        sums_(rows.sums.data()),
        winners_(rows.right_winner.data() + y) {}

  // The left pixel after the last that can match one of them.
  int end() const { return end_; }

  void find() const {
    const Bytes d;
    const std::size_t pitch = pitch_;
    constexpr int kSteps = 255;  // places of a byte, 0 is none
    const auto one = hn::Set(d, 1);
    auto lowest = hn::Set(d, 255);
    for (int begin = begin_; begin < end_; begin += kSteps) {
      const int end = std::min(begin + kSteps, end_);
      auto place = hn::Zero(d);
      if (begin == begin_) {
        // No sum is more than 255: the first left pixel that can match stands from the start.
        const auto head = hn::Set(d, static_cast<std::uint8_t>(std::clamp(width_ - 1 - y_ - begin, 0, 254)));
        place = hn::Add(hn::SaturatedSub(head, hn::Iota(d, 0)), one);
      }
      auto step = one;
      // The sum of the vector's first right pixel; from one left pixel to the next it is that of the next candidate. What
      // lies before the candidates and after them is 255.
      const std::uint8_t* sums = sums_ + static_cast<std::ptrdiff_t>(pitch) * (begin + 1) + candidate(begin);
#pragma GCC unroll 4
      for (int u = begin; u < end; ++u, sums += pitch + 1) {
        const auto less = hn::Min(lowest, hn::LoadU(d, sums));
        place = hn::Max(place, hn::IfThenZeroElse(hn::Eq(less, lowest), step));
        lowest = less;
        step = hn::Add(step, one);
      }
      store(place, begin);
    }
  }

 private:
  // Of the first right pixel, for left pixel u.
  HWY_INLINE int candidate(int u) const {
    return y_ - (width_ - 1) + u;
  }

  // `place` counts the left pixels from `begin` on; where it is 0, what has been found before stays.
  HWY_INLINE void store(ByteVec place, int begin) const {
    const Bytes d;
    const hn::Repartition<std::int16_t, Bytes> d16;
    const hn::Rebind<std::uint8_t, decltype(d16)> d8;  // as many bytes as words
    const int words = static_cast<int>(hn::Lanes(d16));
    alignas(kMaxVectorBytes) std::uint8_t places[kMaxVectorBytes];
    hn::Store(place, d, places);
    for (int k = 0; k < static_cast<int>(hn::Lanes(d)); k += words) {
      const auto steps = hn::PromoteTo(d16, hn::LoadU(d8, places + k));
      const auto first = hn::Set(d16, static_cast<std::int16_t>(candidate(begin) + k - 1));
      const auto found = hn::Add(hn::Add(steps, hn::Iota(d16, 0)), first);
      const auto kept = hn::LoadU(d16, winners_ + k);
      hn::StoreU(hn::IfThenElse(hn::Eq(steps, hn::Zero(d16)), kept, found), d16, winners_ + k);
    }
  }

  int width_;
  int begin_;
  int end_;
  int y_;
  std::size_t pitch_;
  const std::uint8_t* sums_;
  std::int16_t* winners_;
};

// Decides about the pixels of a row.
class Decide {
 public:
  using Ints = hn::Repartition<std::int32_t, Bytes>;
  using Int = hn::Vec<Ints>;

  Decide(const SgmParams& params, int width, const SgmSimdRows& rows)
      : p_(params),
        width_(width),
        rows_(rows),
        first_(params.range.first),
        unique_no_more_(unique_no_more(params.select.uniqueness_percent)) {}

  void row(const std::uint8_t* textured, std::int16_t* disparity) const {
    const int lanes = static_cast<int>(hn::Lanes(Ints()));
    const int end = p_.range.valid_end;
    int u = p_.range.valid_begin;
    for (; u + lanes <= end; u += lanes)
      pixels(u, textured + u, disparity + u);
    if (u == end) return;
    std::uint8_t last_textured[kMaxVectorBytes] = {};
    std::int16_t last_disparities[kMaxVectorBytes];
    std::copy(textured + u, textured + end, last_textured);
    pixels(u, last_textured, last_disparities);
    std::copy_n(last_disparities, end - u, disparity + u);
  }

 private:
  template <int kByte>
  static HWY_INLINE Int byte(hn::Vec<hn::RebindToUnsigned<Ints>> words) {
    const hn::RebindToUnsigned<Ints> d;
    return hn::BitCast(Ints(), hn::And(hn::ShiftRight<8 * kByte>(words), hn::Set(d, 255U)));
  }

  HWY_INLINE hn::Mask<Ints> has_rivals(int u) const {
    // Half of a word of 64 bits each, and each other half after it.
    const Ints d;
    const auto* bits = reinterpret_cast<const std::int32_t*>(rows_.rivals.data() + u);
    auto lower = hn::Zero(d);
    auto upper = lower;
    hn::LoadInterleaved2(d, bits, lower, upper);
    return hn::Ne(hn::Or(lower, upper), hn::Zero(d));
  }

  HWY_INLINE void pixels(int u, const std::uint8_t* textured, std::int16_t* disparity) const {
    const Ints d;
    const hn::Rebind<std::uint8_t, Ints> d8;
    const hn::Rebind<std::int16_t, Ints> d16;
    const auto column = static_cast<std::size_t>(u);
    const auto zero = hn::Zero(d);
    const auto pixel = hn::Add(hn::Iota(d, 0), hn::Set(d, u));
    const auto best = hn::LoadU(d, rows_.winner.data() + column);
    const auto sums = hn::LoadU(hn::RebindToUnsigned<Ints>(), rows_.winner_sums.data() + column);
    const auto before = byte<0>(sums);
    const auto sum = byte<1>(sums);
    const auto after = byte<2>(sums);
    const auto part = sub_pixel(d, p_.range.disparities, 1, best, before, sum, after);
    const auto whole = hn::Add(best, hn::Set(d, first_));
    auto result = hn::Add(hn::Add(hn::ShiftLeft<kDisparityBits>(whole), part), hn::Set(d, p_.select.offset16));
    if (p_.select.left_right_max >= 0) {
      // The right pixel of the winner, and on the fraction's side its neighbour. The last pixels of a row's last vector do
      // not exist.
      const auto y = hn::Add(hn::Sub(hn::Set(d, width_ - 1), pixel), best);
      const auto first = hn::Max(hn::Sub(y, hn::IfThenElseZero(hn::Lt(part, zero), hn::Set(d, 1))), zero);
      const auto agrees =
          right_pair_agrees(d, rows_.right_winner.data(), first, best, part, p_.select.left_right_max);
      result = hn::IfThenElse(agrees, result, hn::Set(d, kLeftRightFailed));
    }
    result = hn::IfThenElse(hn::Or(has_rivals(u), hn::Gt(sum, hn::Set(d, unique_no_more_ - 1))),
                            hn::Set(d, kNotUnique), result);
    const auto u_right = hn::Sub(pixel, whole);
    const auto inside = hn::And(hn::Gt(u_right, hn::Set(d, p_.range.valid_begin - 1)),
                                hn::Lt(u_right, hn::Set(d, p_.range.valid_end)));
    result = hn::IfThenElse(inside, result, hn::Set(d, kNotSearched));
    const auto flat = hn::Eq(hn::PromoteTo(d, hn::LoadU(d8, textured)), zero);
    result = hn::IfThenElse(flat, hn::Set(d, kLowTexture), result);
    hn::StoreU(hn::DemoteTo(d16, result), d16, disparity);
  }

  const SgmParams& p_;
  int width_;
  const SgmSimdRows& rows_;
  std::int32_t first_;
  std::int32_t unique_no_more_;
};

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

// From the sums of a row to its disparities, as kernels/select says: winner, uniqueness and sub-pixel of a pixel while
// its sums are at hand, then the right image's winners and the left-right check of the row.
#if defined(LAKSHYA_SGM_SELECT_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LAKSHYA_SGM_SELECT_SIMD_INL
#undef LAKSHYA_SGM_SELECT_SIMD_INL
#else
#define LAKSHYA_SGM_SELECT_SIMD_INL
#endif

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "kernels/base/integer.h"
#include "kernels/base/units.h"
#include "kernels/sgm/candidates_simd-inl.h"
#include "kernels/sgm/sgm.h"
#include "kernels/sgm/sgm_cost_simd-inl.h"
#include "kernels/sgm/sgm_simd_rows.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {

// Sums below this limit make a least sum `s` ambiguous; more than 255: every candidate is below it.
inline void unique_limits(int uniqueness_percent, std::uint16_t (&limit)[256]) {
  const int share = 100 - uniqueness_percent;
  for (int s = 0; s < 256; ++s)
    limit[s] = static_cast<std::uint16_t>((100 * s + share - 1) / share);
}

// kVectors: vectors per pixel where it is known at compile time, else 0.
template <std::size_t kVectors>
class WinnerOfPixel {
 public:
  WinnerOfPixel(const SgmParams& params, const SgmSimdRows& rows, const std::uint16_t* unique_limit,
                std::size_t vectors)
      : p_(params), winners_(rows.winner.data()), limits_(unique_limit), vectors_(vectors) {}

  HWY_INLINE std::int16_t without_texture(int u) const { return decided(u, kLowTexture); }

  // sums: S of pixel u; lowest: its least in every byte.
  HWY_INLINE std::int16_t of(int u, const std::uint8_t* sums, ByteVec lowest) const {
    const Bytes d;
    const std::size_t lanes = hn::Lanes(d);
    const unsigned least_sum = first_byte(lowest);
    const unsigned limit = limits_[least_sum];
    const auto limits = hn::Set(d, static_cast<std::uint8_t>(std::min(limit, 255U)));
    // One bit per candidate. A vector's bits may be stored over the next vector's place, which is stored later.
    std::uint64_t equal[kWords];
    std::uint64_t below[kWords];
    const std::size_t words = (vectors() * lanes + 63) / 64;
    equal[words - 1] = 0;
    below[words - 1] = 0;
    for (std::size_t k = 0; k < vectors(); ++k) {
      const auto s = hn::Load(d, sums + k * lanes);
      (void)hn::StoreMaskBits(d, hn::Eq(s, lowest), reinterpret_cast<std::uint8_t*>(equal) + k * lanes / 8);
      const auto close = hn::SaturatedSub(limits, s);
      (void)hn::StoreMaskBits(d, hn::Ne(close, hn::Zero(d)),
                              reinterpret_cast<std::uint8_t*>(below) + k * lanes / 8);
    }
    int best = 0;
    int ambiguous = 0;
    for (std::size_t w = words; w-- > 0;) {
      best = equal[w] != 0 ? static_cast<int>(64 * w) + std::countr_zero(equal[w]) : best;
      ambiguous += std::popcount(below[w]);
    }
    const int u_right = u - (p_.range.first + best);
    if (u_right < p_.range.valid_begin || u_right >= p_.range.valid_end) return decided(u, kNotSearched);
    const int last = p_.range.disparities - 1;
    const unsigned before = best > 0 ? sums[best - 1] : 255U;
    const unsigned after = best < last ? sums[best + 1] : 255U;
    ambiguous -=
        static_cast<int>(least_sum < limit) + static_cast<int>(before < limit) + static_cast<int>(after < limit);
    if (limit > 255 || ambiguous > 0) return decided(u, kNotUnique);
    winners_[u] = static_cast<std::int16_t>(best);
    int fraction16 = 0;
    if (best > 0 && best < last) {
      const int numerator = static_cast<int>(before) - static_cast<int>(after);
      const int curvature = static_cast<int>(before + after - 2 * least_sum);
      const int denominator = curvature > 1 ? curvature : 1;
      fraction16 = floor_divide(kDisparityScale * numerator + denominator, 2 * denominator);
    }
    return static_cast<std::int16_t>(kDisparityScale * (p_.range.first + best) + fraction16 + p_.select.offset16);
  }

 private:
  static constexpr std::size_t kWords = kVectors > 0 ? kVectors : kMaxDisparities / 64 + 1;
  std::size_t vectors() const { return kVectors > 0 ? kVectors : vectors_; }

  HWY_INLINE std::int16_t decided(int u, NoDisparity reason) const {
    winners_[u] = -1;
    return reason;
  }

  const SgmParams& p_;
  std::int16_t* winners_;
  const std::uint16_t* limits_;
  std::size_t vectors_;
};

// The left pixel that each right pixel matches best, of the right pixels in `valid`. As many right pixels as a vector
// has bytes keep their least sum and its place in registers, while the left pixels that can match them pass by: their
// sums for these right pixels lie side by side.
inline void right_winners(const SgmParams& p, int width, std::size_t pitch, ReversedRange valid,
                          const SgmSimdRows& rows) {
  const Bytes d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const int span = static_cast<int>(pitch);
  constexpr int kSteps = 255;  // places of a byte, 0 is none
  const auto one = hn::Set(d, 1);
  for (int y = valid.begin; y < valid.end; y += lanes) {
    const int first_pixel = std::max(p.range.valid_begin, width - y - lanes);
    const int last_pixel = std::min(p.range.valid_end, width - 1 - y + span);
    std::int16_t* winners = rows.right_winner.data() + y;
    auto lowest = hn::Set(d, 255);
    for (int begin = first_pixel; begin < last_pixel; begin += kSteps) {
      const int end = std::min(begin + kSteps, last_pixel);
      auto place = hn::Zero(d);
      if (begin == first_pixel) {
        // A sum of 255 is never less: the first left pixel that can match stands from the start.
        const auto head = hn::Set(d, static_cast<std::uint8_t>(std::clamp(width - 1 - y - begin, 0, 254)));
        place = hn::Add(hn::SaturatedSub(head, hn::Iota(d, 0)), one);
      }
      auto step = one;
      for (int u = begin; u < end; ++u) {
        const int i = y - (width - 1) + u;  // candidate of the vector's first right pixel
        auto s = hn::LoadU(d, rows.sums.data() + static_cast<std::ptrdiff_t>(pitch) * (u + 1) + i);
        if (i < 0 || i + lanes > span) s = hn::Or(s, hn::LoadU(d, rows.outside.data() + kMaxVectorBytes + i));
        const auto less = hn::Min(lowest, s);
        place = hn::Max(place, hn::IfThenZeroElse(hn::Eq(less, lowest), step));
        lowest = less;
        step = hn::Add(step, one);
      }
      alignas(kMaxVectorBytes) std::uint8_t places[kMaxVectorBytes];
      hn::Store(place, d, places);
      for (int k = 0; k < lanes; ++k)
        winners[k] = places[k] != 0 ? static_cast<std::int16_t>(begin + places[k] - 1) : winners[k];
    }
  }
}

// Takes back disparities whose right pixels are matched better by others.
inline void left_right_check(const SgmParams& p, int width, const SgmSimdRows& rows, std::int16_t* disparity) {
  const int base = kDisparityScale * p.range.first + p.select.offset16;
  for (int u = p.range.valid_begin; u < p.range.valid_end; ++u) {
    const int best = rows.winner[static_cast<std::size_t>(u)];
    if (best < 0) continue;
    const int fraction16 = disparity[u] - base - kDisparityScale * best;
    const int down = best + (fraction16 < 0 ? -1 : 0);
    const int up = best + (fraction16 > 0 ? 1 : 0);
    bool agrees = false;
    for (int i = down; i <= up; ++i) {
      const int u_right = u - (p.range.first + i);
      if (u_right < p.range.valid_begin || u_right >= p.range.valid_end) continue;
      const int y = width - 1 - u + i;
      // Of the right pixel's candidates the one that its winner stands for.
      const int right_best = y - (width - 1) + rows.right_winner[static_cast<std::size_t>(y)];
      agrees = agrees || std::abs(best - right_best) <= p.select.left_right_max;
    }
    if (!agrees) disparity[u] = kLeftRightFailed;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

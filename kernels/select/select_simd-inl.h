// Selection (kernels/select) while the window sums of a row are being made: a ring of the last pixels' sums, disparity
// contiguous, one vector of candidates after the other.
//
// Sums are stored as int16, the uint16 sum minus 32768, because x86 compares signed lanes only. Before and after the
// candidates of a pixel lie as many elements as a vector holds, kSumPadding, which never win.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "hwy/highway.h"
#include "kernels/base/search_range.h"
#include "kernels/base/units.h"
#include "kernels/select/select.h"

#if defined(LAKSHYA_SELECT_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LAKSHYA_SELECT_SIMD_INL
#undef LAKSHYA_SELECT_SIMD_INL
#else
#define LAKSHYA_SELECT_SIMD_INL
#endif

#ifndef LAKSHYA_SELECT_SIMD_SHARED
#define LAKSHYA_SELECT_SIMD_SHARED
namespace lakshya {

inline constexpr int kMaxSumLanes = 32;  // int16 in 64 bytes: no vector is made longer
inline constexpr int kSumBias = 32768;
inline constexpr std::int16_t kSumPadding = 32767;
inline constexpr std::int16_t kNoRightWinner = -2 * kMaxDisparities;
inline constexpr int kPixelsPerStep = 32;  // sums first, then winners: as many as stay in the first cache

constexpr int sum_stride(int disparities, int lanes) {
  return disparities + 2 * lanes;
}

// Right pixels are searched a vector at a time, once the last left pixel that can match one of them is there.
constexpr int sum_slots(int disparities) {
  return disparities + kMaxSumLanes + kPixelsPerStep;
}

// Of one row.
struct SelectRows {
  int lanes = kMaxSumLanes;
  std::span<std::int16_t> sums;      // sum_slots x sum_stride
  std::span<std::int16_t> best;      // winner of a left pixel, or -1 when its disparity is decided
  std::span<std::int16_t> fraction;  // its sub-pixel part
  std::span<std::int16_t> right;     // winner of a right pixel

  std::int16_t& right_of(int u) const { return right[static_cast<std::size_t>(u + 1)]; }
  // Candidate 0 of slot `index`; pixel u has slot (u - valid_begin) mod sum_slots.
  std::int16_t* slot(int disparities, int index) const {
    return sums.data() + static_cast<std::ptrdiff_t>(index) * sum_stride(disparities, lanes) + lanes;
  }
};

}  // namespace lakshya
#endif

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// First and last candidate whose sum is at most `limit`; there is one.
struct Candidates {
  int first;
  int last;
};

template <class D>
using MaskBits = std::conditional_t<hn::MaxLanes(D()) <= 8, std::uint8_t,
                                    std::conditional_t<hn::MaxLanes(D()) <= 16, std::uint16_t, std::uint32_t>>;

// Bit k: candidate k of `count` (at most 64, a constant after inlining) is above the limit.
template <class D>
HWY_INLINE std::uint64_t bits_above(D d, const std::int16_t* sums, int count, hn::Vec<D> limit) {
  const int lanes = static_cast<int>(hn::Lanes(d));
  std::uint64_t bits = 0;
  for (int i = 0; i < count; i += lanes) {
    // Just as wide as the vector: a wider one would be written in part and read as a whole, which stalls.
    MaskBits<D> above = 0;
    hn::StoreMaskBits(d, hn::Gt(hn::LoadU(d, sums + i), limit), reinterpret_cast<std::uint8_t*>(&above));
    bits |= std::uint64_t{above} << i;
  }
  return bits;
}

template <class D>
HWY_INLINE Candidates at_most(D d, const std::int16_t* sums, int disparities, std::int16_t limit) {
  const auto limits = hn::Set(d, limit);
  if (disparities == 64) {
    const std::uint64_t bits = ~bits_above(d, sums, 64, limits);
    return {std::countr_zero(bits), 63 - std::countl_zero(bits)};
  }
  Candidates found{-1, 0};
  for (int word = 0; word < disparities; word += 64) {
    const int rest = disparities - word;
    const std::uint64_t bits = rest >= 64
                                   ? ~bits_above(d, sums + word, 64, limits)
                                   : bits_above(d, sums + word, rest, limits) ^ ((std::uint64_t{1} << rest) - 1);
    if (bits == 0) continue;
    if (found.first < 0) found.first = word + std::countr_zero(bits);
    found.last = word + 63 - std::countl_zero(bits);
  }
  return found;
}

class Selection {
 public:
  Selection(const SearchRange& range, const SelectParams& params, const SelectRows& rows)
      : range_(range), p_(params), rows_(rows), reciprocal_((std::uint64_t{1} << 32) / divisor() + 1) {}

  // Winner, uniqueness and sub-pixel of left pixel u, whose least (biased) sum is `least`; returns the code if it has no
  // disparity.
  // kInside: every candidate of the pixel is in the right image.
  template <bool kInside, class D>
  HWY_INLINE std::int16_t select_left(D d, int disparities, int u, const std::int16_t* sums, int least) const {
    const int sum = least + kSumBias;
    int winner = 0;
    bool unique = true;
    const int right_column = u - range_.first;  // of candidate 0
    if (!kInside || p_.uniqueness_percent == 0 || sum == 0) {
      winner = at_most(d, sums, disparities, static_cast<std::int16_t>(least)).first;
      if (right_column - winner >= range_.valid_end || right_column - winner < range_.valid_begin) {
        rows_.best[static_cast<std::size_t>(u)] = -1;
        return kNotSearched;
      }
    }
    if (p_.uniqueness_percent != 0 && sum != 0) {
      const Candidates near = at_most(d, sums, disparities, limit(sum));
      // The winner is among them; with its two neighbours it spans at most three. No branch before the end: what the
      // images hold would be guessed wrong too often.
      const int a = sums[near.first];
      const int b = sums[near.first + 1];  // the padding, when there is none
      const int c = sums[near.first + 2];
      winner = near.first + (c < std::min(a, b) ? 2 : (b < a ? 1 : 0));
      unique = std::max(near.last - winner, winner - near.first) <= 1;
    }
    rows_.best[static_cast<std::size_t>(u)] = static_cast<std::int16_t>(unique ? winner : -1);
    rows_.fraction[static_cast<std::size_t>(u)] = static_cast<std::int16_t>(sub_pixel(sums, winner));
    return unique ? std::int16_t{0} : std::int16_t{kNotUnique};
  }

  bool inside(int u) const {
    const int right = u - range_.first;  // of candidate 0
    return right < range_.valid_end && right - (range_.disparities - 1) >= range_.valid_begin;
  }

  // Winners of the right pixels [begin, begin + Lanes(d)).
  template <class D>
  void select_right(D d, int begin) const {
    const int lanes = static_cast<int>(hn::Lanes(d));
    const int n = range_.disparities;
    // Lane k is right pixel begin + lanes - 1 - k: so its candidates of one left pixel lie side by side.
    const int candidate0 = begin + lanes - 1 + range_.first;  // u - candidate of lane 0
    const int first = std::max(begin + range_.first, range_.valid_begin);
    const int last = std::min(candidate0 + n - 1, range_.valid_end - 1);
    auto best = hn::Set(d, kSumPadding);
    auto winner = hn::Zero(d);
    auto candidate = hn::Iota(d, static_cast<std::int16_t>(first - candidate0));
    const auto one = hn::Set(d, std::int16_t{1});
    const int stride = sum_stride(n, lanes);
    const int slots = sum_slots(n);
    for (int u = first; u <= last;) {
      // As far as the ring goes on.
      const int slot = (u - range_.valid_begin) % slots;
      const int run = std::min(last + 1 - u, slots - slot);
      const std::int16_t* sums = rows_.slot(n, slot) + (u - candidate0);
      for (int k = 0; k < run; ++k, sums += stride + 1) {
        const auto s = hn::LoadU(d, sums);
        // Candidates come in ascending order: the largest one that was better when it came.
        winner = hn::Max(winner, hn::IfThenElseZero(hn::Lt(s, best), candidate));
        best = hn::Min(best, s);
        candidate = hn::Add(candidate, one);
      }
      u += run;
    }
    hn::StoreU(hn::Reverse(d, winner), d, &rows_.right_of(begin));
  }

  // When the whole row has been through the two above.
  void finish(std::span<std::int16_t> disparity) const {
    if (p_.left_right_max < 0) return finish_row<false>(disparity.data());
    // The right pixels just outside agree with nobody.
    rows_.right_of(range_.valid_begin - 1) = kNoRightWinner;
    rows_.right_of(range_.valid_end) = kNoRightWinner;
    finish_row<true>(disparity.data());
  }

 private:
  std::uint32_t divisor() const { return static_cast<std::uint32_t>(100 - p_.uniqueness_percent); }

  // The largest S with S (100 - uniqueness) < 100 least, biased. Exact: the dividend is below 2^23, the divisor at most
  // 100, their product below 2^32.
  std::int16_t limit(int least) const {
    const auto dividend = static_cast<std::uint64_t>(100 * least - 1);
    const auto quotient = static_cast<int>((dividend * reciprocal_) >> 32);
    return static_cast<std::int16_t>(std::min(quotient, 65534) - kSumBias);
  }

  // As in the header; of a winner the numerator is at most the denominator, and adding 16 to the quotient makes it an
  // unsigned division. (The padding is there for the ends of the range.)
  int sub_pixel(const std::int16_t* sums, int best) const {
    const std::int32_t before = sums[best - 1];
    const std::int32_t after = sums[best + 1];
    const std::int32_t denominator = std::max(before + after - 2 * sums[best], 1);
    const std::int32_t dividend = kDisparityScale * (before - after) + denominator + 32 * denominator;
    const auto shifted = static_cast<std::uint32_t>(dividend) / static_cast<std::uint32_t>(2 * denominator);
    const bool at_the_end = best == 0 || best == range_.disparities - 1;
    return at_the_end ? 0 : static_cast<int>(shifted) - 16;
  }

  template <bool kLeftRight>
  void finish_row(std::int16_t* HWY_RESTRICT disparity) const {
    const std::int16_t* best_of = rows_.best.data();
    const std::int16_t* fraction_of = rows_.fraction.data();
    const std::int16_t* right = &rows_.right_of(0);
    const int first = range_.first;
    const int offset16 = p_.offset16;
    const int most = std::min(p_.left_right_max, kMaxDisparities);
    const int end = range_.valid_end;
    for (int u = range_.valid_begin; u < end; ++u) {
      const int best = best_of[u];
      if (best < 0) continue;
      const int fraction = fraction_of[u];
      // The right pixels of the disparity rounded down and up: the winner's, and with a fraction one beside it.
      const std::int16_t* here = right + (u - first - best);
      const std::int16_t* beside = here - ((fraction > 0 ? 1 : 0) - (fraction < 0 ? 1 : 0));
      const bool agree = !kLeftRight || std::min(std::abs(best - *here), std::abs(best - *beside)) <= most;
      const int d = kDisparityScale * (first + best) + fraction + offset16;
      disparity[u] = agree ? static_cast<std::int16_t>(d) : std::int16_t{kLeftRightFailed};
    }
  }

  SearchRange range_;
  SelectParams p_;
  SelectRows rows_;
  std::uint64_t reciprocal_;
};

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();
#endif

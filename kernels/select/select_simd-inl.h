// Selection (kernels/select) while the window sums of a row are being made: a ring of the last pixels' sums, disparity
// contiguous, one vector of candidates after the other.
//
// Sums are stored as int16, the uint16 sum minus 32768, because x86 compares signed lanes only. Before and after the
// candidates of a pixel lies kSumPadding, which never wins. Where they are small enough, the sums are multiplied by
// kOrdinals, and a pixel's place among kOrdinals neighbours is added: of the sums of so many left pixels for one right pixel,
// the least then says which pixel's it is.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

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
// Sums that are kept of a pixel, from the one before the first near candidate on; five are looked at.
inline constexpr int kNearSums = 8;

inline constexpr int kOrdinalBits = 3;
inline constexpr int kOrdinals = 1 << kOrdinalBits;

// From one pixel's candidate 0 to the next one's: the padding after one is that before the other. At least a vector and
// kOrdinals - 1 elements.
constexpr int sum_stride(int disparities, int lanes) {
  return disparities + 2 * lanes;
}

// Right pixels are searched a vector at a time, once the last left pixel that can match one of them is there. Whole steps,
// so that the pixels of one lie side by side.
constexpr int sum_slots(int disparities) {
  return (disparities + kMaxSumLanes + kOrdinals + 2 * kPixelsPerStep - 1) / kPixelsPerStep * kPixelsPerStep;
}

// Of one row. What belongs to pixels has room for a vector behind the last.
struct SelectRows {
  int lanes = kMaxSumLanes;
  std::span<std::int16_t> sums;  // 2 lanes + sum_slots x sum_stride
  std::span<std::int16_t>
      first;  // first candidate whose sum is near to a left pixel's least; negative: none to be found
  std::span<std::int16_t> last;   // and the last
  std::span<std::int16_t> near;   // kNearSums of every left pixel
  std::span<std::int16_t> right;  // winner of a right pixel

  std::int16_t* right_of(int u) const { return right.data() + u + 1; }
  // Candidate 0 of slot `index`; pixel u has slot (u - valid_begin) mod sum_slots.
  std::int16_t* slot(int disparities, int index) const {
    return sums.data() + 2 * lanes + static_cast<std::ptrdiff_t>(index) * sum_stride(disparities, lanes);
  }
};

}  // namespace lakshya
#endif

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The least of a vector's (biased) sums, without the bias.
#if HWY_ARCH_X86
HWY_INLINE int least_sum(hn::Simd<std::int16_t, 8, 0> d, hn::Vec<hn::Simd<std::int16_t, 8, 0>> v) {
  const auto sums = hn::Xor(v, hn::Set(d, std::int16_t{-kSumBias}));
  return static_cast<std::uint16_t>(_mm_cvtsi128_si32(_mm_minpos_epu16(sums.raw)));
}
template <class D>
HWY_INLINE int least_sum(D /*d*/, hn::Vec<D> v) {
  const hn::Half<D> half;
  return least_sum(half, hn::Min(hn::LowerHalf(half, v), hn::UpperHalf(half, v)));
}
#else
template <class D>
HWY_INLINE int least_sum(D /*d*/, hn::Vec<D> v) {
  const hn::RebindToUnsigned<D> du;
  // There is no least of signed lanes on every instruction set.
  const auto sums = hn::Xor(hn::BitCast(du, v), hn::Set(du, std::uint16_t{kSumBias}));
  return static_cast<int>(hn::GetLane(hn::MinOfLanes(du, sums)));
}
#endif

// One bit per lane of two masks.
template <class D, class M>
HWY_INLINE std::uint64_t bits_of_two(D d, M low, M high) {
  const int lanes = static_cast<int>(hn::Lanes(d));
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  return std::uint64_t{low.raw} | std::uint64_t{high.raw} << lanes;
#else
  std::uint64_t bits[2] = {};
  hn::StoreMaskBits(d, low, reinterpret_cast<std::uint8_t*>(&bits[0]));
  hn::StoreMaskBits(d, high, reinterpret_cast<std::uint8_t*>(&bits[1]));
  return bits[0] | bits[1] << lanes;
#endif
}
#if HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_AVX2
template <class M>
HWY_INLINE std::uint64_t bits_of_two(hn::Simd<std::int16_t, 8, 0> /*d*/, M low, M high) {
  return static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(low.raw, high.raw)));
}
#endif
#if HWY_TARGET == HWY_AVX2
template <class M>
HWY_INLINE std::uint64_t bits_of_two(hn::Simd<std::int16_t, 16, 0> /*d*/, M low, M high) {
  // Packing works in halves of the vectors.
  const __m256i bytes = _mm256_permute4x64_epi64(_mm256_packs_epi16(low.raw, high.raw), 0xD8);
  return static_cast<unsigned>(_mm256_movemask_epi8(bytes));
}
#endif

// Bit k: candidate k of `count` (at most 64, a constant after inlining) is below the limit.
template <class D>
HWY_INLINE std::uint64_t bits_below(D d, const std::int16_t* sums, int count, hn::Vec<D> limit) {
  const int lanes = static_cast<int>(hn::Lanes(d));
  std::uint64_t bits = 0;
  for (int i = 0; i < count; i += 2 * lanes) {
    const auto low = hn::Gt(limit, hn::LoadU(d, sums + i));
    const auto high = hn::Gt(limit, hn::LoadU(d, sums + i + lanes));
    bits |= bits_of_two(d, low, high) << i;
  }
  return bits;
}

// First and last candidate whose sum is below the limit; there is one.
struct Candidates {
  int first;
  int last;
};

template <class D>
HWY_INLINE Candidates below(D d, const std::int16_t* sums, int disparities, hn::Vec<D> limit) {
  const auto lowest = [](std::uint64_t bits) { return static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits)); };
  const auto highest = [](std::uint64_t bits) {
    return 63 - static_cast<int>(hwy::Num0BitsAboveMS1Bit_Nonzero64(bits));
  };
  if (disparities == 64) {
    const std::uint64_t bits = bits_below(d, sums, 64, limit);
    return {lowest(bits), highest(bits)};
  }
  Candidates found{-1, 0};
  for (int word = 0; word < disparities; word += 64) {
    const int rest = disparities - word;
    const std::uint64_t bits =
        rest >= 64 ? bits_below(d, sums + word, 64, limit) : bits_below(d, sums + word, rest, limit);
    if (bits == 0) continue;
    if (found.first < 0) found.first = word + lowest(bits);
    found.last = word + highest(bits);
  }
  return found;
}

// kDisparities: their number, if it is a usual one, for loops of a constant length; or 0. kBits: kOrdinalBits, or 0 where
// the sums do not leave room for them.
template <class D, int kDisparities, int kBits>
class Selection {
 public:
  Selection(const SearchRange& range, const SelectParams& params, const SelectRows& rows)
      : range_(range), p_(params), rows_(rows) {}

  // The near candidates of left pixels [begin, end) of one step; `sums` of the first, `smallest`: the
  // smallest sum of each, kPixelsPerStep of them.
  void select_left(int begin, int end, const std::int16_t* sums, std::int32_t* smallest) const {
    // Those whose candidates are all in the right image lie together.
    const int inside_begin = std::clamp(range_.valid_begin + range_.first + range_.disparities - 1, begin, end);
    const int inside_end = std::clamp(range_.valid_end + range_.first, inside_begin, end);
    const std::ptrdiff_t stride = sum_stride(range_.disparities, rows_.lanes);
    alignas(64) std::int32_t limits[kPixelsPerStep];
    set_limits(end - begin, smallest, limits);
    select_run<false>(begin, inside_begin, sums, smallest, limits);
    int done = inside_begin - begin;
    select_run<true>(inside_begin, inside_end, sums + done * stride, smallest + done, limits + done);
    done = inside_end - begin;
    select_run<false>(inside_end, end, sums + done * stride, smallest + done, limits + done);
  }

  // Winners of the right pixels [begin, begin + Lanes(d)).
  void select_right(int begin) const {
    constexpr int kGroup = 1 << kBits;
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const int n = disparities();
    const std::ptrdiff_t step = sum_stride(n, lanes) + 1;
    const int slots = sum_slots(n);
    // Lane k is right pixel begin + lanes - 1 - k: so its candidates of one left pixel lie side by side. Left pixels are
    // counted from the first valid one.
    const int candidate0 = begin + lanes - 1 + range_.first - range_.valid_begin;  // pixel - candidate of lane 0
    const int first = std::max(begin + range_.first - range_.valid_begin, 0) / kGroup * kGroup;
    const int end = std::min(candidate0 + n, range_.valid_end - range_.valid_begin);
    auto best = hn::Set(d, kSumPadding);
    auto winner = hn::Zero(d);
    // A group may begin before the first candidate; winners are counted from where none begins.
    constexpr int kBefore = kMaxSumLanes + kOrdinals;
    auto candidate = hn::Set(d, static_cast<std::int16_t>(first - candidate0 + kBefore));
    const auto next = hn::Set(d, std::int16_t{kGroup});
    for (int u = first; u < end;) {
      // As far as the ring goes on. Pixels of a group that cannot match find padding.
      const int slot = u % slots;
      const int stop = std::min(end, u + slots - slot);
      const std::int16_t* sums = rows_.slot(n, slot) + (u - candidate0);
      for (; u < stop; u += kGroup, sums += kGroup * step) {
        auto s = hn::LoadU(d, sums);
        if (kBits == 3) {
          const auto s01 = hn::Min(s, hn::LoadU(d, sums + step));
          const auto s23 = hn::Min(hn::LoadU(d, sums + 2 * step), hn::LoadU(d, sums + 3 * step));
          const auto s45 = hn::Min(hn::LoadU(d, sums + 4 * step), hn::LoadU(d, sums + 5 * step));
          const auto s67 = hn::Min(hn::LoadU(d, sums + 6 * step), hn::LoadU(d, sums + 7 * step));
          s = hn::Min(hn::Min(s01, s23), hn::Min(s45, s67));
        }
        auto of_group = candidate;
        if (kBits != 0) {
          const auto ordinal = hn::And(s, hn::Set(d, std::int16_t{kGroup - 1}));
          of_group = hn::Add(of_group, ordinal);
          s = hn::Sub(s, ordinal);
        }
        // Candidates come in ascending order: the largest one that was better when it came.
        winner = hn::Max(winner, hn::IfThenElseZero(hn::Lt(s, best), of_group));
        best = hn::Min(best, s);
        candidate = hn::Add(candidate, next);
      }
    }
    winner = hn::Add(winner, hn::Sub(hn::Iota(d, 0), hn::Set(d, std::int16_t{kBefore})));
    hn::StoreU(hn::Reverse(d, winner), d, rows_.right_of(begin));
  }

 private:
  int disparities() const { return kDisparities != 0 ? kDisparities : range_.disparities; }

  // The limits below which a sum is near to the smallest of its pixel: one more than the largest S with
  // S (100 - uniqueness) < 100 smallest, or than the smallest itself. Both as the sums are stored, with the largest ordinal,
  // in both halves of 32 bits.
  void set_limits(int count, std::int32_t* smallest, std::int32_t* limits) const {
    const hn::CappedTag<std::int32_t, kPixelsPerStep> d32;
    const hn::RebindToFloat<decltype(d32)> df;
    const auto share = hn::Set(df, static_cast<float>(100 - p_.uniqueness_percent));
    const auto bias = hn::Set(d32, kSumBias);
    const auto low_half = hn::Set(d32, 0xFFFF);
    for (int k = 0; k < count; k += static_cast<int>(hn::Lanes(d32))) {
      const auto sum = hn::ShiftRight<kBits>(hn::LoadU(d32, smallest + k));
      // Below 2^23, so a float is exact; a quotient up to 65536 differs from the next whole number by 1/100 at least, its
      // rounding by 1/512 at most.
      const auto dividend = hn::Sub(hn::Mul(sum, hn::Set(d32, 100)), hn::Set(d32, 1));
      const auto quotient = hn::ConvertTo(d32, hn::Div(hn::ConvertTo(df, dividend), share));
      const auto limit = hn::Max(hn::Min(quotient, hn::Set(d32, 65534)), sum);
      const auto twice = [&](auto v) HWY_ATTR {
        const auto with_ordinal = hn::Or(hn::ShiftLeft<kBits>(v), hn::Set(d32, (1 << kBits) - 1));
        const auto below_padding = hn::Min(with_ordinal, hn::Set(d32, 65534));
        const auto biased = hn::And(hn::Xor(hn::Add(below_padding, hn::Set(d32, 1)), bias), low_half);
        return hn::Or(biased, hn::ShiftLeft<16>(biased));
      };
      hn::StoreU(twice(limit), d32, limits + k);
      hn::StoreU(twice(sum), d32, smallest + k);
    }
  }

  // kInside: every candidate of the pixels is in the right image.
  template <bool kInside>
  HWY_INLINE void select_run(int begin, int end, const std::int16_t* sums, const std::int32_t* smallest,
                             const std::int32_t* limits) const {
    const D d;
    const hn::Repartition<std::int32_t, D> d32;
    const hn::FixedTag<std::int16_t, kNearSums> near_d;
    const int disparities = this->disparities();
    const std::ptrdiff_t stride = sum_stride(disparities, static_cast<int>(hn::Lanes(d)));
    const SearchRange range = range_;
    std::int16_t* HWY_RESTRICT first = rows_.first.data();
    std::int16_t* HWY_RESTRICT last = rows_.last.data();
    std::int16_t* HWY_RESTRICT near_sums = rows_.near.data() + kNearSums * static_cast<std::ptrdiff_t>(begin);
    for (int u = begin; u < end; ++u, sums += stride, near_sums += kNearSums) {
      const Candidates near = below(d, sums, disparities, hn::BitCast(d, hn::Set(d32, *limits++)));
      int found = near.first;
      if (!kInside) {
        const int winner = below(d, sums, disparities, hn::BitCast(d, hn::Set(d32, *smallest++))).first;
        const int column = u - range.first - winner;
        if (column < range.valid_begin || column >= range.valid_end) found = -1;
      }
      first[u] = static_cast<std::int16_t>(found);
      last[u] = static_cast<std::int16_t>(near.last);
      hn::StoreU(hn::LoadU(near_d, sums + (near.first - 1)), near_d, near_sums);
    }
  }

  SearchRange range_;
  SelectParams p_;
  SelectRows rows_;
};

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();
#endif

// The second pass over a row: from left to right the other paths, S, and each pixel's winner.
#if defined(LAKSHYA_SGM_SUMS_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LAKSHYA_SGM_SUMS_SIMD_INL
#undef LAKSHYA_SGM_SUMS_SIMD_INL
#else
#define LAKSHYA_SGM_SUMS_SIMD_INL
#endif

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "kernels/sgm/sgm_paths_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {

// Sums below this limit are too near to a least sum of `s`; 255 stands for everything from there on. In all four bytes of
// a word, which spreads over a vector by a load alone.
inline void unique_limits(int uniqueness_percent, std::uint32_t (&limit)[256]) {
  const int share = 100 - uniqueness_percent;
  for (int s = 0; s < 256; ++s)
    limit[s] = 0x01010101U * static_cast<std::uint32_t>(std::min((100 * s + share - 1) / share, 255));
}

// The least sum from which on every other candidate is too near, those of 255 too.
inline int unique_no_more(int uniqueness_percent) {
  const int share = 100 - uniqueness_percent;
  return 255 * share / 100 + 1;
}

// Bits best - 1 to best + 1 cleared, of 64.
struct NotNear {
  constexpr NotNear() {
    for (int best = 0; best < 64; ++best) {
      bits[best] = ~std::uint64_t{0};
      for (int i = std::max(best - 1, 0); i <= std::min(best + 1, 63); ++i)
        bits[best] &= ~(std::uint64_t{1} << i);
    }
  }
  std::uint64_t bits[64] = {};
};
inline constexpr NotNear kNotNear;

// One bit per candidate, in words of 64.
template <std::size_t kVectors>
class CandidateBits {
 public:
  explicit HWY_INLINE CandidateBits(std::size_t vectors) {
    for (std::size_t w = 0; w <= words(vectors); ++w)
      bits_[w] = 0;
  }
  HWY_INLINE void set(std::size_t k, std::uint64_t bits) {
    const std::size_t at = k * hn::Lanes(Bytes());
    bits_[at / 64] |= bits << (at % 64);
  }
  HWY_INLINE int first(std::size_t vectors) const {
    if constexpr (in_one_word()) return std::countr_zero(bits_[0]);
    std::size_t w = 0;
    while (bits_[w] == 0 && w + 1 < words(vectors))
      ++w;
    return static_cast<int>(64 * w) + std::countr_zero(bits_[w]);
  }
  // The bits that are not set, less those of candidate `best` and next to it; of all words together.
  HWY_INLINE std::uint64_t missing(std::size_t vectors, int best) {
    const std::size_t n = vectors * hn::Lanes(Bytes());
    if (n % 64 != 0) bits_[n / 64] |= ~std::uint64_t{0} << (n % 64);
    if constexpr (in_one_word()) return ~bits_[0] & kNotNear.bits[best];
    for (int i = std::max(best - 1, 0); i <= best + 1; ++i)
      bits_[i / 64] |= std::uint64_t{1} << (i % 64);
    std::uint64_t all = 0;
    for (std::size_t w = 0; w < words(vectors); ++w)
      all |= ~bits_[w];
    return all;
  }

 private:
  static constexpr bool in_one_word() {
#if HWY_ARCH_ARM && HWY_TARGET != HWY_NEON
    return false;  // the length of a vector is not known
#else
    return kVectors > 0 && kVectors * hn::MaxLanes(Bytes()) <= 64;
#endif
  }
  static HWY_INLINE std::size_t words(std::size_t vectors) {
    return in_one_word() ? 1 : (vectors * hn::Lanes(Bytes()) + 63) / 64;
  }

  std::uint64_t bits_[kMaxDisparities / 64 + 1];  // one more, for the candidate after the last
};

// The path from above, of one pixel: L of this row is added to the sums. What is kept of a row is L less its least, so
// that where a path starts it is 0. `above` and `current` may be the same.
template <std::size_t kVectors>
HWY_INLINE void top_path(std::size_t vectors, const PixelVecs<kVectors>& cost, ByteVec p1, ByteVec p2,
                         const std::uint8_t* above, std::uint8_t* current, PixelVecs<kVectors>& sum) {
  const Bytes d;
  const std::size_t lanes = hn::Lanes(d);
  const auto outside = hn::Set(d, 255);
  PixelVecs<kVectors> path;
  auto lowest = outside;
#pragma GCC unroll 4
  for (std::size_t k = 0; k < vectors; ++k) {
    const std::uint8_t* here = above + k * lanes;
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
    // A load of 64 bytes beside the alignment is two.
    const auto stay = hn::Load(d, here);
    const auto below = moved_up(d, stay, k > 0 ? hn::Load(d, here - lanes) : outside);
    const auto beyond = moved_down(d, stay, k + 1 < vectors ? hn::Load(d, here + lanes) : outside);
#else
    const auto stay = hn::Load(d, here);
    const auto below = hn::LoadU(d, here - 1);
    const auto beyond = hn::LoadU(d, here + 1);
#endif
    const auto move = hn::SaturatedAdd(hn::Min(below, beyond), p1);
    path.set(k, hn::SaturatedAdd(cost.get(k), hn::Min(hn::Min(stay, p2), move)));
    lowest = hn::Min(lowest, path.get(k));
    sum.set(k, hn::SaturatedAdd(sum.get(k), path.get(k)));
  }
  const auto floor = in_every_byte(d, least(d, lowest));
#pragma GCC unroll 4
  for (std::size_t k = 0; k < vectors; ++k)
    hn::Store(hn::Sub(path.get(k), floor), d, current + k * lanes);
}

// The other paths, S, and for a wanted row each pixel's winner with what decides about it: of the pixels [begin, end),
// where the path from the left has reached `state`.
template <std::size_t kVectors, bool kDiagonal>
void sums_and_winners(const RowShape& row_shape, const SgmSimdRows& r, int p1_number,
                      const std::uint32_t* unique_limit, bool wanted, int begin, int end,
                      SidePath<kVectors>& state) {
  constexpr std::size_t kPaths = kDiagonal ? 3 : 1;
  constexpr int kShift[kMaxTopPaths] = {0, -1, 1};
  const Bytes d;
  const RowShape shape = row_shape;
  const SgmSimdRows rows = r;
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t vectors = kVectors > 0 ? kVectors : shape.vectors;
  const auto p1 = hn::Set(d, static_cast<std::uint8_t>(p1_number));
  const std::uint8_t* costs = rows.hamming[0].data() + shape.pitch;  // C of a pixel lies one further
  const std::uint8_t* side_penalty = rows.side_penalty.data();
  std::int32_t* winner = rows.winner.data();
  std::uint32_t* winner_sums = rows.winner_sums.data();
  std::uint64_t* all_rivals = rows.rivals.data();
  SidePath<kVectors> path = state;
  PixelVecs<kVectors> sum;
  for (int u = begin; u < end; ++u) {
    const std::size_t at = shape.at(u);
    const std::size_t spaced_at = shape.spaced_at(u);
    std::uint8_t* sums = rows.sums.data() + spaced_at;
    PixelVecs<kVectors> cost;
#pragma GCC unroll 4
    for (std::size_t k = 0; k < vectors; ++k)
      cost.set(k, hn::Load(d, costs + at + k * lanes));
    path.step(vectors, p1, side_penalty[u], cost);
#pragma GCC unroll 4
    for (std::size_t k = 0; k < vectors; ++k)
      sum.set(k, hn::SaturatedAdd(path.get(k), hn::Load(d, sums + k * lanes)));

    for (std::size_t t = 0; t < kPaths; ++t) {
      const auto p2 = hn::Set(d, rows.top_penalty[t].data()[u]);
      top_path<kVectors>(vectors, cost, p1, p2, rows.above[t].data() + shape.spaced_at(u + kShift[t]),
                         rows.current[t].data() + spaced_at, sum);
    }
    if (!wanted) continue;

    auto lowest = sum.get(0);
    hn::Store(lowest, d, sums);
#pragma GCC unroll 4
    for (std::size_t k = 1; k < vectors; ++k) {
      hn::Store(sum.get(k), d, sums + k * lanes);
      lowest = hn::Min(lowest, sum.get(k));
    }
    const auto found = least(d, lowest);
    lowest = in_every_byte(d, found);
    const auto limit =
        hn::BitCast(d, hn::Set(hn::Repartition<std::uint32_t, Bytes>(), unique_limit[number(found)]));
    CandidateBits<kVectors> equal(vectors);
    CandidateBits<kVectors> unlike(vectors);
#pragma GCC unroll 4
    for (std::size_t k = 0; k < vectors; ++k) {
      equal.set(k, mask_bits(d, hn::Eq(sum.get(k), lowest)));
      // Nothing is left of the limit: not below it.
      unlike.set(k, mask_bits(d, hn::Eq(hn::SaturatedSub(limit, sum.get(k)), hn::Zero(d))));
    }
    const int best = equal.first(vectors);
    winner[u] = best;
    std::memcpy(winner_sums + u, sums + best - 1, sizeof *winner_sums);
    all_rivals[u] = unlike.missing(vectors, best);
  }
  state = path;
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

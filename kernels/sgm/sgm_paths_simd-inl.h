// The two passes over a row: from right to left the costs and the path from the right, then from left to right the
// other paths, their sum, and each pixel's winner.
//
// Everything that an inner loop needs is a local: a byte stored through a pointer may change any member, as far as the
// compiler knows, and it would load them all again.
#if defined(LAKSHYA_SGM_PATHS_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LAKSHYA_SGM_PATHS_SIMD_INL
#undef LAKSHYA_SGM_PATHS_SIMD_INL
#else
#define LAKSHYA_SGM_PATHS_SIMD_INL
#endif

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "kernels/sgm/sgm.h"
#include "kernels/sgm/sgm_cost_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {

// max(p2 - slope |a - b|, p2_min) of `count` pixels.
inline void jump_penalties(const std::uint8_t* a, const std::uint8_t* b, int count, const SgmParams& p,
                           std::uint8_t* out) {
  const Bytes d;
  const Words d16;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto slope = hn::Set(d16, static_cast<std::uint16_t>(p.p2_slope));
  const auto largest = hn::Set(d16, 255);
  int u = 0;
  for (; u + lanes <= count; u += lanes) {
    const auto va = hn::LoadU(d, a + u);
    const auto vb = hn::LoadU(d, b + u);
    const auto steps = hn::BitCast(d16, hn::Or(hn::SaturatedSub(va, vb), hn::SaturatedSub(vb, va)));
    const auto even = hn::Min(hn::Mul(hn::And(steps, largest), slope), largest);
    const auto odd = hn::Min(hn::Mul(hn::ShiftRight<8>(steps), slope), largest);
    const auto fall = hn::BitCast(d, hn::Or(even, hn::ShiftLeft<8>(odd)));
    const auto penalty = hn::Max(hn::SaturatedSub(hn::Set(d, static_cast<std::uint8_t>(p.p2)), fall),
                                 hn::Set(d, static_cast<std::uint8_t>(p.p2_min)));
    hn::StoreU(penalty, d, out + u);
  }
  for (; u < count; ++u) {
    const int step = a[u] > b[u] ? a[u] - b[u] : b[u] - a[u];
    out[u] = static_cast<std::uint8_t>(std::max(p.p2 - p.p2_slope * step, p.p2_min));
  }
}

// One path's step to a pixel: L from the costs and L of the pixel before, whose least is `floor`; jump: floor + P2.
HWY_INLINE ByteVec path_step(ByteVec cost, ByteVec stay, ByteVec below, ByteVec beyond, ByteVec p1, ByteVec jump,
                             ByteVec floor) {
  const auto move = hn::SaturatedAdd(hn::Min(below, beyond), p1);
  const auto best = hn::Min(hn::Min(stay, jump), move);
  return hn::SaturatedAdd(cost, hn::Sub(best, floor));
}

// The path along a row. L of the pixel before stays in registers.
template <std::size_t kVectors>
class SidePath {
 public:
  explicit HWY_INLINE SidePath(std::size_t vectors) {
    floor_.set(0, hn::Zero(Bytes()));
    for (std::size_t k = 0; k < vectors; ++k)
      path_.set(k, hn::Zero(Bytes()));  // a path starts with L = C
  }
  // From L of one pixel to L of the next, whose C is `cost`.
  HWY_INLINE void step(std::size_t vectors, ByteVec p1, std::uint8_t p2, const PixelVecs<kVectors>& cost) {
    const Bytes d;
    const auto outside = hn::Set(d, 255);
    const auto floor = floor_.get(0);
    const auto jump = hn::SaturatedAdd(floor, hn::Set(d, p2));
    auto before = outside;
    auto lowest = outside;
#pragma GCC unroll 4
    for (std::size_t k = 0; k < vectors; ++k) {
      const auto here = path_.get(k);
      const auto after = k + 1 < vectors ? path_.get(k + 1) : outside;
      const auto path =
          path_step(cost.get(k), here, moved_up(d, here, before), moved_down(d, here, after), p1, jump, floor);
      path_.set(k, path);
      lowest = hn::Min(lowest, path);
      before = here;
    }
    floor_.set(0, least(d, lowest));
  }
  HWY_INLINE ByteVec get(std::size_t k) const {
    return path_.get(k);
  }

 private:
  PixelVecs<kVectors> path_;
  PixelVecs<1> floor_;  // the least L, in every byte
};

// What the passes need of a row. Every row has a pixel of margin on the left, and one on the right.
struct RowShape {
  int begin = 0;  // columns with descriptors
  int end = 0;
  std::size_t pitch = 0;
  std::size_t vectors = 0;
  std::size_t at(int u) const { return static_cast<std::size_t>(u + 1) * pitch; }
};

// Hamming distances of every pixel of a row.
template <std::size_t kVectors>
void hamming_distances(const HammingRow& distances, const RowShape& shape, std::uint8_t* out) {
  const HammingRow row = distances;
  const std::size_t vectors = kVectors > 0 ? kVectors : shape.vectors;
  for (int u = shape.begin; u < shape.end; ++u)
    row.store(u, vectors, out + shape.at(u));
}

// C and L of the path from the right. `below` is filled on the way when kCompute, else it is there already.
template <std::size_t kVectors, bool kCompute>
void costs_and_leftward_path(const HammingRow& distances, const RowShape& row_shape, const SgmSimdRows& rows,
                             const SgmParams& params, const std::uint8_t* above, const std::uint8_t* here,
                             std::uint8_t* below) {
  const Bytes d;
  const HammingRow hamming = distances;
  const RowShape shape = row_shape;
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t vectors = kVectors > 0 ? kVectors : shape.vectors;
  const auto p1 = hn::Set(d, static_cast<std::uint8_t>(params.p1));
  const std::uint8_t* penalties = rows.side_penalty.data();
  const std::uint8_t* beyond = rows.beyond.data();
  std::uint8_t* costs = rows.cost.data();
  std::uint8_t* paths = rows.sideways.data();
  // Three rows of distances added up: of the pixel right of the one that gets its cost, of itself, and the one left.
  PixelVecs<kVectors> right;
  PixelVecs<kVectors> middle;
  PixelVecs<kVectors> left;
  SidePath<kVectors> path(vectors);
  // The last column stands in for the one right of it, and the first for the one left of it.
  for (int u = shape.end - 1; u >= shape.begin - 1; --u) {
    if (HWY_LIKELY(u >= shape.begin)) {
      const std::size_t at = shape.at(u);
      if constexpr (kCompute) hamming.store(u, vectors, below + at);
#pragma GCC unroll 4
      for (std::size_t k = 0; k < vectors; ++k) {
        const std::size_t i = at + k * lanes;
        left.set(k, hn::Add(hn::Add(hn::Load(d, above + i), hn::Load(d, below + i)), hn::Load(d, here + i)));
      }
    }
    if (HWY_UNLIKELY(u == shape.end - 1)) {
      for (std::size_t k = 0; k < vectors; ++k)
        right.set(k, left.get(k));
    } else {
      const std::size_t at = shape.at(u + 1);
      PixelVecs<kVectors> cost;
#pragma GCC unroll 4
      for (std::size_t k = 0; k < vectors; ++k) {
        cost.set(k, hn::AverageRound(hn::Add(left.get(k), middle.get(k)), right.get(k)));
        if constexpr (kVectors == 0) cost.set(k, hn::Or(cost.get(k), hn::Load(d, beyond + k * lanes)));
        hn::Store(cost.get(k), d, costs + at + k * lanes);
        right.set(k, middle.get(k));
      }
      path.step(vectors, p1, penalties[u + 2], cost);
#pragma GCC unroll 4
      for (std::size_t k = 0; k < vectors; ++k)
        hn::Store(path.get(k), d, paths + at + k * lanes);
    }
#pragma GCC unroll 4
    for (std::size_t k = 0; k < vectors; ++k)
      middle.set(k, left.get(k));
  }
}

// The other paths, S, and for a wanted row each pixel's winner with what decides about it.
template <std::size_t kVectors, bool kDiagonal>
void sums_and_winners(const RowShape& row_shape, const SgmSimdRows& r, const SgmParams& params,
                      const std::uint16_t* unique_limit, bool wanted) {
  constexpr std::size_t kPaths = kDiagonal ? 3 : 1;
  constexpr int kShift[kMaxTopPaths] = {0, -1, 1};
  const Bytes d;
  const RowShape shape = row_shape;
  const SgmSimdRows rows = r;
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t vectors = kVectors > 0 ? kVectors : shape.vectors;
  const auto p1 = hn::Set(d, static_cast<std::uint8_t>(params.p1));
  const auto outside = hn::Set(d, 255);
#if !(HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL)
  const auto first_lane = hn::VecFromMask(d, hn::FirstN(d, 1));
  const auto last_lane = hn::Not(hn::VecFromMask(d, hn::FirstN(d, lanes - 1)));
#endif
  const int last = params.range.disparities - 1;
  const std::uint8_t* costs = rows.cost.data();
  const std::uint8_t* leftward = rows.sideways.data();
  const std::uint8_t* side_penalty = rows.side_penalty.data();
  std::uint8_t* sums = rows.sums.data();
  SidePath<kVectors> path(vectors);
  PixelVecs<kVectors> sum;
  for (int u = shape.begin; u < shape.end; ++u) {
    const std::size_t at = shape.at(u);
    PixelVecs<kVectors> cost;
#pragma GCC unroll 4
    for (std::size_t k = 0; k < vectors; ++k)
      cost.set(k, hn::Load(d, costs + at + k * lanes));
    path.step(vectors, p1, side_penalty[u], cost);
#pragma GCC unroll 4
    for (std::size_t k = 0; k < vectors; ++k)
      sum.set(k, hn::SaturatedAdd(path.get(k), hn::Load(d, leftward + at + k * lanes)));

    for (std::size_t t = 0; t < kPaths; ++t) {
      const std::uint8_t* above = rows.above[t].data() + shape.at(u + kShift[t]);
      std::uint8_t* current = rows.current[t].data() + at;
      const auto floor = hn::Set(d, rows.above_least[t].data()[u + 1 + kShift[t]]);
      const auto jump = hn::SaturatedAdd(floor, hn::Set(d, rows.top_penalty[t].data()[u]));
      auto lowest = outside;
#pragma GCC unroll 4
      for (std::size_t k = 0; k < vectors; ++k) {
        const std::size_t i = k * lanes;
        const auto here = hn::Load(d, above + i);
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
        // A load of 64 bytes beside the alignment is two.
        const auto below = moved_up(d, here, k > 0 ? hn::Load(d, above + i - lanes) : outside);
        const auto beyond = moved_down(d, here, k + 1 < vectors ? hn::Load(d, above + i + lanes) : outside);
#else
        auto below = hn::LoadU(d, above + i - 1);
        auto beyond = hn::LoadU(d, above + i + 1);
        if (k == 0) below = hn::Or(below, first_lane);
        if (k + 1 == vectors) beyond = hn::Or(beyond, last_lane);
#endif
        const auto top = path_step(cost.get(k), here, below, beyond, p1, jump, floor);
        hn::Store(top, d, current + i);
        lowest = hn::Min(lowest, top);
        sum.set(k, hn::SaturatedAdd(sum.get(k), top));
      }
      rows.current_least[t].data()[u + 1] = first_byte(least(d, lowest));
    }
    if (!wanted) continue;

    auto lowest = outside;
#pragma GCC unroll 4
    for (std::size_t k = 0; k < vectors; ++k) {
      hn::Store(sum.get(k), d, sums + at + k * lanes);
      lowest = hn::Min(lowest, sum.get(k));
    }
    lowest = least(d, lowest);
    const unsigned least_sum = first_byte(lowest);
    const unsigned limit = unique_limit[least_sum];
    const auto limits = hn::Set(d, static_cast<std::uint8_t>(std::min(limit, 255U)));
    int best = 0;
    int rivals = 0;
    for (std::size_t k = vectors; k-- > 0;) {
      const std::uint64_t equal = mask_bits(d, hn::Eq(sum.get(k), lowest));
      best = equal != 0 ? static_cast<int>(k * lanes) + std::countr_zero(equal) : best;
      // Below the limit: at most one less than it.
      rivals += std::popcount(mask_bits(d, hn::Ne(hn::SaturatedSub(limits, sum.get(k)), hn::Zero(d))));
    }
    const unsigned before = best > 0 ? sums[at + static_cast<std::size_t>(best) - 1] : 255U;
    const unsigned after = best < last ? sums[at + static_cast<std::size_t>(best) + 1] : 255U;
    rivals -=
        static_cast<int>(least_sum < limit) + static_cast<int>(before < limit) + static_cast<int>(after < limit);
    rows.winner.data()[u] = best;
    rows.winner_sum.data()[u] = static_cast<std::int32_t>(least_sum);
    rows.sum_before.data()[u] = static_cast<std::int32_t>(before);
    rows.sum_after.data()[u] = static_cast<std::int32_t>(after);
    rows.rivals.data()[u] = limit > 255 ? 1 : rivals;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

// The first of the two passes over a row: from right to left, the costs and the path from the right; and what the
// second one, in sgm_sums_simd-inl.h, shares with it.
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
    floor_ = Kept<Bytes>(hn::Zero(Bytes()));
    for (std::size_t k = 0; k < vectors; ++k)
      path_.set(k, hn::Zero(Bytes()));  // a path starts with L = C
  }
  // From L of one pixel to L of the next, whose C is `cost`.
  HWY_INLINE void step(std::size_t vectors, ByteVec p1, std::uint8_t p2, const PixelVecs<kVectors>& cost) {
    const Bytes d;
    const auto outside = hn::Set(d, 255);
    const auto floor = floor_.get();
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
    floor_ = Kept<Bytes>(in_every_byte(d, least(d, lowest)));
  }
  HWY_INLINE ByteVec get(std::size_t k) const {
    return path_.get(k);
  }

 private:
  PixelVecs<kVectors> path_;
  Kept<Bytes> floor_;  // the least L, in every byte
};

// What the passes need of a row. Every row has a pixel of margin on the left, and one on the right.
struct RowShape {
  int begin = 0;  // columns with descriptors
  int end = 0;
  std::size_t pitch = 0;   // bytes per pixel
  std::size_t spaced = 0;  // of a row with a vector of 255 behind every pixel
  std::size_t vectors = 0;
  std::size_t at(int u) const { return static_cast<std::size_t>(u + 1) * pitch; }
  std::size_t spaced_at(int u) const { return static_cast<std::size_t>(u + 1) * spaced; }
};

// Hamming distances of every pixel of a row.
template <std::size_t kVectors>
void hamming_distances(const HammingRow& hamming, const RowShape& row_shape, std::uint8_t* out) {
  const Bytes d;
  const RowShape shape = row_shape;
  const std::size_t vectors = kVectors > 0 ? kVectors : shape.vectors;
  for (int u = shape.begin; u < shape.end; ++u) {
    PixelVecs<kVectors> distances;
    hamming.template distances<false>(u, vectors, distances);
    for (std::size_t k = 0; k < vectors; ++k)
      hn::Store(distances.get(k), d, out + shape.at(u) + k * hn::Lanes(d));
  }
}

// The three rows of distances about a row. The first becomes their sum, and then C: that of pixel u at the place of u + 1.
struct ThreeRows {
  std::uint8_t* above = nullptr;
  const std::uint8_t* here = nullptr;
  std::uint8_t* below = nullptr;
};

// What is known of the distances of the row below when their pixel's turn comes.
enum class Below { calculated, partly_outside, inside };

// Adds up the three rows' distances of pixel u, after filling in those below.
template <Below kBelow, std::size_t kVectors>
HWY_INLINE void add_three_rows(const HammingRow& hamming, const ThreeRows& rows, int u, std::size_t vectors,
                               std::size_t at) {
  const Bytes d;
  const std::size_t lanes = hn::Lanes(d);
  PixelVecs<kVectors> below;
  if constexpr (kBelow != Below::calculated) {
    hamming.template distances<kBelow == Below::inside>(u, vectors, below);
  }
#pragma GCC unroll 4
  for (std::size_t k = 0; k < vectors; ++k) {
    const std::size_t i = at + k * lanes;
    if constexpr (kBelow == Below::calculated) {
      below.set(k, hn::Load(d, rows.below + i));
    } else {
      hn::Store(below.get(k), d, rows.below + i);
    }
    const auto sum = hn::Add(hn::Add(below.get(k), hn::Load(d, rows.above + i)), hn::Load(d, rows.here + i));
    hn::Store(sum, d, rows.above + i);
  }
}

// C and L of the path from the right, of the pixels from first down to last; what they need of the pixel before each is
// filled in on the way.
template <Below kBelow, std::size_t kVectors>
void costs_and_path(const HammingRow& row_hamming, const RowShape& row_shape, const SgmSimdRows& rows,
                    const ThreeRows& three_rows, int p1_number, int first, int last, SidePath<kVectors>& state) {
  if (first < last) return;
  const Bytes d;
  const HammingRow hamming = row_hamming;
  const RowShape shape = row_shape;
  const ThreeRows three = three_rows;
  SidePath<kVectors> path = state;
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t vectors = kVectors > 0 ? kVectors : shape.vectors;
  const std::size_t pitch = vectors * lanes;
  const auto p1 = hn::Set(d, static_cast<std::uint8_t>(p1_number));
  const std::uint8_t* penalties = rows.side_penalty.data();
  const std::uint8_t* beyond = rows.beyond.data();
  std::uint8_t* paths = rows.sums.data();
  for (int u = first; u >= last; --u) {
    const std::size_t at = static_cast<std::size_t>(u + 1) * pitch;
    if (u > shape.begin) add_three_rows<kBelow, kVectors>(hamming, three, u - 1, vectors, at - pitch);
    std::uint8_t* right = three.above + at + pitch;
    PixelVecs<kVectors> cost;
#pragma GCC unroll 4
    for (std::size_t k = 0; k < vectors; ++k) {
      std::uint8_t* r = right + k * lanes;
      const auto others = hn::Add(hn::Load(d, r - pitch), hn::Load(d, r - 2 * pitch));
      cost.set(k, hn::AverageRound(others, hn::Load(d, r)));
      if constexpr (kVectors == 0) cost.set(k, hn::Or(cost.get(k), hn::Load(d, beyond + k * lanes)));
      hn::Store(cost.get(k), d, r);
    }
    path.step(vectors, p1, penalties[u + 1], cost);
    std::uint8_t* out = paths + shape.spaced_at(u);
#pragma GCC unroll 4
    for (std::size_t k = 0; k < vectors; ++k)
      hn::Store(path.get(k), d, out + k * lanes);
  }
  state = path;
}

// Of a whole row. The last column stands in for the one right of it, and the first for the one left of it.
template <std::size_t kVectors>
void costs_and_leftward_path(const HammingRow& hamming, const RowShape& shape, const SgmSimdRows& rows,
                             const ThreeRows& three, bool below_is_there, int p1) {
  const std::size_t vectors = kVectors > 0 ? kVectors : shape.vectors;
  const int begin = shape.begin;
  const int end = shape.end;
  SidePath<kVectors> path(vectors);
  const auto walk = [&]<Below kBelow>(int first, int last) {
    costs_and_path<kBelow, kVectors>(hamming, shape, rows, three, p1, first, last, path);
  };
  const auto repeat = [&](int from, int to) {
    std::copy_n(three.above + shape.at(from), shape.pitch, three.above + shape.at(to));
  };
  if (below_is_there) {
    add_three_rows<Below::calculated, kVectors>(hamming, three, end - 1, vectors, shape.at(end - 1));
    repeat(end - 1, end);
    walk.template operator()<Below::calculated>(end - 1, begin + 1);
  } else {
    add_three_rows<Below::partly_outside, kVectors>(hamming, three, end - 1, vectors, shape.at(end - 1));
    repeat(end - 1, end);
    // Each step calculates the pixel before its own.
    const int inside_end = std::clamp(hamming.last_inside() + 1, begin, end - 1);
    const int inside_begin = std::clamp(hamming.first_inside(), begin, inside_end);
    walk.template operator()<Below::partly_outside>(end - 1, inside_end + 1);
    walk.template operator()<Below::inside>(inside_end, inside_begin + 1);
    walk.template operator()<Below::partly_outside>(inside_begin, begin + 1);
  }
  repeat(begin, begin - 1);
  walk.template operator()<Below::calculated>(begin, begin);
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

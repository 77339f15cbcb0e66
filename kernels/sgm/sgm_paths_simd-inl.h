// The two passes over a row: from right to left the costs and the path from the right, then from left to right the
// other paths, their sum and what follows from it alone (winner, uniqueness, sub-pixel).
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
#include "kernels/sgm/sgm_select_simd-inl.h"

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

// One path's step to a pixel: L of vector k from the costs and L of the pixel before. `least` is that pixel's least L.
HWY_INLINE ByteVec path_step(Bytes, ByteVec cost, ByteVec stay, ByteVec below, ByteVec beyond, ByteVec p1,
                             ByteVec jump, ByteVec least_before) {
  const auto move = hn::SaturatedAdd(hn::Min(below, beyond), p1);
  const auto best = hn::Min(hn::Min(stay, jump), move);
  return hn::SaturatedAdd(cost, hn::Sub(best, least_before));
}

// kVectors: vectors per pixel where it is known at compile time, else 0.
template <std::size_t kVectors>
class PathRow {
 public:
  PathRow(const SgmParams& params, const SgmSimdRows& rows, const HammingRow& hamming, std::size_t pitch)
      : p_(params), rows_(rows), hamming_(hamming), pitch_(pitch), vectors_(pitch / hn::Lanes(Bytes())) {}

  // Hamming distances of the row whose codes are in the planes.
  void distances(std::uint8_t* out) const {
    for (int u = p_.range.valid_begin; u < p_.range.valid_end; ++u)
      distances_of(u, out);
  }

  // C and the path from the right. `below` is filled on the way when kCompute, else it is there already.
  template <bool kCompute>
  void costs_and_leftward_path(const std::uint8_t* above, const std::uint8_t* here, std::uint8_t* below) const {
    const int begin = p_.range.valid_begin;
    const int end = p_.range.valid_end;
    auto floor = hn::Zero(Bytes());
    for (int u = end - 1; u >= begin; --u) {
      if constexpr (kCompute) distances_of(u, below);
      add_rows(above + at(u), here + at(u), below + at(u), column(u));
      if (u == end - 1) {
        std::copy_n(column(u), pitch_, column(u + 1));  // the last column repeated
      } else {
        floor = leftward_step(u + 1, floor);
      }
    }
    std::copy_n(column(begin), pitch_, column(begin - 1));
    leftward_step(begin, floor);
  }

  // The other paths, S, and per pixel the winner and its disparity if S alone says yes.
  template <bool kDiagonal>
  void sums_and_winners(const std::uint8_t* textured, const std::uint16_t* unique_limit,
                        std::int16_t* disparity) const;

 private:
  std::size_t vectors() const { return kVectors > 0 ? kVectors : vectors_; }
  static std::size_t lanes() { return hn::Lanes(Bytes()); }
  // Every row has a pixel of margin on the left, and one on the right: column -1 is there.
  std::size_t at(int u) const { return static_cast<std::size_t>(u + 1) * pitch_; }
  // The three rows' Hamming distances added up, of the last four pixels.
  std::uint8_t* column(int u) const { return rows_.columns.data() + static_cast<std::size_t>(u & 3) * pitch_; }

  HWY_INLINE void distances_of(int u, std::uint8_t* out) const {
    const Bytes d;
    std::uint8_t* pixel = out + at(u);
    if (HWY_UNLIKELY(hamming_.partly_outside(u))) {
      for (std::size_t k = 0; k < vectors(); ++k)
        hn::Store(hamming_.at_border(u, k, lanes()), d, pixel + k * lanes());
    } else {
      for (std::size_t k = 0; k < vectors(); ++k)
        hn::Store(hamming_.at(u, k, lanes()), d, pixel + k * lanes());
    }
  }

  HWY_INLINE void add_rows(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
                           std::uint8_t* out) const {
    const Bytes d;
    for (std::size_t k = 0; k < vectors(); ++k) {
      const std::size_t i = k * lanes();
      hn::Store(hn::Add(hn::Add(hn::Load(d, above + i), hn::Load(d, below + i)), hn::Load(d, here + i)), d,
                out + i);
    }
  }

  // C of pixel u: (sum of nine + 1) >> 2 as a rounding average and a shift; 255 beyond the disparities.
  HWY_INLINE ByteVec smooth_cost(int u, std::size_t k) const {
    const Bytes d;
    const Words d16;
    const std::size_t i = k * lanes();
    const auto pair = hn::Add(hn::Load(d, column(u - 1) + i), hn::Load(d, column(u) + i));
    const auto half = hn::AverageRound(pair, hn::Load(d, column(u + 1) + i));
    const auto quarter = hn::And(hn::BitCast(d, hn::ShiftRight<1>(hn::BitCast(d16, half))), hn::Set(d, 127));
    return hn::Or(quarter, hn::Load(d, rows_.beyond.data() + i));
  }

  // C and L of pixel u from L of pixel u + 1, whose least is `floor`; the new least.
  HWY_INLINE ByteVec leftward_step(int u, ByteVec floor) const {
    const Bytes d;
    const auto p1 = hn::Set(d, static_cast<std::uint8_t>(p_.p1));
    const auto jump = hn::SaturatedAdd(floor, hn::Set(d, rows_.side_penalty[static_cast<std::size_t>(u) + 1]));
    const auto outside = hn::Set(d, 255);
    const std::uint8_t* from = rows_.sideways.data() + at(u + 1);
    std::uint8_t* to = rows_.sideways.data() + at(u);
    std::uint8_t* cost_row = rows_.cost.data() + at(u);
    auto before = outside;
    auto here = hn::Load(d, from);
    auto lowest = outside;
    for (std::size_t k = 0; k < vectors(); ++k) {
      const std::size_t i = k * lanes();
      const auto after = k + 1 < vectors() ? hn::Load(d, from + i + lanes()) : outside;
      const auto cost = smooth_cost(u, k);
      const auto path =
          path_step(d, cost, here, moved_up(d, here, before), moved_down(d, here, after), p1, jump, floor);
      hn::Store(cost, d, cost_row + i);
      hn::Store(path, d, to + i);
      lowest = hn::Min(lowest, path);
      before = here;
      here = after;
    }
    return least(d, lowest);
  }

  const SgmParams& p_;
  const SgmSimdRows& rows_;
  const HammingRow& hamming_;
  std::size_t pitch_;
  std::size_t vectors_;
};

template <std::size_t kVectors>
template <bool kDiagonal>
void PathRow<kVectors>::sums_and_winners(const std::uint8_t* textured, const std::uint16_t* unique_limit,
                                         std::int16_t* disparity) const {
  constexpr int kPaths = kDiagonal ? 3 : 1;
  const Bytes d;
  const auto p1 = hn::Set(d, static_cast<std::uint8_t>(p_.p1));
  const auto outside = hn::Set(d, 255);
  const WinnerOfPixel<kVectors> winner(p_, rows_, unique_limit, vectors());
  auto floor = hn::Zero(d);
  for (int u = p_.range.valid_begin; u < p_.range.valid_end; ++u) {
    const auto column = static_cast<std::size_t>(u);
    const auto jump = hn::SaturatedAdd(floor, hn::Set(d, rows_.side_penalty[column]));
    const std::uint8_t* cost_row = rows_.cost.data() + at(u);
    const std::uint8_t* from = rows_.sideways.data() + at(u - 1);
    std::uint8_t* to = rows_.sideways.data() + at(u);
    std::uint8_t* sums = rows_.sums.data() + at(u);
    // The path from the left takes the place of the one from the right.
    auto before = outside;
    auto here = hn::Load(d, from);
    auto lowest = outside;
    for (std::size_t k = 0; k < vectors(); ++k) {
      const std::size_t i = k * lanes();
      const auto after = k + 1 < vectors() ? hn::Load(d, from + i + lanes()) : outside;
      const auto path = path_step(d, hn::Load(d, cost_row + i), here, moved_up(d, here, before),
                                  moved_down(d, here, after), p1, jump, floor);
      hn::Store(hn::SaturatedAdd(path, hn::Load(d, to + i)), d, sums + i);
      hn::Store(path, d, to + i);
      lowest = hn::Min(lowest, path);
      before = here;
      here = after;
    }
    floor = least(d, lowest);

    auto lowest_sum = outside;
    for (int path = 0; path < kPaths; ++path) {
      constexpr int kShift[kMaxTopPaths] = {0, -1, 1};
      const int source = u + kShift[path];
      const std::uint8_t* above = rows_.above[path].data() + at(source);
      std::uint8_t* current = rows_.current[path].data() + at(u);
      const auto above_floor = hn::Set(d, rows_.above_least[path][static_cast<std::size_t>(source + 1)]);
      const auto above_jump = hn::SaturatedAdd(above_floor, hn::Set(d, rows_.top_penalty[path][column]));
      auto top_before = outside;
      auto top_here = hn::Load(d, above);
      auto top_lowest = outside;
      for (std::size_t k = 0; k < vectors(); ++k) {
        const std::size_t i = k * lanes();
        const auto after = k + 1 < vectors() ? hn::Load(d, above + i + lanes()) : outside;
        const auto top = path_step(d, hn::Load(d, cost_row + i), top_here, moved_up(d, top_here, top_before),
                                   moved_down(d, top_here, after), p1, above_jump, above_floor);
        const auto sum = hn::SaturatedAdd(hn::Load(d, sums + i), top);
        hn::Store(top, d, current + i);
        hn::Store(sum, d, sums + i);
        top_lowest = hn::Min(top_lowest, top);
        if (path == kPaths - 1) lowest_sum = hn::Min(lowest_sum, sum);
        top_before = top_here;
        top_here = after;
      }
      rows_.current_least[path][column + 1] = first_byte(least(d, top_lowest));
    }
    if (disparity == nullptr) continue;  // a warm-up row
    disparity[u] = textured[u] == 0 ? winner.without_texture(u) : winner.of(u, sums, least(d, lowest_sum));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

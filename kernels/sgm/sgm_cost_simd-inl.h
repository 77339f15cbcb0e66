// Hamming distances of one row of census codes, all candidates of a pixel at once.
#if defined(LAKSHYA_SGM_COST_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LAKSHYA_SGM_COST_SIMD_INL
#undef LAKSHYA_SGM_COST_SIMD_INL
#else
#define LAKSHYA_SGM_COST_SIMD_INL
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/base/search_range.h"
#include "kernels/hamming/hamming.h"
#include "kernels/sgm/candidates_simd-inl.h"
#include "kernels/sgm/sgm_simd_rows.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {

// A code is taken apart into planes of one byte, where bits can be counted in a byte (NEON, SVE, AVX3_DL), else of four
// bits, which a table of 16 bytes counts.
#if HWY_TARGET == HWY_AVX3_DL || HWY_ARCH_ARM
inline constexpr int kCodePlanes = 4;
inline constexpr int kPlaneBits = 8;
#else
inline constexpr int kCodePlanes = 8;
inline constexpr int kPlaneBits = 4;
#endif

class BitCounts {
 public:
#if HWY_TARGET == HWY_AVX3_DL || HWY_ARCH_ARM
  HWY_INLINE ByteVec of(ByteVec v) const {
    return hn::PopulationCount(v);
  }
#else
  // Not a default member initialiser: g++ would compile that for the baseline.
  BitCounts() {
    alignas(16) static constexpr std::uint8_t kBits[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};
    table_ = hn::LoadDup128(Bytes(), kBits);
  }
  HWY_INLINE ByteVec of(ByteVec v) const {
    return hn::TableLookupBytes(table_, v);
  }

 private:
  ByteVec table_;
#endif
};

// Takes the left codes apart: every plane's bits in all four bytes of a word, so that spreading them over a vector is one
// load.
inline void left_planes(const std::uint32_t* codes, int width, const SgmSimdRows& rows) {
  const hn::Repartition<std::uint32_t, Bytes> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto mask = hn::Set(d, (1U << kPlaneBits) - 1);
  for (int u = 0; u < width; u += lanes) {
    auto rest = hn::Undefined(d);
    if (u + lanes <= width) {
      rest = hn::LoadU(d, codes + u);
    } else {
      std::uint32_t last[kMaxVectorBytes / sizeof(std::uint32_t)] = {};
      std::copy(codes + u, codes + width, last);
      rest = hn::LoadU(d, last);
    }
    for (int p = 0; p < kCodePlanes; ++p) {
      auto bits = hn::And(rest, mask);
      bits = hn::Or(bits, hn::ShiftLeft<8>(bits));
      bits = hn::Or(bits, hn::ShiftLeft<16>(bits));
      hn::StoreU(bits, d, rows.left_planes[p].data() + u);
      rest = hn::ShiftRight<kPlaneBits>(rest);
    }
  }
}

// Where in the reversed row the right pixels are that have descriptors.
struct ReversedRange {
  int begin = 0;
  int end = 0;
};
inline ReversedRange reversed_range(const SearchRange& range, int width, int pitch) {
  const int begin = width - range.first - range.valid_end;
  const int end = width - range.first - range.valid_begin;
  return {std::clamp(begin, 0, width + pitch), std::clamp(end, 0, width + pitch)};
}

// Byte `byte` of the codes at y.
HWY_INLINE void store_planes(ByteVec bytes, int byte, int y, const SgmSimdRows& rows) {
  const Bytes d;
#if HWY_TARGET == HWY_AVX3_DL || HWY_ARCH_ARM
  hn::StoreU(bytes, d, rows.right_planes[byte].data() + y);
#else
  const Words d16;
  const auto low = hn::Set(d, 15);
  const auto high = hn::BitCast(d, hn::ShiftRight<4>(hn::BitCast(d16, bytes)));
  hn::StoreU(hn::And(bytes, low), d, rows.right_planes[2 * byte].data() + y);
  hn::StoreU(hn::And(high, low), d, rows.right_planes[2 * byte + 1].data() + y);
#endif
}

// Takes the right codes apart, reversed. What is outside `valid` stays 0, which it has been since the start.
inline void right_planes(const std::uint32_t* codes, int width, int first, ReversedRange valid,
                         const SgmSimdRows& rows) {
  const hn::Repartition<std::uint32_t, Bytes> d32;
  const int words = static_cast<int>(hn::Lanes(d32));
  std::uint32_t* reversed = rows.right_codes.data();
  int y = valid.begin;
  for (; y + words <= valid.end; y += words)
    hn::StoreU(hn::Reverse(d32, hn::LoadU(d32, codes + width - first - y - words)), d32, reversed + y);
  for (; y < valid.end; ++y)
    reversed[y] = codes[width - 1 - first - y];

  const Bytes d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (y = valid.begin; y < valid.end; y += lanes) {
    auto b0 = hn::Undefined(d);
    auto b1 = b0;
    auto b2 = b0;
    auto b3 = b0;
    hn::LoadInterleaved4(d, reinterpret_cast<const std::uint8_t*>(reversed + y), b0, b1, b2, b3);
    store_planes(b0, 0, y, rows);
    store_planes(b1, 1, y, rows);
    store_planes(b2, 2, y, rows);
    store_planes(b3, 3, y, rows);
  }
}

// Hamming distances of pixel u, `vectors` of them, into `out`.
class HammingRow {
 public:
  HammingRow(const SgmSimdRows& rows, int width, int disparities, ReversedRange valid)
      : rows_(rows), width_(width), disparities_(disparities), valid_(valid) {}

  // Whether some candidate's right pixel has no descriptor.
  bool partly_outside(int u) const {
    const int y = width_ - 1 - u;
    return y < valid_.begin || y + disparities_ > valid_.end;
  }

  HWY_INLINE ByteVec at(int u, std::size_t k, std::size_t lanes) const {
    const Bytes d;
    const hn::Repartition<std::uint32_t, Bytes> d32;
    const std::size_t y = static_cast<std::size_t>(width_ - 1 - u) + k * lanes;
    auto sum = hn::Zero(d);
    for (int p = 0; p < kCodePlanes; ++p) {
      const auto left = hn::BitCast(d, hn::Set(d32, rows_.left_planes[p][static_cast<std::size_t>(u)]));
      sum = hn::Add(sum, count_.of(hn::Xor(left, hn::LoadU(d, rows_.right_planes[p].data() + y))));
    }
    return sum;
  }

  HWY_INLINE ByteVec at_border(int u, std::size_t k, std::size_t lanes) const {
    const Bytes d;
    const std::size_t y = static_cast<std::size_t>(width_ - 1 - u) + k * lanes;
    const auto inside = hn::MaskFromVec(hn::LoadU(d, rows_.right_valid.data() + y));
    return hn::IfThenElse(inside, at(u, k, lanes), hn::Set(d, kOutsideCost));
  }

 private:
  const SgmSimdRows& rows_;
  int width_;
  int disparities_;
  ReversedRange valid_;
  BitCounts count_;
};

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

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

// Bits are counted in whole bytes where the machine can, else in four bits by a table of 16 bytes.
#if HWY_TARGET == HWY_AVX3_DL || HWY_ARCH_ARM
inline constexpr std::size_t kCodePlanes = 2;
inline constexpr int kPlaneBits = 8;
#else
inline constexpr std::size_t kCodePlanes = 4;
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
inline void left_planes(const CensusCode* codes, int width, std::uint32_t* planes) {
  constexpr unsigned kMask = (1U << kPlaneBits) - 1;
  constexpr std::uint32_t kAllBytes = 0x01010101U;
  for (int u = 0; u < width; ++u) {
    for (std::size_t p = 0; p < kCodePlanes; ++p)
      *planes++ = ((codes[u] >> (kPlaneBits * static_cast<int>(p))) & kMask) * kAllBytes;
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

// Byte `byte` of the codes from y on.
HWY_INLINE void store_planes(ByteVec bytes, std::size_t byte, int y, const SgmSimdRows& rows) {
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
inline void right_planes(const CensusCode* codes, int width, int first, ReversedRange valid,
                         const SgmSimdRows& rows) {
  const Words d16;
  const int words = static_cast<int>(hn::Lanes(d16));
  CensusCode* reversed = rows.right_codes.data();
  int y = valid.begin;
  for (; y + words <= valid.end; y += words)
    hn::StoreU(hn::Reverse(d16, hn::LoadU(d16, codes + width - first - y - words)), d16, reversed + y);
  for (; y < valid.end; ++y)
    reversed[y] = codes[width - 1 - first - y];

  const Bytes d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (y = valid.begin; y < valid.end; y += lanes) {
    auto low = hn::Undefined(d);
    auto high = low;
    hn::LoadInterleaved2(d, reinterpret_cast<const std::uint8_t*>(reversed + y), low, high);
    store_planes(low, 0, y, rows);
    store_planes(high, 1, y, rows);
  }
}

// Hamming distances of a row whose codes have been taken apart. Pointers of its own: bytes that are stored through other
// pointers could change what a reference refers to.
class HammingRow {
 public:
  HammingRow(const SgmSimdRows& rows, int width, int disparities, ReversedRange valid)
      : left_(rows.left_planes.data()),
        right_valid_(rows.right_valid.data()),
        width_(width),
        disparities_(disparities),
        valid_(valid) {
    for (std::size_t p = 0; p < kCodePlanes; ++p)
      right_[p] = rows.right_planes[p].data();
  }

  // Whether some candidate's right pixel has no descriptor.
  HWY_INLINE bool partly_outside(int u) const {
    const int y = width_ - 1 - u;
    return y < valid_.begin || y + disparities_ > valid_.end;
  }

  // Of pixel u, `vectors` of them.
  HWY_INLINE void store(int u, std::size_t vectors, std::uint8_t* out) const {
    const Bytes d;
    const std::size_t lanes = hn::Lanes(d);
    const std::size_t y = static_cast<std::size_t>(width_ - 1 - u);
#pragma GCC unroll 4
    for (std::size_t k = 0; k < vectors; ++k)
      hn::Store(distance(u, y + k * lanes), d, out + k * lanes);
    if (HWY_LIKELY(!partly_outside(u))) return;
    for (std::size_t k = 0; k < vectors; ++k) {
      const auto inside = hn::MaskFromVec(hn::LoadU(d, right_valid_ + y + k * lanes));
      hn::Store(hn::IfThenElse(inside, hn::Load(d, out + k * lanes), hn::Set(d, kOutsideCost)), d, out + k * lanes);
    }
  }

 private:
  HWY_INLINE ByteVec part(int u, std::size_t y, std::size_t p) const {
    const Bytes d;
    const hn::Repartition<std::uint32_t, Bytes> d32;
    const auto left = hn::BitCast(d, hn::Set(d32, left_[static_cast<std::size_t>(u) * kCodePlanes + p]));
    return count_.of(hn::Xor(left, hn::LoadU(d, right_[p] + y)));
  }
  HWY_INLINE ByteVec distance(int u, std::size_t y) const {
    auto sum = hn::Add(part(u, y, 0), part(u, y, 1));
    if constexpr (kCodePlanes == 4) sum = hn::Add(sum, hn::Add(part(u, y, 2), part(u, y, 3)));
    return sum;
  }

  const std::uint32_t* left_;
  const std::uint8_t* right_[kCodePlanes];
  const std::uint8_t* right_valid_;
  int width_;
  int disparities_;
  ReversedRange valid_;
  BitCounts count_;
};

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

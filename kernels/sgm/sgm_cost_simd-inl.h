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
    auto low = hn::Zero(d);
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
        first_inside_(width - 1 + disparities - valid.end),
        last_inside_(width - 1 - valid.begin),
        width_(width) {
    for (std::size_t p = 0; p < kCodePlanes; ++p)
      right_[p] = rows.right_planes[p].data();
  }

  // Pixels all of whose candidates have a right pixel with a descriptor: these and those between; maybe none.
  int first_inside() const { return first_inside_; }
  int last_inside() const { return last_inside_; }

  // Of pixel u. For a pixel that is not inside, kInside must be false.
  template <bool kInside, std::size_t kVectors>
  HWY_INLINE void distances(int u, std::size_t vectors, PixelVecs<kVectors>& out) const {
    const Bytes d;
    const hn::Repartition<std::uint32_t, Bytes> d32;
    const std::size_t lanes = hn::Lanes(d);
    const std::size_t y = static_cast<std::size_t>(width_ - 1 - u);
    const std::uint32_t* left = left_ + static_cast<std::size_t>(u) * kCodePlanes;
    const BitCounts count = count_;
    const auto left0 = hn::BitCast(d, hn::Set(d32, left[0]));
    const auto left1 = hn::BitCast(d, hn::Set(d32, left[1]));
    const auto left2 = hn::BitCast(d, hn::Set(d32, left[kCodePlanes - 2]));
    const auto left3 = hn::BitCast(d, hn::Set(d32, left[kCodePlanes - 1]));
    const auto part = [&](ByteVec plane, std::size_t p, std::size_t k)
                          HWY_ATTR { return count.of(hn::Xor(plane, hn::LoadU(d, right_[p] + y + k * lanes))); };
#pragma GCC unroll 4
    for (std::size_t k = 0; k < vectors; ++k) {
      auto sum = hn::Add(part(left0, 0, k), part(left1, 1, k));
      if constexpr (kCodePlanes == 4) {
        sum = hn::Add(sum, hn::Add(part(left2, kCodePlanes - 2, k), part(left3, kCodePlanes - 1, k)));
      }
      if constexpr (!kInside) {
        const auto valid = hn::LoadU(d, right_valid_ + y + k * lanes);
        sum = hn::IfThenElse(hn::MaskFromVec(valid), sum, hn::Set(d, kOutsideCost));
      }
      out.set(k, sum);
    }
  }

 private:
  const std::uint32_t* left_;
  const std::uint8_t* right_[kCodePlanes];
  const std::uint8_t* right_valid_;
  int first_inside_;
  int last_inside_;
  int width_;
  BitCounts count_;
};

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

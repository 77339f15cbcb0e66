// CompressStore for vectors of 32-bit lanes. Highway's own looks its shuffles up in a local array where the instruction
// set has no compress; GCC 12 copies that array to the stack every time, which made projection five times slower.
#if defined(KERNELS_BASE_COMPRESS_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef KERNELS_BASE_COMPRESS_SIMD_INL_H
#undef KERNELS_BASE_COMPRESS_SIMD_INL_H
#else
#define KERNELS_BASE_COMPRESS_SIMD_INL_H
#endif

#include <array>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_SSSE3 || HWY_TARGET == HWY_NEON
// For each mask of eight lanes: the lanes that are set, in order.
using CompressTable = std::array<std::array<std::uint8_t, 8>, 256>;
constexpr CompressTable make_compress_table() {
  CompressTable table{};
  for (std::size_t mask = 0; mask < 256; ++mask) {
    std::size_t count = 0;
    for (std::uint8_t lane = 0; lane < 8; ++lane) {
      if ((mask >> lane & 1) != 0) table[mask][count++] = lane;
    }
  }
  return table;
}
alignas(64) inline constexpr CompressTable kCompressTable = make_compress_table();

template <class D>
HWY_INLINE std::size_t compress_by_bits(hn::Vec<D> v, std::size_t bits, D d, std::int32_t* to) {
  const hn::Rebind<std::uint8_t, D> bytes;
  const auto order = hn::PromoteTo(d, hn::LoadU(bytes, kCompressTable[bits].data()));
  hn::StoreU(hn::TableLookupLanes(v, hn::IndicesFromVec(d, order)), d, to);
  return hwy::PopCount(std::uint64_t{bits});
}

// Writes the lanes of `v` that `mask` has, in order, and returns their number; may write a whole vector.
template <class D>
HWY_INLINE std::size_t compress_store(hn::Vec<D> v, hn::Mask<D> mask, D d, std::int32_t* to) {
  std::uint8_t bits[8];
  hn::StoreMaskBits(d, mask, bits);
  return compress_by_bits(v, bits[0], d, to);
}

// The same for two vectors with one mask of as many 16-bit lanes.
template <class D, class D16>
HWY_INLINE std::size_t compress_store_two(hn::Vec<D> low, hn::Vec<D> high, hn::Mask<D16> mask, D d, D16 d16,
                                          std::int32_t* to) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d16, mask, bytes);
  const std::size_t bits = bytes[0] | std::size_t{bytes[1]} << 8;
  const std::size_t count = compress_by_bits(low, bits & ((std::size_t{1} << hn::Lanes(d)) - 1), d, to);
  return count + compress_by_bits(high, bits >> hn::Lanes(d), d, to + count);
}
#else
template <class D>
HWY_INLINE std::size_t compress_store(hn::Vec<D> v, hn::Mask<D> mask, D d, std::int32_t* to) {
  return hn::CompressStore(v, mask, d, to);
}

template <class D, class D16>
HWY_INLINE std::size_t compress_store_two(hn::Vec<D> low, hn::Vec<D> high, hn::Mask<D16> mask, D d, D16 d16,
                                          std::int32_t* to) {
  const hn::Half<D16> half;
  const auto which = hn::VecFromMask(d16, mask);
  const auto in_low = hn::MaskFromVec(hn::PromoteTo(d, hn::LowerHalf(half, which)));
  const auto in_high = hn::MaskFromVec(hn::PromoteTo(d, hn::UpperHalf(half, which)));
  const std::size_t count = hn::CompressStore(low, in_low, d, to);
  return count + hn::CompressStore(high, in_high, d, to + count);
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

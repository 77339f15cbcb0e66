// Vectors of candidates (one byte each, side by side), for every instruction set that a *_simd.cc compiles for.
#if defined(LAKSHYA_CANDIDATES_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LAKSHYA_CANDIDATES_SIMD_INL
#undef LAKSHYA_CANDIDATES_SIMD_INL
#else
#define LAKSHYA_CANDIDATES_SIMD_INL
#endif

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/kept_simd-inl.h"
#include "kernels/base/search_range.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Never longer than the layout's vectors (kMaxVectorBytes).
using Bytes = hn::CappedTag<std::uint8_t, 64>;
using Words = hn::RepartitionToWide<Bytes>;
using ByteVec = hn::Vec<Bytes>;
inline constexpr std::size_t kFewestLanes = 16;

// Every candidate's neighbour with the smaller disparity: `here` moved up by one, the last one of `before` first.
HWY_INLINE ByteVec moved_up([[maybe_unused]] Bytes d, ByteVec here, ByteVec before) {
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  // Highway 1.0 has no shift across all blocks of 512 bits; the blocks are moved up by one first.
  const ByteVec blocks{_mm512_alignr_epi64(here.raw, before.raw, 6)};
  return hn::CombineShiftRightBytes<15>(d, here, blocks);
#elif HWY_TARGET == HWY_AVX2
  return hn::CombineShiftRightBytes<15>(d, here, hn::ConcatLowerUpper(d, here, before));
#elif HWY_ARCH_ARM && HWY_TARGET != HWY_NEON
  const svbool_t lanes = svwhilelt_b8(std::uint64_t{0}, static_cast<std::uint64_t>(hn::Lanes(d)));
  return svinsr_n_u8(here, svlastb_u8(lanes, before));
#else
  return hn::CombineShiftRightBytes<15>(d, here, before);
#endif
}

// Every candidate's neighbour with the larger disparity: `here` moved down by one, the first one of `after` last.
HWY_INLINE ByteVec moved_down([[maybe_unused]] Bytes d, ByteVec here, ByteVec after) {
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  const ByteVec blocks{_mm512_alignr_epi64(after.raw, here.raw, 2)};
  return hn::CombineShiftRightBytes<1>(d, blocks, here);
#elif HWY_TARGET == HWY_AVX2
  return hn::CombineShiftRightBytes<1>(d, hn::ConcatLowerUpper(d, after, here), here);
#elif HWY_ARCH_ARM && HWY_TARGET != HWY_NEON
  const auto last = hn::Eq(hn::Iota(d, 0), hn::Set(d, static_cast<std::uint8_t>(hn::Lanes(d) - 1)));
  return hn::IfThenElse(last, hn::Set(d, svlasta_u8(svpfalse_b(), after)), svext_u8(here, here, 1));
#else
  return hn::CombineShiftRightBytes<1>(d, after, here);
#endif
}

// The smallest byte, in the form in which it is found; in_every_byte and number make of it what is wanted.
#if HWY_ARCH_X86
using Block = hn::Vec<hn::Full128<std::uint8_t>>;

HWY_INLINE Block block_minimum(hn::Full128<std::uint8_t>, Block v) {
  return v;
}
template <class D>
HWY_INLINE Block block_minimum(D, hn::Vec<D> v) {
  const hn::Half<D> half;
  return block_minimum(half, hn::Min(hn::LowerHalf(half, v), hn::UpperHalf(half, v)));
}
// In the first of 16-bit lanes.
HWY_INLINE __m128i least(Bytes d, ByteVec v) {
  const hn::Full128<std::uint8_t> d128;
  const hn::Full128<std::uint16_t> d16;
  const Block block = block_minimum(d, v);
  // The lower byte of each word becomes the smaller of the two, the upper one 0; then one instruction finds the least.
  const Block pairs = hn::Min(block, hn::BitCast(d128, hn::ShiftRight<8>(hn::BitCast(d16, block))));
  return _mm_minpos_epu16(pairs.raw);
}
HWY_INLINE ByteVec in_every_byte(Bytes, __m128i least) {
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  return ByteVec{_mm512_broadcastb_epi8(least)};
#elif HWY_TARGET == HWY_AVX2
  return ByteVec{_mm256_broadcastb_epi8(least)};
#else
  return ByteVec{_mm_shuffle_epi8(least, _mm_setzero_si128())};
#endif
}
// Bits 8 to 15 are 0, those above are not.
HWY_INLINE std::uint8_t number(__m128i least) {
  return static_cast<std::uint8_t>(_mm_cvtsi128_si32(least));
}
#else
HWY_INLINE std::uint8_t least([[maybe_unused]] Bytes d, ByteVec v) {
#if HWY_TARGET == HWY_NEON
  return vminvq_u8(v.raw);
#else
  return svminv_u8(svwhilelt_b8(std::uint64_t{0}, static_cast<std::uint64_t>(hn::Lanes(d))), v);
#endif
}
HWY_INLINE ByteVec in_every_byte(Bytes d, std::uint8_t least) {
  return hn::Set(d, least);
}
HWY_INLINE std::uint8_t number(std::uint8_t least) {
  return least;
}
#endif

// One bit per byte of a mask.
template <class Mask>
HWY_INLINE std::uint64_t mask_bits(Bytes d, Mask mask) {
  // The size is known where the vector's is, so that on x86 this is one instruction and not a trip through memory.
#if HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_NEON
  std::uint16_t bits = 0;
#elif HWY_TARGET == HWY_AVX2
  std::uint32_t bits = 0;
#else
  std::uint64_t bits = 0;
#endif
  (void)hn::StoreMaskBits(d, mask, reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

// The vectors of one pixel's candidates. As many as kVectors, 0: any number.
template <std::size_t kVectors>
class PixelVecs {
 public:
  HWY_INLINE PixelVecs() {}
  HWY_INLINE ByteVec get(std::size_t k) const { return data_[k].get(); }
  HWY_INLINE void set(std::size_t k, ByteVec v) { data_[k] = Kept<Bytes>(v); }

 private:
  Kept<Bytes> data_[kVectors > 0 ? kVectors : std::size_t{kMaxDisparities} / kFewestLanes];
};

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

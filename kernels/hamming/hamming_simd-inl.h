// Hamming distances of census codes of one column (kernels/hamming): the row that enters a window minus the row that
// leaves it, which is kept. The right codes lie as four planes of four bits, and what four bits differ from the left
// pixel's is looked up in the row of a table that the left bits choose: a look-up and an addition for each plane.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hwy/highway.h"
#include "kernels/block/block_checks.h"
#include "kernels/block/block_rows.h"

#if defined(LAKSHYA_HAMMING_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LAKSHYA_HAMMING_SIMD_INL
#undef LAKSHYA_HAMMING_SIMD_INL
#else
#define LAKSHYA_HAMMING_SIMD_INL
#endif

#ifndef LAKSHYA_HAMMING_SIMD_SHARED
#define LAKSHYA_HAMMING_SIMD_SHARED
namespace lakshya {

struct NibbleDistances {
  alignas(16) std::uint8_t of[16][16];
};
inline constexpr NibbleDistances kNibbleDistances = [] {
  NibbleDistances d{};
  for (unsigned a = 0; a < 16; ++a) {
    for (unsigned b = 0; b < 16; ++b)
      d.of[a][b] = static_cast<std::uint8_t>(std::popcount(a ^ b));
  }
  return d;
}();

}  // namespace lakshya
#endif

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class D>
class HammingDelta {
  using Bytes = hn::Repartition<std::uint8_t, D>;
  static constexpr std::size_t kPlanes = 4;

 public:
  using V = hn::Vec<D>;

  HammingDelta(const BlockCall<CensusTraits>& call, const CensusRows& rows)
      : call_(call), rows_(rows), place_(call.params.range) {
    std::fill(rows.zero.begin(), rows.zero.end(), std::uint8_t{0});
    std::fill(rows.ring.begin(), rows.ring.end(), std::uint8_t{0});
    for (std::size_t j = 0; j < rows.inside.size(); ++j) {
      const bool inside = place_.inside(static_cast<int>(j));
      rows.inside[j] = static_cast<std::uint8_t>(inside ? 255 : 0);
      rows.outside[j] = inside ? std::uint8_t{0} : CensusTraits::outside(call.params);
    }
  }

  // Row `enters` comes into the window, row `leaves` goes; -1 for none. `turn` counts the calls.
  void set_rows(int enters, int /*leaves*/, int turn) {
    const std::size_t row = rows_.ring.size() / static_cast<std::size_t>(window_rows(call_.params.radius_v));
    ring_ = rows_.ring.data() + static_cast<std::size_t>(turn % window_rows(call_.params.radius_v)) * row;
    left_ = reinterpret_cast<const CensusCode*>(rows_.zero.data());
    outside_ = rows_.zero.data();
    planes_.fill(rows_.zero.data());
    if (enters < 0) return;
    left_ = call_.left.row(enters);
    outside_ = rows_.outside.data();
    const std::size_t plane = rows_.planes.size() / kPlanes;
    for (std::size_t p = 0; p < kPlanes; ++p)
      planes_[p] = rows_.planes.data() + p * plane;
    split(call_.right.row(enters), rows_.planes.data(), static_cast<std::ptrdiff_t>(plane));
  }

  bool border(int x) const { return place_.border(x); }

  // Of one column, by value: what a vector store may have changed would be loaded again and again.
  template <bool kBorder>
  class Column {
   public:
    HWY_INLINE Column(const HammingDelta& h, int x)
        : at_(h.place_.of_column(x)),
          planes_(h.planes_),
          costs_(h.ring_ + static_cast<std::ptrdiff_t>(x) * h.place_.disparities),
          inside_(h.rows_.inside.data() + at_),
          outside_(h.outside_ + at_) {
      const unsigned code = h.left_[x];
      for (std::size_t p = 0; p < kPlanes; ++p) {
        planes_[p] += at_;
        tables_[p] = kNibbleDistances.of[(code >> (4 * p)) & 15U];
      }
    }

    // Candidates [i, i + Lanes) and the next Lanes.
    HWY_INLINE void delta(int i, V& low, V& high) const {
      const Bytes d8;
      auto cost = distance(i, 0);
      for (std::size_t p = 1; p < kPlanes; ++p)
        cost = hn::Add(cost, distance(i, p));
      if (kBorder) cost = hn::Or(hn::And(cost, hn::LoadU(d8, inside_ + i)), hn::LoadU(d8, outside_ + i));
      const auto old = hn::LoadU(d8, costs_ + i);
      hn::StoreU(cost, d8, costs_ + i);
      const hn::Repartition<std::int8_t, D> di8;
      const hn::Rebind<std::int8_t, D> half;
      const auto change = hn::BitCast(di8, hn::Sub(cost, old));
      low = hn::PromoteTo(D(), hn::LowerHalf(half, change));
      high = hn::PromoteTo(D(), hn::UpperHalf(half, change));
    }

   private:
    HWY_INLINE hn::Vec<hn::Repartition<std::uint8_t, D>> distance(int i, std::size_t p) const {
      const Bytes d8;
      return hn::TableLookupBytes(hn::LoadDup128(d8, tables_[p]), hn::LoadU(d8, planes_[p] + i));
    }

    std::ptrdiff_t at_;
    std::array<const std::uint8_t*, kPlanes> planes_;
    std::array<const std::uint8_t*, kPlanes> tables_;
    std::uint8_t* costs_;
    const std::uint8_t* inside_;
    const std::uint8_t* outside_;
  };

 private:
  // The valid right codes, reversed.
  void split(const CensusCode* right, std::uint8_t* planes, std::ptrdiff_t stride) const {
    const hn::FixedTag<std::uint8_t, 16> d;
    const int last = place_.column_of(0);
    const auto reverse = hn::Sub(hn::Set(d, std::uint8_t{15}), hn::Iota(d, std::uint8_t{0}));
    const auto low_bits = hn::Set(d, std::uint8_t{15});
    int j = place_.inside_begin;
    for (; j + 16 <= place_.inside_end; j += 16) {
      hn::Vec<decltype(d)> bytes[2];
      hn::LoadInterleaved2(d, reinterpret_cast<const std::uint8_t*>(right + (last - j - 15)), bytes[0], bytes[1]);
      std::uint8_t* to = planes + j;
      for (const auto& byte : bytes) {
        const auto reversed = hn::TableLookupBytes(byte, reverse);
        hn::StoreU(hn::And(reversed, low_bits), d, to);
        hn::StoreU(hn::ShiftRight<4>(reversed), d, to + stride);
        to += 2 * stride;
      }
    }
    for (; j < place_.inside_end; ++j) {
      for (std::size_t p = 0; p < kPlanes; ++p)
        planes[static_cast<std::ptrdiff_t>(p) * stride + j] =
            static_cast<std::uint8_t>((right[last - j] >> (4 * p)) & 15U);
    }
  }

  const BlockCall<CensusTraits>& call_;
  CensusRows rows_;
  ReversedRow place_;
  std::array<const std::uint8_t*, kPlanes> planes_{};
  const CensusCode* left_ = nullptr;
  const std::uint8_t* outside_ = nullptr;
  std::uint8_t* ring_ = nullptr;
};

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();
#endif

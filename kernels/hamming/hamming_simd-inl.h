// Hamming distances of census codes (kernels/hamming): the row that enters a window minus the row that leaves it, which is
// kept, for columns side by side. The right codes lie as four planes of four bits, and what four bits differ from the left
// pixel's is looked up in the row of a table that the left bits choose: a look-up and an addition for each plane.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hwy/highway.h"
#include "kernels/base/kept_simd-inl.h"
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
    place_.mark(CensusTraits::outside(call.params), rows.inside, rows.outside);
  }

  // Row `enters` comes into the window, row `leaves` goes; -1 for none. `turn` counts the calls.
  void set_rows(int enters, int leaves, int turn) {
    const std::size_t row = rows_.ring.size() / static_cast<std::size_t>(window_rows(call_.params.radius_v));
    ring_ = rows_.ring.data() + static_cast<std::size_t>(turn % window_rows(call_.params.radius_v)) * row;
    leaves_ = leaves < 0 ? rows_.zero.data() : ring_;
    leaves_step_ = leaves < 0 ? 0 : place_.disparities;
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

  const ReversedRow& place() const { return place_; }

  // Candidates [i, i + 2 Lanes) of columns from x on, by value: what a vector store may have changed would be loaded again
  // and again. kBorder: some candidates are outside the right image.
  template <bool kBorder>
  class Columns {
   public:
    HWY_INLINE Columns(const HammingDelta& h, int x, int i)
        : left_(h.left_ + x),
          plane0_(h.planes_[0] + h.place_.of_column(x) + i),
          plane1_(h.planes_[1] + h.place_.of_column(x) + i),
          plane2_(h.planes_[2] + h.place_.of_column(x) + i),
          plane3_(h.planes_[3] + h.place_.of_column(x) + i),
          costs_(h.ring_ + static_cast<std::ptrdiff_t>(x) * h.place_.disparities + i),
          leaves_(h.leaves_ + x * h.leaves_step_ + i),
          leaves_step_(h.leaves_step_),
          inside_(h.rows_.inside.data() + h.place_.of_column(x) + i),
          outside_(h.outside_ + h.place_.of_column(x) + i) {}

    // The rows of the table that the k-th left code chooses.
    struct Left {
      Kept<Bytes> table0;
      Kept<Bytes> table1;
      Kept<Bytes> table2;
      Kept<Bytes> table3;
    };
    HWY_INLINE Left left(std::ptrdiff_t k) const {
      const Bytes d8;
      const std::size_t code = left_[k];
      return {Kept<Bytes>(hn::LoadDup128(d8, kNibbleDistances.of[code & 15])),
              Kept<Bytes>(hn::LoadDup128(d8, kNibbleDistances.of[code >> 4 & 15])),
              Kept<Bytes>(hn::LoadDup128(d8, kNibbleDistances.of[code >> 8 & 15])),
              Kept<Bytes>(hn::LoadDup128(d8, kNibbleDistances.of[code >> 12]))};
    }

    // Of the k-th column: the first half of the candidates, and the second. `disparities` apart.
    HWY_INLINE void delta(const Left& left, std::ptrdiff_t k, std::ptrdiff_t disparities, V& low, V& high) const {
      const Bytes d8;
      auto cost = hn::Add(hn::Add(distance(left.table0, plane0_ - k), distance(left.table1, plane1_ - k)),
                          hn::Add(distance(left.table2, plane2_ - k), distance(left.table3, plane3_ - k)));
      if (kBorder) cost = hn::Or(hn::And(cost, hn::LoadU(d8, inside_ - k)), hn::LoadU(d8, outside_ - k));
      const auto old = hn::LoadU(d8, leaves_ + k * leaves_step_);
      hn::StoreU(cost, d8, costs_ + k * disparities);
      const hn::Repartition<std::int8_t, D> di8;
      const hn::Rebind<std::int8_t, D> half;
      const auto change = hn::BitCast(di8, hn::Sub(cost, old));
      low = hn::PromoteTo(D(), hn::LowerHalf(half, change));
      high = hn::PromoteTo(D(), hn::UpperHalf(half, change));
    }

   private:
    static HWY_INLINE hn::Vec<Bytes> distance(const Kept<Bytes>& table, const std::uint8_t* right) {
      return hn::TableLookupBytes(table.get(), hn::LoadU(Bytes(), right));
    }

    const CensusCode* left_;
    const std::uint8_t* plane0_;
    const std::uint8_t* plane1_;
    const std::uint8_t* plane2_;
    const std::uint8_t* plane3_;
    std::uint8_t* costs_;
    const std::uint8_t* leaves_;
    std::ptrdiff_t leaves_step_;
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
      hn::Vec<decltype(d)> low;
      hn::Vec<decltype(d)> high;
      hn::LoadInterleaved2(d, reinterpret_cast<const std::uint8_t*>(right + (last - j - 15)), low, high);
      low = hn::TableLookupBytes(low, reverse);
      high = hn::TableLookupBytes(high, reverse);
      std::uint8_t* to = planes + j;
      hn::StoreU(hn::And(low, low_bits), d, to);
      hn::StoreU(hn::ShiftRight<4>(low), d, to + stride);
      hn::StoreU(hn::And(high, low_bits), d, to + 2 * stride);
      hn::StoreU(hn::ShiftRight<4>(high), d, to + 3 * stride);
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
  const std::uint8_t* leaves_ = nullptr;  // the costs that go; none: zeros
  std::ptrdiff_t leaves_step_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();
#endif

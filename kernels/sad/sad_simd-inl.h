// Absolute differences of edges (kernels/sad): the row that enters a window minus the row that leaves it, for columns side
// by side. Both are computed: two operations each, fewer than it takes to store the costs and to load them again later.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hwy/highway.h"
#include "kernels/base/scratch.h"
#include "kernels/block/block_checks.h"
#include "kernels/block/block_rows.h"

#if defined(LAKSHYA_SAD_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LAKSHYA_SAD_SIMD_INL
#undef LAKSHYA_SAD_SIMD_INL
#else
#define LAKSHYA_SAD_SIMD_INL
#endif

#ifndef LAKSHYA_SAD_SIMD_SHARED
#define LAKSHYA_SAD_SIMD_SHARED
namespace lakshya {
inline constexpr int kMaxNarrowEdgeCap = 63;  // differences of edges, and of costs, fit signed bytes
}  // namespace lakshya
#endif

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// kNarrow: the edges are at most 2 kMaxNarrowEdgeCap.
template <class D, bool kNarrow>
class SadDelta {
  using Bytes = hn::Repartition<std::uint8_t, D>;

 public:
  using V = hn::Vec<D>;

  SadDelta(const BlockCall<SadTraits>& call, const SadRows& rows)
      : call_(call), rows_(rows), place_(call.params.range) {
    std::fill(rows.zero.begin(), rows.zero.end(), std::uint8_t{0});
    place_.mark(SadTraits::outside(call.params), rows.inside, rows.outside);
  }

  // Row `enters` comes into the window, row `leaves` goes; -1 for none. `turn` counts the calls.
  void set_rows(int enters, int leaves, int /*turn*/) {
    enters_ = prepare(enters, rows_.enters);
    leaves_ = prepare(leaves, rows_.leaves);
  }

  const ReversedRow& place() const { return place_; }

  // Candidates [i, i + 2 Lanes) of columns from x on, by value: what a vector store may have changed would be loaded again
  // and again. kBorder: some candidates are outside the right image.
  template <bool kBorder>
  class Columns {
   public:
    HWY_INLINE Columns(const SadDelta& s, int x, int i)
        : left_new_(s.enters_.left + x),
          left_old_(s.leaves_.left + x),
          right_new_(s.enters_.right + s.place_.of_column(x) + i),
          right_old_(s.leaves_.right + s.place_.of_column(x) + i),
          inside_(s.rows_.inside.data() + s.place_.of_column(x) + i),
          outside_new_(s.enters_.outside + s.place_.of_column(x) + i),
          outside_old_(s.leaves_.outside + s.place_.of_column(x) + i) {}

    struct Left {
      std::uint32_t enters;
      std::uint32_t leaves;
    };
    HWY_INLINE Left left(std::ptrdiff_t k) const { return {left_new_[k], left_old_[k]}; }

    // Of the k-th column: the first half of the candidates, and the second.
    HWY_INLINE void delta(const Left& left, std::ptrdiff_t k, std::ptrdiff_t /*disparities*/, V& low,
                          V& high) const {
      const D d;
      auto enters = difference(left.enters, right_new_ - k);
      auto leaves = difference(left.leaves, right_old_ - k);
      if (kBorder) {
        const Bytes d8;
        const auto inside = hn::LoadU(d8, inside_ - k);
        enters = hn::Or(hn::And(enters, inside), hn::LoadU(d8, outside_new_ - k));
        leaves = hn::Or(hn::And(leaves, inside), hn::LoadU(d8, outside_old_ - k));
      }
      if (kNarrow) {
        const hn::Rebind<std::int8_t, D> half;
        const auto change = hn::BitCast(hn::Repartition<std::int8_t, D>(), hn::Sub(enters, leaves));
        low = hn::PromoteTo(d, hn::LowerHalf(half, change));
        high = hn::PromoteTo(d, hn::UpperHalf(half, change));
      } else {
        const hn::Rebind<std::uint8_t, D> half;
        low = hn::Sub(hn::PromoteTo(d, hn::LowerHalf(half, enters)), hn::PromoteTo(d, hn::LowerHalf(half, leaves)));
        high =
            hn::Sub(hn::PromoteTo(d, hn::UpperHalf(half, enters)), hn::PromoteTo(d, hn::UpperHalf(half, leaves)));
      }
    }

   private:
    static HWY_INLINE hn::Vec<Bytes> difference(std::uint32_t left, const std::uint8_t* right) {
      const Bytes d8;
      const auto l = hn::BitCast(d8, hn::Set(hn::Repartition<std::uint32_t, D>(), left));
      const auto r = hn::LoadU(d8, right);
      const hn::Repartition<std::int8_t, D> di8;
      if (kNarrow) return hn::BitCast(d8, hn::Abs(hn::BitCast(di8, hn::Sub(l, r))));
      return hn::Sub(hn::Max(l, r), hn::Min(l, r));
    }

    const std::uint32_t* left_new_;
    const std::uint32_t* left_old_;
    const std::uint8_t* right_new_;
    const std::uint8_t* right_old_;
    const std::uint8_t* inside_;
    const std::uint8_t* outside_new_;
    const std::uint8_t* outside_old_;
  };

 private:
  struct Row {
    const std::uint32_t* left;
    const std::uint8_t* right;
    const std::uint8_t* outside;
  };

  Row prepare(int v, const SadRows::Prepared& to) const {
    if (v < 0) return {rows_.zero32(), rows_.zero.data(), rows_.zero.data()};
    const std::uint8_t* left = call_.left.row(v);
    const std::uint8_t* right = call_.right.row(v);
    const SearchRange range = call_.params.range;
    std::uint32_t* HWY_RESTRICT four_times = to.left.data();
    for (int x = range.valid_begin; x < range.valid_end; ++x)
      four_times[x] = left[x] * 0x01010101U;
    std::uint8_t* HWY_RESTRICT target = to.right.data();
    const int last = place_.column_of(0);
    const int end = place_.inside_end;
    for (int j = place_.inside_begin; j < end; ++j)
      target[j] = right[last - j];
    return {to.left.data(), target, rows_.outside.data()};
  }

  const BlockCall<SadTraits>& call_;
  SadRows rows_;
  ReversedRow place_;
  Row enters_{};
  Row leaves_{};
};

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();
#endif

// Absolute differences of edges of one column (kernels/sad): the row that enters a window minus the row that leaves it.
// Both are computed: two operations each, as many as it takes to store the costs and to load them again later.
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

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class D>
class SadDelta {
 public:
  using V = hn::Vec<D>;

  SadDelta(const BlockCall<SadTraits>& call, const SadRows& rows)
      : call_(call), rows_(rows), place_(call.params.range) {
    std::fill(rows.zero.begin(), rows.zero.end(), std::int16_t{0});
    for (std::size_t j = 0; j < rows.inside.size(); ++j) {
      const bool inside = place_.inside(static_cast<int>(j));
      rows.inside[j] = static_cast<std::int16_t>(inside ? -1 : 0);
      rows.outside[j] = inside ? std::int16_t{0} : std::int16_t{SadTraits::outside(call.params)};
    }
  }

  // Row `enters` comes into the window, row `leaves` goes; -1 for none. `turn` counts the calls.
  void set_rows(int enters, int leaves, int /*turn*/) {
    enters_ = prepare(enters, rows_.enters);
    leaves_ = prepare(leaves, rows_.leaves);
  }

  bool border(int x) const { return place_.border(x); }

  // Of one column, by value: what a vector store may have changed would be loaded again and again.
  template <bool kBorder>
  class Column {
   public:
    HWY_INLINE Column(const SadDelta& s, int x)
        : left_new_(twice(s.enters_.left[x])),
          left_old_(twice(s.leaves_.left[x])),
          right_new_(s.enters_.right + s.place_.of_column(x)),
          right_old_(s.leaves_.right + s.place_.of_column(x)),
          inside_(s.rows_.inside.data() + s.place_.of_column(x)),
          outside_new_(s.enters_.outside + s.place_.of_column(x)),
          outside_old_(s.leaves_.outside + s.place_.of_column(x)) {}

    // Candidates [i, i + Lanes) and the next Lanes.
    HWY_INLINE void delta(int i, V& low, V& high) const {
      low = one(i);
      high = one(i + static_cast<int>(hn::Lanes(D())));
    }

   private:
    static HWY_INLINE V twice(std::uint32_t left) {
      const hn::Repartition<std::uint32_t, D> d32;
      return hn::BitCast(D(), hn::Set(d32, left));
    }

    HWY_INLINE V one(int i) const {
      const D d;
      V enters = hn::Abs(hn::Sub(left_new_, hn::LoadU(d, right_new_ + i)));
      V leaves = hn::Abs(hn::Sub(left_old_, hn::LoadU(d, right_old_ + i)));
      if (kBorder) {
        const V inside = hn::LoadU(d, inside_ + i);
        enters = hn::Or(hn::And(enters, inside), hn::LoadU(d, outside_new_ + i));
        leaves = hn::Or(hn::And(leaves, inside), hn::LoadU(d, outside_old_ + i));
      }
      return hn::Sub(enters, leaves);
    }

    V left_new_;
    V left_old_;
    const std::int16_t* right_new_;
    const std::int16_t* right_old_;
    const std::int16_t* inside_;
    const std::int16_t* outside_new_;
    const std::int16_t* outside_old_;
  };

 private:
  struct Row {
    const std::uint32_t* left;  // twice the same 16 bits
    const std::int16_t* right;
    const std::int16_t* outside;
  };

  Row prepare(int v, const SadRows::Prepared& to) const {
    if (v < 0) return {rows_.zero32(), rows_.zero.data(), rows_.zero.data()};
    const std::uint8_t* left = call_.left.row(v);
    const std::uint8_t* right = call_.right.row(v);
    const SearchRange range = call_.params.range;
    std::uint32_t* HWY_RESTRICT twice = to.left.data();
    for (int x = range.valid_begin; x < range.valid_end; ++x)
      twice[x] = left[x] * 0x10001U;
    std::int16_t* HWY_RESTRICT target = to.right.data();
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

// The window matchers' sums: columns of the window's rows, and the window that slides over them.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hwy/highway.h"
#include "kernels/base/scratch.h"
#include "kernels/block/block.h"
#include "kernels/block/block_rows.h"
#include "kernels/select/select_simd-inl.h"

#if defined(LAKSHYA_BLOCK_SUMS_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LAKSHYA_BLOCK_SUMS_SIMD_INL
#undef LAKSHYA_BLOCK_SUMS_SIMD_INL
#else
#define LAKSHYA_BLOCK_SUMS_SIMD_INL
#endif

#ifndef LAKSHYA_BLOCK_SUMS_SIMD_SHARED
#define LAKSHYA_BLOCK_SUMS_SIMD_SHARED
namespace lakshya {

// What one band keeps.
struct BlockSimdRows {
  std::span<std::int16_t> columns;  // costs of the window's rows added up, per column
  std::span<std::int16_t> zero;     // a column of no rows
  std::span<std::int16_t> ordinal;  // what a column starts with, so that sums come out with their pixel's ordinal
  SelectRows select;

  static BlockSimdRows lay_out(int width, int disparities, ScratchLayout& scratch) {
    const auto columns = static_cast<std::size_t>(width);
    const auto candidates = static_cast<std::size_t>(disparities);
    BlockSimdRows r;
    r.columns = scratch.take<std::int16_t>(columns * candidates);
    r.zero = scratch.take<std::int16_t>(candidates);
    r.ordinal = scratch.take<std::int16_t>(columns + kMaxBlockRadius);
    r.select.sums = scratch.take<std::int16_t>(2 * kMaxSumLanes +
                                               static_cast<std::size_t>(sum_slots(disparities)) *
                                                   static_cast<std::size_t>(sum_stride(disparities, kMaxSumLanes)));
    r.select.first = scratch.take<std::int16_t>(columns + kMaxSumLanes);
    r.select.last = scratch.take<std::int16_t>(columns + kMaxSumLanes);
    r.select.near = scratch.take<std::int16_t>(kNearSums * (columns + kMaxSumLanes));
    r.select.right = scratch.take<std::int16_t>(columns + kMaxSumLanes + 3);
    return r;
  }
};

}  // namespace lakshya
#endif

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// What a column's costs are added to.
enum class Enters { nothing, border, whole };

// Delta: the costs, of what enters minus what leaves.
// kDisparities: their number, if it is a usual one, for loops of a constant length; or 0.
// kBits: kOrdinalBits, or 0.
template <class D, class Delta, int kDisparities, int kBits>
class WindowSums {
 public:
  WindowSums(const SearchRange& range, int radius, const BlockSimdRows& rows, const Delta& delta)
      : range_(range), radius_(radius), rows_(rows), delta_(delta) {
    start_columns();
    std::fill(rows.zero.begin(), rows.zero.end(), std::int16_t{0});
    std::fill(rows.select.sums.begin(), rows.select.sums.end(), kSumPadding);
  }

  static int ordinal(int u) { return u & ((1 << kBits) - 1); }

  // All columns by the rows that enter and leave.
  void advance_columns() const {
    for (int x = range_.valid_begin; x < range_.valid_end;) {
      const int end = alike_end(x);
      if (kind(x) == Enters::whole) {
        advance<false>(x, end - x);
      } else {
        advance<true>(x, end - x);
      }
      x = end;
    }
  }

  // Sums of pixels [u, end), from slot `slot` on, and the smallest of each.
  void slide_to(int u, int end, int slot, std::int32_t* smallest) const {
    alignas(64) std::int16_t least[kPixelsPerStep * kMaxSumLanes];
    const int radius = radius_;
    const int slots = sum_slots(range_.disparities);
    const std::int16_t* before = rows_.select.slot(range_.disparities, slot == 0 ? slots - 1 : slot - 1);
    while (u < end) {
      const int x = u + radius;
      const int leaves = u - radius - 1;
      const bool leaves_any = leaves >= range_.valid_begin;
      int stop = std::min(end, leaves_any ? end : range_.valid_begin + radius + 1);
      const Enters enters = kind(x);
      if (enters != Enters::nothing) stop = std::min(stop, alike_end(x) - radius);
      std::int16_t* sums = rows_.select.slot(range_.disparities, slot);
      const Run run{
          x,    stop - u, before, leaves_any ? column(leaves) : rows_.zero.data(), leaves_any ? disparities() : 0,
          sums, smallest, least};
      switch (enters) {
        case Enters::nothing:
          slide_all<Enters::nothing>(run);
          break;
        case Enters::border:
          slide_all<Enters::border>(run);
          break;
        case Enters::whole:
          slide_all<Enters::whole>(run);
          break;
      }
      slot += stop - u;
      smallest += stop - u;
      before = rows_.select.slot(range_.disparities, slot - 1);
      u = stop;
    }
  }

 private:
  using V = hn::Vec<D>;

  // Pairs of vectors that are dealt with at once, as many as there are registers for; and whether those are all.
  static constexpr int kPairs = kDisparities == 64 && hn::MaxLanes(D()) <= 16 ? 2 : 1;
#if HWY_HAVE_SCALABLE
  static constexpr bool kOnce = false;  // vectors may be shorter than MaxLanes
#else
  static constexpr bool kOnce = kDisparities == 2 * kPairs * static_cast<int>(hn::MaxLanes(D()));
#endif

  // Pixels side by side whose windows change alike.
  struct Run {
    int x;                       // the column that enters the first one's window
    int count;                   // pixels
    const std::int16_t* before;  // sums of the pixel before the first one
    const std::int16_t* leaves;  // the column that leaves the first one's window
    std::ptrdiff_t leaves_step;
    std::int16_t* sums;      // of the first
    std::int32_t* smallest;  // the least sum of a pixel
    std::int16_t* least;     // and before it is that, the least per lane, for all pixels
  };

  int disparities() const {
    return kDisparities != 0 ? kDisparities : range_.disparities;
  }
  // What enters with a column less what leaves with another takes the sums from one pixel's ordinal to the next one's. The
  // columns of the first pixel's window but its last have none, for sums that start with the ordinal of the pixel before.
  void start_columns() const {
    const int diameter = 2 * radius_ + 1;
    const int end = range_.valid_end - range_.valid_begin + radius_;
    std::int16_t* ordinals = rows_.ordinal.data() + range_.valid_begin;
    for (int x = 0; x < end; ++x) {
      const int u = x - radius_;
      const int left = x < diameter ? 0 : ordinals[x - diameter];
      ordinals[x] = static_cast<std::int16_t>(u < 0 ? 0 : left + ordinal(u) - ordinal(u - 1));
    }
    for (int x = range_.valid_begin; x < range_.valid_end; ++x)
      std::fill_n(column(x), disparities(), rows_.ordinal[static_cast<std::size_t>(x)]);
  }

  static HWY_INLINE V scaled(V v) {
    return kBits == 0 ? v : hn::ShiftLeft<kBits>(v);
  }

  std::int16_t* column(int x) const {
    return rows_.columns.data() + static_cast<std::ptrdiff_t>(x) * disparities();
  }

  // The first column after x of another kind.
  int alike_end(int x) const {
    const ReversedRow& place = delta_.place();
    const int begin = place.whole_begin();
    const int end = place.whole_end();
    if (begin >= end || x >= end) return range_.valid_end;
    return std::min(x < begin ? begin : end, range_.valid_end);
  }
  Enters kind(int x) const {
    const ReversedRow& place = delta_.place();
    if (x >= range_.valid_end) return Enters::nothing;
    return x >= place.whole_begin() && x < place.whole_end() ? Enters::whole : Enters::border;
  }

  template <bool kBorder>
  void advance(int x, int count) const {
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const std::ptrdiff_t disparities = this->disparities();
    for (int i = 0; i < disparities; i += 2 * lanes) {
      const typename Delta::template Columns<kBorder> costs(delta_, x, i);
      std::int16_t* sums = column(x) + i;
      for (int k = 0; k < count; ++k, sums += disparities) {
        V low;
        V high;
        costs.delta(costs.left(k), k, disparities, low, high);
        hn::StoreU(hn::Add(hn::LoadU(d, sums), scaled(low)), d, sums);
        hn::StoreU(hn::Add(hn::LoadU(d, sums + lanes), scaled(high)), d, sums + lanes);
      }
    }
  }

  // Two vectors of candidates of the k-th pixel: their window slides by one, and the column that enters advances first.
  template <Enters kEnters, class Costs>
  static HWY_INLINE void slide_pair(const Costs& costs, const typename Costs::Left& left, std::ptrdiff_t k,
                                    std::ptrdiff_t disparities, const std::int16_t* leaves, std::int16_t* enters,
                                    const std::int16_t* ordinal, std::int16_t* to, V& low, V& high) {
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    low = hn::Sub(low, hn::LoadU(d, leaves));
    high = hn::Sub(high, hn::LoadU(d, leaves + lanes));
    if (kEnters != Enters::nothing) {
      V column_low;
      V column_high;
      costs.delta(left, k, disparities, column_low, column_high);
      column_low = hn::Add(scaled(column_low), hn::LoadU(d, enters));
      column_high = hn::Add(scaled(column_high), hn::LoadU(d, enters + lanes));
      hn::StoreU(column_low, d, enters);
      hn::StoreU(column_high, d, enters + lanes);
      low = hn::Add(low, column_low);
      high = hn::Add(high, column_high);
    } else if (kBits != 0) {
      low = hn::Add(low, hn::Set(d, *ordinal));
      high = hn::Add(high, hn::Set(d, *ordinal));
    }
    hn::StoreU(low, d, to);
    hn::StoreU(high, d, to + lanes);
  }

  // kPairs x 2 vectors of candidates, from i on, stay in registers from pixel to pixel.
  template <Enters kEnters>
  HWY_INLINE void slide(const Run& run, int i) const {
    using Costs = typename Delta::template Columns<kEnters == Enters::border>;
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const std::ptrdiff_t disparities = this->disparities();
    const std::ptrdiff_t stride = sum_stride(this->disparities(), lanes);
    const std::ptrdiff_t leaves_step = run.leaves_step;
    const int count = run.count;
    const int second = kPairs == 2 ? 2 * lanes : 0;
    const int x = kEnters == Enters::nothing ? range_.valid_begin : run.x;
    const Costs costs(delta_, x, i);
    const Costs costs2(delta_, x, i + second);
    std::int16_t* enters = column(x) + i;
    const std::int16_t* leaves = run.leaves + i;
    const std::int16_t* ordinal = rows_.ordinal.data() + run.x;
    std::int16_t* to = run.sums + i;
    std::int16_t* least = run.least;
    std::int32_t* smallest = run.smallest;
    V low = hn::LoadU(d, run.before + i);
    V high = hn::LoadU(d, run.before + i + lanes);
    V low2 = hn::LoadU(d, run.before + i + second);
    V high2 = hn::LoadU(d, run.before + i + second + lanes);
    for (int k = 0; k < count; ++k) {
      const auto left = costs.left(kEnters == Enters::nothing ? 0 : k);
      slide_pair<kEnters>(costs, left, k, disparities, leaves, enters, ordinal + k, to, low, high);
      V lowest = hn::Min(low, high);
      if (kPairs == 2) {
        slide_pair<kEnters>(costs2, left, k, disparities, leaves + second, enters + second, ordinal + k,
                            to + second, low2, high2);
        lowest = hn::Min(lowest, hn::Min(low2, high2));
      }
      if (kOnce) {
        *smallest++ = least_sum(d, lowest);
      } else {
        hn::StoreU(hn::Min(lowest, hn::LoadU(d, least)), d, least);
        least += lanes;
      }
      enters += disparities;
      leaves += leaves_step;
      to += stride;
    }
  }

  template <Enters kEnters>
  void slide_all(const Run& run) const {
    if (kOnce) return slide<kEnters>(run, 0);
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    std::fill_n(run.least, run.count * lanes, kSumPadding);
    for (int i = 0; i < disparities(); i += kPairs * 2 * lanes)
      slide<kEnters>(run, i);
    for (int k = 0; k < run.count; ++k)
      run.smallest[k] = least_sum(d, hn::LoadU(d, run.least + k * lanes));
  }

  SearchRange range_;
  int radius_;
  BlockSimdRows rows_;
  const Delta& delta_;
};

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();
#endif

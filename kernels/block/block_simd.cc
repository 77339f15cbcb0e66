// Row by row: the column sums advance by the row that enters the window minus the row that leaves it, the window slides
// over them, and the sums of a few pixels at a time go through selection while they are in the first cache.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/block/block_simd.cc"
#include "hwy/foreach_target.h"
// foreach_target.h comes first, whatever the alphabet says.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/scratch.h"
#include "kernels/base/units.h"
#include "kernels/block/block.h"
#include "kernels/block/block_checks.h"
#include "kernels/block/block_rows.h"
#include "kernels/hamming/hamming_simd-inl.h"
#include "kernels/sad/sad_simd-inl.h"
#include "kernels/select/select_simd-inl.h"

#ifndef LAKSHYA_BLOCK_SIMD
#define LAKSHYA_BLOCK_SIMD
namespace lakshya {

// What one band keeps.
struct BlockSimdRows {
  std::span<std::int16_t> columns;  // costs of the window's rows added up, per column
  std::span<std::int16_t> zero;     // a column of no rows
  std::span<std::int16_t> before;   // sums of the pixel before the first valid one
  SelectRows select;

  static BlockSimdRows lay_out(int width, int disparities, ScratchLayout& scratch) {
    const auto columns = static_cast<std::size_t>(width);
    const auto candidates = static_cast<std::size_t>(disparities);
    BlockSimdRows r;
    r.columns = scratch.take<std::int16_t>(columns * candidates);
    r.zero = scratch.take<std::int16_t>(candidates);
    r.before = scratch.take<std::int16_t>(candidates);
    r.select.sums = scratch.take<std::int16_t>(static_cast<std::size_t>(sum_slots(disparities)) *
                                               static_cast<std::size_t>(sum_stride(disparities, kMaxSumLanes)));
    r.select.best = scratch.take<std::int16_t>(columns);
    r.select.fraction = scratch.take<std::int16_t>(columns);
    r.select.right = scratch.take<std::int16_t>(columns + kMaxSumLanes + 2);
    return r;
  }
};

}  // namespace lakshya
#endif

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Delta: the costs, of what enters minus what leaves.
// kDisparities: their number, if it is a usual one, for loops of a constant length; or 0.
template <class D, class Delta, class Traits, int kDisparities>
class Band {
 public:
  Band(const BlockCall<Traits>& call, const BlockSimdRows& rows, Delta& delta)
      : c_(call),
        range_(call.params.range),
        rows_(rows),
        delta_(delta),
        select_(range_, call.params.select, rows.select) {
    std::fill(rows.columns.begin(), rows.columns.end(), std::int16_t{0});
    std::fill(rows.zero.begin(), rows.zero.end(), std::int16_t{0});
    std::fill(rows.select.sums.begin(), rows.select.sums.end(), kSumPadding);
  }

  void run(Rows matched) {
    const int radius = c_.params.radius_v;
    const Rows& described = c_.descriptor_rows;
    const int top = std::max(described.begin, matched.begin - radius);
    for (int below = top; below < matched.end + radius; ++below) {
      const int leaves = below - window_rows(radius);
      delta_.set_rows(below < described.end ? below : -1, leaves >= top ? leaves : -1, below - top);
      const int v = below - radius;
      if (v < matched.begin) {
        advance_columns();
      } else {
        match_row(v);
      }
    }
  }

 private:
  using V = hn::Vec<D>;

  int disparities() const { return kDisparities != 0 ? kDisparities : range_.disparities; }

  std::int16_t* column(int x) const {
    return rows_.columns.data() + static_cast<std::ptrdiff_t>(x) * disparities();
  }

  template <bool kBorder>
  HWY_INLINE void advance_column(int x) {
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const int disparities = this->disparities();
    std::int16_t* HWY_RESTRICT sums = column(x);
    const typename Delta::template Column<kBorder> delta(delta_, x);
    for (int i = 0; i < disparities; i += 2 * lanes) {
      V low;
      V high;
      delta.delta(i, low, high);
      hn::StoreU(hn::Add(hn::LoadU(d, sums + i), low), d, sums + i);
      hn::StoreU(hn::Add(hn::LoadU(d, sums + i + lanes), high), d, sums + i + lanes);
    }
  }

  void advance_columns() {
    for (int x = range_.valid_begin; x < range_.valid_end; ++x) {
      if (delta_.border(x)) {
        advance_column<true>(x);
      } else {
        advance_column<false>(x);
      }
    }
  }

  // to = from - the column that leaves. Returns the least, per lane.
  HWY_INLINE V slide(const std::int16_t* from, const std::int16_t* leaves, std::int16_t* to) {
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const int disparities = this->disparities();
    V least = hn::Set(d, kSumPadding);
    for (int i = 0; i < disparities; i += lanes) {
      const V sum = hn::Sub(hn::LoadU(d, from + i), hn::LoadU(d, leaves + i));
      hn::StoreU(sum, d, to + i);
      least = hn::Min(least, sum);
    }
    return least;
  }

  // And + column x, which is advanced first.
  template <bool kBorder>
  HWY_INLINE V slide_and_advance(const std::int16_t* from, int x, const std::int16_t* leaves, std::int16_t* to) {
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const int disparities = this->disparities();
    std::int16_t* enters = column(x);
    const typename Delta::template Column<kBorder> delta(delta_, x);
    V least_low = hn::Set(d, kSumPadding);
    V least_high = least_low;
    for (int i = 0; i < disparities; i += 2 * lanes) {
      V low;
      V high;
      delta.delta(i, low, high);
      low = hn::Add(low, hn::LoadU(d, enters + i));
      high = hn::Add(high, hn::LoadU(d, enters + i + lanes));
      hn::StoreU(low, d, enters + i);
      hn::StoreU(high, d, enters + i + lanes);
      low = hn::Add(low, hn::Sub(hn::LoadU(d, from + i), hn::LoadU(d, leaves + i)));
      high = hn::Add(high, hn::Sub(hn::LoadU(d, from + i + lanes), hn::LoadU(d, leaves + i + lanes)));
      hn::StoreU(low, d, to + i);
      hn::StoreU(high, d, to + i + lanes);
      least_low = hn::Min(least_low, low);
      least_high = hn::Min(least_high, high);
    }
    return hn::Min(least_low, least_high);
  }

  // The window of pixel u from that of u - 1.
  HWY_INLINE V slide_to(int u, const std::int16_t* from, std::int16_t* to) {
    const int radius = c_.params.radius_u;
    const int x = u + radius;
    const int left = u - radius - 1;
    const std::int16_t* leaves = left >= range_.valid_begin ? column(left) : rows_.zero.data();
    if (x >= range_.valid_end) return slide(from, leaves, to);
    if (delta_.border(x)) return slide_and_advance<true>(from, x, leaves, to);
    return slide_and_advance<false>(from, x, leaves, to);
  }

  static int least_of(V least) {
    const hn::RebindToUnsigned<D> du;
    // There is no least of signed lanes on every instruction set.
    const auto unsigned_least = hn::Xor(hn::BitCast(du, least), hn::Set(du, std::uint16_t{kSumBias}));
    return static_cast<int>(hn::GetLane(hn::MinOfLanes(du, unsigned_least))) - kSumBias;
  }

  std::array<std::int16_t*, kPixelsPerStep> slots_from(int u, int stop) const {
    std::array<std::int16_t*, kPixelsPerStep> slots{};
    const int count = sum_slots(range_.disparities);
    int index = (u - range_.valid_begin) % count;
    for (int k = 0; k < stop - u; ++k) {
      slots[static_cast<std::size_t>(k)] = rows_.select.slot(range_.disparities, index);
      index = index + 1 == count ? 0 : index + 1;
    }
    return slots;
  }

  // Of the pixels of one step.
  using Slots = std::array<std::int16_t*, kPixelsPerStep>;
  using Least = std::array<std::int16_t, kPixelsPerStep>;

  template <bool kInside>
  void select_step(int begin, int end, const Slots& slots, const Least& least, const std::uint8_t* textured,
                   std::int16_t* disparity) const {
    const D d;
    for (int u = begin; u < end; ++u) {
      const auto k = static_cast<std::size_t>(u - begin);
      if (textured[u] != 0) {
        disparity[u] = select_.template select_left<kInside>(d, disparities(), u, slots[k], least[k]);
      } else {
        disparity[u] = kLowTexture;
        rows_.select.best[static_cast<std::size_t>(u)] = -1;
      }
    }
  }

  void match_row(int v) {
    const std::span<std::int16_t> disparity = row_span(c_.disparity, v);
    std::fill(disparity.begin(), disparity.end(), std::int16_t{kNotSearched});
    std::int16_t* before = rows_.before.data();
    std::fill(rows_.before.begin(), rows_.before.end(), static_cast<std::int16_t>(-kSumBias));
    // Columns of the first window but its last.
    const int end = std::min(range_.valid_begin + c_.params.radius_u, range_.valid_end);
    for (int x = range_.valid_begin; x < end; ++x)
      slide_to(x - c_.params.radius_u, before, before);

    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const std::uint8_t* textured = c_.textured.row(v);
    std::array<std::int16_t, kPixelsPerStep> least;
    int right = range_.valid_begin;
    const std::int16_t* from = before;
    for (int u = range_.valid_begin; u < range_.valid_end; u += kPixelsPerStep) {
      const int stop = std::min(u + kPixelsPerStep, range_.valid_end);
      const std::array<std::int16_t*, kPixelsPerStep> slots = slots_from(u, stop);
      for (int x = u; x < stop; ++x) {
        std::int16_t* to = slots[static_cast<std::size_t>(x - u)];
        least[static_cast<std::size_t>(x - u)] = static_cast<std::int16_t>(least_of(slide_to(x, from, to)));
        from = to;
      }
      if (select_.inside(u) && select_.inside(stop - 1)) {
        select_step<true>(u, stop, slots, least, textured, disparity.data());
      } else {
        select_step<false>(u, stop, slots, least, textured, disparity.data());
      }
      if (c_.params.select.left_right_max < 0) continue;
      for (; right < range_.valid_end; right += lanes) {
        const int last = right + lanes - 1 + range_.first + range_.disparities - 1;
        if (last >= stop && stop < range_.valid_end) break;
        select_.select_right(d, right);
      }
    }
    select_.finish(disparity);
  }

  const BlockCall<Traits>& c_;
  SearchRange range_;
  BlockSimdRows rows_;
  Delta& delta_;
  Selection select_;
};

template <class D, template <class> class Delta, class Traits, class CostRows>
void match_rows(const BlockCall<Traits>& call, const Rows& matched, const BlockSimdRows& rows,
                const CostRows& cost_rows) {
  BlockSimdRows kept = rows;
  kept.select.lanes = static_cast<int>(hn::Lanes(D()));
  Delta<D> delta(call, cost_rows);
  if (call.params.range.disparities == 64) return Band<D, Delta<D>, Traits, 64>(call, kept, delta).run(matched);
  Band<D, Delta<D>, Traits, 0>(call, kept, delta).run(matched);
}

// With the longest vectors that divide the candidates.
template <template <class> class Delta, class Traits, class CostRows>
void match_band(const BlockCall<Traits>& call, const Rows& matched, const BlockSimdRows& rows,
                const CostRows& cost_rows) {
  const int disparities = call.params.range.disparities;
  if (disparities % 64 == 0) {
    match_rows<hn::CappedTag<std::int16_t, 32>, Delta>(call, matched, rows, cost_rows);
  } else if (disparities % 32 == 0) {
    match_rows<hn::CappedTag<std::int16_t, 16>, Delta>(call, matched, rows, cost_rows);
  } else {
    match_rows<hn::CappedTag<std::int16_t, 8>, Delta>(call, matched, rows, cost_rows);
  }
}

void sad_band(const BlockCall<SadTraits>& call, const Rows& matched, const BlockSimdRows& rows,
              const SadRows& sad) {
  match_band<SadDelta>(call, matched, rows, sad);
}

void census_band(const BlockCall<CensusTraits>& call, const Rows& matched, const BlockSimdRows& rows,
                 const CensusRows& census) {
  match_band<HammingDelta>(call, matched, rows, census);
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lakshya {

HWY_EXPORT(sad_band);
HWY_EXPORT(census_band);

namespace {

bool select_params_ok(const BlockParams& p) {
  return p.select.uniqueness_percent >= 0 && p.select.uniqueness_percent <= 99 &&
         kDisparityScale * p.range.first + p.select.offset16 >= 0;
}

template <class Traits, class Match>
Status block_match(const BlockCall<Traits>& call, const Match& match) {
  const Status status = check(call);
  if (status != Status::ok) return status;
  const Rows matched = blank_rows_without_descriptors(call);
  if (matched.begin >= matched.end) return Status::ok;
  if (!select_params_ok(call.params)) return Status::bad_argument;
  ScratchLayout layout(call.scratch.data());
  const BlockSimdRows rows = BlockSimdRows::lay_out(call.left.width, call.params.range.disparities, layout);
  match(matched, rows, layout);
  return Status::ok;
}

}  // namespace

std::size_t block_simd_scratch_bytes(int width, int disparities, int radius_v) {
  ScratchLayout sad;
  BlockSimdRows::lay_out(width, disparities, sad);
  ScratchLayout census = sad;
  SadRows::lay_out(width, disparities, sad);
  CensusRows::lay_out(width, disparities, radius_v, census);
  return std::max(sad.used(), census.used());
}

Status census_block_simd(ImageView<const CensusCode> left, ImageView<const CensusCode> right,
                         ImageView<const std::uint8_t> textured, Rows descriptor_rows, const BlockParams& params,
                         Rows rows, std::span<std::byte> scratch, ImageView<std::int16_t> disparity) {
  const BlockCall<CensusTraits> call{left, right, textured, descriptor_rows, params, rows, scratch, disparity};
  return block_match(call, [&](const Rows& matched, const BlockSimdRows& kept, ScratchLayout& layout) {
    const int disparities = params.range.disparities;
    HWY_DYNAMIC_DISPATCH(census_band)
    (call, matched, kept, CensusRows::lay_out(left.width, disparities, params.radius_v, layout));
  });
}

Status sad_block_simd(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                      ImageView<const std::uint8_t> textured, Rows descriptor_rows, const BlockParams& params,
                      Rows rows, std::span<std::byte> scratch, ImageView<std::int16_t> disparity) {
  const BlockCall<SadTraits> call{left, right, textured, descriptor_rows, params, rows, scratch, disparity};
  return block_match(call, [&](const Rows& matched, const BlockSimdRows& kept, ScratchLayout& layout) {
    HWY_DYNAMIC_DISPATCH(sad_band)
    (call, matched, kept, SadRows::lay_out(left.width, params.range.disparities, layout));
  });
}

}  // namespace lakshya
#endif

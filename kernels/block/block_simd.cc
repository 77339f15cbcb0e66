// Row by row: the column sums advance by the row that enters the window minus the row that leaves it, the window slides
// over them, and the sums of a few pixels at a time go through selection while they are in the first cache.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/block/block_simd.cc"
#include "hwy/foreach_target.h"
// foreach_target.h comes first, whatever the alphabet says.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/scratch.h"
#include "kernels/base/units.h"
#include "kernels/block/block.h"
#include "kernels/block/block_checks.h"
#include "kernels/block/block_rows.h"
#include "kernels/block/block_sums_simd-inl.h"
#include "kernels/hamming/hamming_simd-inl.h"
#include "kernels/sad/sad_simd-inl.h"
#include "kernels/select/select_finish_simd-inl.h"
#include "kernels/select/select_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Delta, kDisparities, kBits: as in WindowSums.
template <class D, class Delta, class Traits, int kDisparities, int kBits>
class Band {
 public:
  Band(const BlockCall<Traits>& call, const BlockSimdRows& rows, Delta& delta)
      : c_(call),
        range_(call.params.range),
        rows_(rows),
        delta_(delta),
        sums_(range_, call.params.radius_u, rows, delta),
        select_(range_, call.params.select, rows.select),
        finish_(range_, call.params.select, rows.select, 1 << kBits) {}

  void run(Rows matched) {
    const int radius = c_.params.radius_v;
    const Rows& described = c_.descriptor_rows;
    const int top = std::max(described.begin, matched.begin - radius);
    for (int below = top; below < matched.end + radius; ++below) {
      const int leaves = below - window_rows(radius);
      delta_.set_rows(below < described.end ? below : -1, leaves >= top ? leaves : -1, below - top);
      const int v = below - radius;
      if (v < matched.begin) {
        sums_.advance_columns();
      } else {
        match_row(v);
      }
    }
  }

 private:
  using Sums = WindowSums<D, Delta, kDisparities, kBits>;

  void match_row(int v) const {
    const std::span<std::int16_t> disparity = row_span(c_.disparity, v);
    std::fill_n(disparity.begin(), range_.valid_begin, std::int16_t{kNotSearched});
    std::fill(disparity.begin() + range_.valid_end, disparity.end(), std::int16_t{kNotSearched});
    if (range_.valid_begin == range_.valid_end) return;
    const int lanes = static_cast<int>(hn::Lanes(D()));
    const int radius = c_.params.radius_u;
    const int slots = sum_slots(range_.disparities);
    alignas(64) std::int32_t smallest[kPixelsPerStep] = {};
    // Columns of the first window but its last: as if there were pixels before the first one.
    std::fill_n(rows_.select.slot(range_.disparities, slots - radius - 1), range_.disparities,
                static_cast<std::int16_t>(Sums::ordinal(-1) - kSumBias));
    sums_.slide_to(range_.valid_begin - radius, range_.valid_begin, slots - radius, smallest);

    int right = range_.valid_begin;
    int slot = 0;
    for (int u = range_.valid_begin; u < range_.valid_end;
         u += kPixelsPerStep, slot = (slot + kPixelsPerStep) % slots) {
      const int stop = std::min(u + kPixelsPerStep, range_.valid_end);
      sums_.slide_to(u, stop, slot, smallest);
      select_.select_left(u, stop, rows_.select.slot(range_.disparities, slot), smallest);
      if (c_.params.select.left_right_max < 0) continue;
      // No sums of earlier rows in the last group.
      for (int k = stop - u; k % (1 << kBits) != 0; ++k)
        std::fill_n(rows_.select.slot(range_.disparities, slot + k), range_.disparities, kSumPadding);
      for (; right < range_.valid_end; right += lanes) {
        const int last = right + lanes - 1 + range_.first + range_.disparities - 1;
        if (last >= stop && stop < range_.valid_end) break;
        select_.select_right(right);
      }
    }
    finish_.row(c_.textured.row(v), disparity.data());
  }

  const BlockCall<Traits>& c_;
  SearchRange range_;
  BlockSimdRows rows_;
  Delta& delta_;
  Sums sums_;
  Selection<D, kDisparities, kBits> select_;
  Finish finish_;
};

template <class D, int kDisparities, int kBits, template <class> class Delta, class Traits, class CostRows>
void match_rows(const BlockCall<Traits>& call, const Rows& matched, const BlockSimdRows& rows,
                const CostRows& cost_rows) {
  BlockSimdRows kept = rows;
  kept.select.lanes = static_cast<int>(hn::Lanes(D()));
  Delta<D> delta(call, cost_rows);
  Band<D, Delta<D>, Traits, kDisparities, kBits>(call, kept, delta).run(matched);
}

// With the longest vectors that divide the candidates.
template <template <class> class Delta, class Traits, class CostRows>
void match_band(const BlockCall<Traits>& call, const Rows& matched, const BlockSimdRows& rows,
                const CostRows& cost_rows) {
  const int disparities = call.params.range.disparities;
  const int pixels = (2 * call.params.radius_u + 1) * window_rows(call.params.radius_v);
  if (pixels * Traits::largest(call.params) >= 65536 / kOrdinals - 1) {
    // Large windows, which are rare, need no second form of everything.
    match_rows<hn::CappedTag<std::int16_t, 8>, 0, 0, Delta>(call, matched, rows, cost_rows);
  } else if (disparities == 64) {
    match_rows<hn::CappedTag<std::int16_t, 32>, 64, kOrdinalBits, Delta>(call, matched, rows, cost_rows);
  } else if (disparities % 64 == 0) {
    match_rows<hn::CappedTag<std::int16_t, 32>, 0, kOrdinalBits, Delta>(call, matched, rows, cost_rows);
  } else if (disparities % 32 == 0) {
    match_rows<hn::CappedTag<std::int16_t, 16>, 0, kOrdinalBits, Delta>(call, matched, rows, cost_rows);
  } else {
    match_rows<hn::CappedTag<std::int16_t, 8>, 0, kOrdinalBits, Delta>(call, matched, rows, cost_rows);
  }
}

template <class D>
using NarrowSadDelta = SadDelta<D, true>;
template <class D>
using WideSadDelta = SadDelta<D, false>;

void sad_band(const BlockCall<SadTraits>& call, const Rows& matched, const BlockSimdRows& rows,
              const SadRows& sad) {
  if (call.params.edge_cap <= kMaxNarrowEdgeCap) return match_band<NarrowSadDelta>(call, matched, rows, sad);
  match_band<WideSadDelta>(call, matched, rows, sad);
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

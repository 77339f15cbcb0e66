// Which entry of the histogram each pixel counts in comes from 16-bit lanes; the counting itself is scalar, into four
// histograms in turn, since a floor's pixels fall into the same few entries one after the other.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/ground/ground_simd.cc"
#include "hwy/foreach_target.h"
// foreach_target.h comes first, whatever the alphabet says.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hwy/highway.h"
#include "kernels/base/units.h"
#include "kernels/ground/ground.h"
#include "kernels/prune/row_line.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D16 = hn::ScalableTag<std::int16_t>;
using D32 = hn::ScalableTag<std::int32_t>;

constexpr int kEntries = 2 * kGroundReach + 1;
constexpr std::uint16_t kNowhere = kEntries;  // what does not count
constexpr std::int16_t kNever = std::numeric_limits<std::int16_t>::min();
constexpr int kPiece = 256;
constexpr int kRoom = kPiece + static_cast<int>(HWY_MAX_BYTES) / 2;

struct Tables {
  std::uint32_t entries[4][kEntries + 1] = {};
};

std::int16_t saturated(std::int64_t x) {
  return static_cast<std::int16_t>(std::clamp<std::int64_t>(x, kNever, std::numeric_limits<std::int16_t>::max()));
}

// What leads from d to its entry: ((d << 12) - floor + 2^11) >> 12 = d + ((2^11 - floor) >> 12), and the middle of the
// histogram. Saturated to 16 bits it leads outside for every d that it should.
std::int16_t offset_of_row(const PruneModel& m, std::int64_t floor) {
  if (floor < m.min_disparity || floor > m.max_floor_disparity) return kNever;
  return saturated((((1 << (kDisparityToQ16 - 1)) - floor) >> kDisparityToQ16) + kGroundReach);
}

// For every column of a piece, of a camera that rolls.
void fill_offsets(const PruneModel& m, const RowLine& line, int begin, int count, std::int16_t* offsets) {
  const D32 d;
  const hn::Rebind<std::int16_t, D32> half;
  const auto lowest = hn::Set(d, static_cast<std::int32_t>(m.min_disparity));
  const auto highest = hn::Set(d, static_cast<std::int32_t>(m.max_floor_disparity));
  const auto round = hn::Set(d, 1 << (kDisparityToQ16 - 1));
  const auto middle = hn::Set(d, kGroundReach);
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
    const auto u = hn::Add(hn::Iota(d, 0), hn::Set(d, begin + i));
    const auto floor = hn::Add(hn::Set(d, line.at_0), hn::Mul(u, hn::Set(d, line.per_u)));
    const auto outside = hn::Or(hn::Lt(floor, lowest), hn::Gt(floor, highest));
    const auto offset = hn::Add(hn::ShiftRight<kDisparityToQ16>(hn::Sub(round, floor)), middle);
    hn::StoreU(hn::DemoteTo(half, hn::IfThenElse(outside, hn::Set(d, int{kNever}), offset)), half, offsets + i);
  }
}

// A row with one offset for all columns (`offsets` null) or one each.
void count_piece(std::int16_t far, std::int16_t row_offset, const std::int16_t* offsets,
                 const std::int16_t* disparity, int count, Tables& tables) {
  const D16 d;
  const hn::RebindToUnsigned<D16> unsigned_d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto far_limit = hn::Set(d, far);
  const auto nowhere = hn::Set(unsigned_d, kNowhere);
  alignas(64) std::uint16_t entry[kRoom];
  for (int i = 0; i < count; i += lanes) {
    const auto x = hn::LoadU(d, disparity + i);
    const auto offset = offsets == nullptr ? hn::Set(d, row_offset) : hn::LoadU(d, offsets + i);
    // Negative entries are large ones without their sign.
    const auto found = hn::Min(hn::BitCast(unsigned_d, hn::SaturatedAdd(x, offset)), nowhere);
    const auto near = hn::RebindMask(unsigned_d, hn::Gt(x, far_limit));
    hn::StoreU(hn::IfThenElse(near, found, nowhere), unsigned_d, entry + i);
  }
  for (int i = 0; i < count; i += 4) {
    ++tables.entries[0][entry[i]];
    ++tables.entries[1][entry[i + 1]];
    ++tables.entries[2][entry[i + 2]];
    ++tables.entries[3][entry[i + 3]];
  }
}

void count_row(const PruneModel& m, const RowLine& line, std::int16_t far, const std::int16_t* disparity, int width,
               Tables& tables) {
  alignas(64) std::int16_t offsets[kRoom];
  alignas(64) std::int16_t rest[kRoom];
  const bool level = line.per_u == 0;
  const std::int16_t row_offset = level ? offset_of_row(m, line.at_0) : std::int16_t{0};
  if (level && row_offset == kNever) return;
  const int lanes = static_cast<int>(hn::Lanes(D16()));
  for (int begin = 0; begin < width; begin += kPiece) {
    const int count = std::min(kPiece, width - begin);
    const int whole = (count + lanes - 1) / lanes * lanes;
    const std::int16_t* from = disparity + begin;
    if (whole > count) {
      std::copy_n(from, count, rest);
      std::fill(rest + count, rest + whole, std::int16_t{kNotSearched});  // counts nowhere
      from = rest;
    }
    if (!level) fill_offsets(m, line, begin, whole, offsets);
    count_piece(far, row_offset, level ? nullptr : offsets, from, whole, tables);
  }
}

void count_rows(const PruneModel& m, ImageView<const std::int16_t> disparity, Rows rows,
                GroundHistogram& histogram) {
  const auto fits = [](std::int64_t x) { return -kRowLineLimit <= x && x <= kRowLineLimit; };
  const bool plain = disparity.width <= kRowLineMaxWidth && fits(m.min_disparity) && fits(m.max_floor_disparity);
  // d << 12 < min_disparity is d <= far; no disparity and 0 are left out, too.
  const std::int16_t far = std::max<std::int16_t>(saturated((m.min_disparity - 1) >> kDisparityToQ16), 0);
  Tables tables;
  RowLine line;
  for (int v = rows.begin; v < rows.end; ++v) {
    if (plain && narrow_to_row(m.floor, v, disparity.width, line)) {
      count_row(m, line, far, disparity.row(v), disparity.width, tables);
    } else {
      (void)ground_residuals_ref(m, disparity, {v, v + 1}, histogram);
    }
  }
  for (const auto& table : tables.entries) {
    for (std::size_t i = 0; i < histogram.size(); ++i)
      histogram[i] += table[i];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lakshya {

HWY_EXPORT(count_rows);

Status ground_residuals_simd(const PruneModel& mount, ImageView<const std::int16_t> disparity, Rows rows,
                             GroundHistogram& histogram) {
  if (!rows_inside(rows, disparity)) return Status::bad_argument;
  HWY_DYNAMIC_DISPATCH(count_rows)(mount, disparity, rows, histogram);
  return Status::ok;
}

}  // namespace lakshya
#endif

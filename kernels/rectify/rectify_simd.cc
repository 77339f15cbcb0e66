// Neighbouring output pixels read neighbouring raw pixels: the four neighbours of eight output pixels lie in a few
// raw rows, within 16 bytes of each. So the vectors load those 16 bytes of each row once and pick the neighbours by a
// table look-up. AVX2's gather instructions are as fast where they are not slowed down by a fix of the processor (0.30
// against 0.32 ms for 640 x 480 pixels), but SSE4 and NEON have none. Where the raw positions of eight pixels lie
// further apart, or outside the raw image, the reference does the work.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/rectify/rectify_simd.cc"
#include "hwy/foreach_target.h"
// foreach_target.h comes first, whatever the alphabet says.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hwy/highway.h"
#include "kernels/rectify/rectify.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A vector is a row of groups of eight pixels, 16 bytes each. Only vectors whose length the compiler knows can be
// put together from loads at several places; scalable ones are used in their first 16 bytes.
using Bytes = hn::CappedTag<std::uint8_t, HWY_HAVE_SCALABLE ? 16 : 64>;
using Words = hn::Repartition<std::int16_t, Bytes>;
using UnsignedWords = hn::RebindToUnsigned<Words>;
using WordVector = hn::Vec<Words>;

constexpr int kGroup = 8;
constexpr int kPixels = static_cast<int>(hn::MaxLanes(Words()));
constexpr int kGroups = kPixels / kGroup;
constexpr int kWindow = 16;  // raw pixels of a row that a group reads

// Raw rows that a group may read. Three serve lines that fall by one row in seven pixels, more than most lenses and
// mounts need; nine serve lines at 45 degrees.
constexpr int kFlat = 3;
constexpr int kSteep = 9;

// Byte pairs of each group's first and last pixel, for all its pixels.
constexpr std::uint8_t kFirst[16] = {0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1};
constexpr std::uint8_t kLast[16] = {14, 15, 14, 15, 14, 15, 14, 15, 14, 15, 14, 15, 14, 15, 14, 15};

WordVector pick(WordVector v, const std::uint8_t* bytes) {
  const Bytes d;
  return hn::BitCast(Words(), hn::TableLookupBytes(hn::BitCast(d, v), hn::LoadDup128(d, bytes)));
}

// The lower end of each group's positions when they rise or fall steadily, moved to 0..last: from there `last` is the
// last place where what a group reads still lies inside the raw image.
WordVector group_start(WordVector position, int last) {
  const Words d;
  const auto start = hn::Min(pick(position, kFirst), pick(position, kLast));
  return hn::Clamp(start, hn::Zero(d), hn::Set(d, static_cast<std::int16_t>(last)));
}

// 16 bytes from each group's place.
template <class D>
hn::Vec<D> load_windows(D d, const std::uint8_t* const* windows) {
  if constexpr (hn::MaxLanes(d) == kWindow) {
    return hn::LoadU(d, windows[0]);
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, load_windows(half, windows + hn::MaxLanes(half) / kWindow), load_windows(half, windows));
  }
}

// (128 - a) left + a right, at most 128 * 255, of pairs left | right << 8
WordVector between(WordVector pair, WordVector a) {
  const Words d;
  const auto left = hn::And(pair, hn::Set(d, 0xff));
  const auto right = hn::BitCast(d, hn::ShiftRight<8>(hn::BitCast(UnsignedWords(), pair)));
  return hn::Add(hn::ShiftLeft<kRectifyFractionBits>(left), hn::Mul(hn::Sub(right, left), a));
}

// ((128 - b) top + b bottom + 2^13) >> 14 = (top + floor(b (bottom - top) / 128) + 2^6) >> 7, in 16 bits
WordVector blend(WordVector top, WordVector bottom, WordVector fraction) {
  const Words d;
  const auto difference = hn::Sub(bottom, top);
  // b << 9 has a sign: from b = 64 on it is (b - 128) << 9, and the product lacks one difference.
  const auto b = hn::And(fraction, hn::Set(d, static_cast<std::int16_t>(0xfe00)));
  const auto part = hn::Add(hn::MulHigh(difference, b), hn::And(difference, hn::BroadcastSignBit(b)));
  return hn::ShiftRight<kRectifyFractionBits>(hn::Add(hn::Add(top, part), hn::Set(d, 64)));
}

// kPixels pixels, each group within kRows raw rows; false: some are not, nothing was written.
template <int kRows>
bool rectify_vector(const ImageView<const std::uint8_t>& raw, WordVector x, WordVector y, WordVector fraction,
                    std::uint8_t* out) {
  const Words d;
  const Bytes d8;
  const UnsignedWords du;
  constexpr int kMax = std::numeric_limits<std::int16_t>::max();
  const auto start_x = group_start(x, std::min(raw.width, kMax) - kWindow);
  const auto start_y = group_start(y, std::min(raw.height, kMax) - kRows);
  // Less than 0 is far too much, unsigned.
  const auto step_x = hn::Sub(x, start_x);
  const auto step_y = hn::Sub(y, start_y);
  const auto beyond = hn::Or(hn::SaturatedSub(hn::BitCast(du, step_x), hn::Set(du, kWindow - 2)),
                             hn::SaturatedSub(hn::BitCast(du, step_y), hn::Set(du, kRows - 2)));
  if (!hn::AllTrue(du, hn::Eq(beyond, hn::Zero(du)))) return false;

  HWY_ALIGN std::int16_t columns[kPixels];
  HWY_ALIGN std::int16_t row_numbers[kPixels];
  hn::Store(start_x, d, columns);
  hn::Store(start_y, d, row_numbers);
  const std::uint8_t* windows[kGroups];
  for (int i = 0; i < kGroups; ++i) {
    const int pixel = kGroup * i;
    windows[i] = raw.row(row_numbers[pixel]) + columns[pixel];
  }
  const auto next_row = [&] {
    for (const std::uint8_t*& window : windows)
      window += raw.stride;
  };
  // Bytes step and step + 1 of the window.
  const auto pair = hn::BitCast(d8, hn::Add(hn::Mul(step_x, hn::Set(d, 0x0101)), hn::Set(d, 0x0100)));
  const auto row_pairs = [&] { return hn::BitCast(d, hn::TableLookupBytes(load_windows(d8, windows), pair)); };

  auto top = row_pairs();
  next_row();
  auto bottom = row_pairs();
  auto here = bottom;
  for (int row = 1; row < kRows - 1; ++row) {
    next_row();
    const auto below = row_pairs();
    const auto in_row = hn::Eq(step_y, hn::Set(d, static_cast<std::int16_t>(row)));
    top = hn::IfThenElse(in_row, here, top);
    bottom = hn::IfThenElse(in_row, below, bottom);
    here = below;
  }
  const auto a = hn::And(fraction, hn::Set(d, 127));
  const auto grey = blend(between(top, a), between(bottom, a), fraction);
  const hn::Rebind<std::uint8_t, Words> d_out;
  hn::StoreU(hn::DemoteTo(d_out, grey), d_out, out);
  return true;
}

void rectify_rows(const ImageView<const std::uint8_t>& raw, const RectifyMap& map, Rows rows,
                  const ImageView<std::uint8_t>& out) {
  const Words d;
  const bool vectors = out.width >= kPixels && raw.width >= kWindow && raw.height >= kSteep;
  for (int v = rows.begin; v < rows.end; ++v) {
    if (!vectors) {
      rectify_columns_ref(raw, map, v, 0, out.width, out);
      continue;
    }
    for (int u = 0; u < out.width; u += kPixels) {
      const int first = std::min(u, out.width - kPixels);  // the last vector overlaps the one before
      const auto x = hn::LoadU(d, map.x.row(v) + first);
      const auto y = hn::LoadU(d, map.y.row(v) + first);
      const auto fraction = hn::BitCast(d, hn::LoadU(UnsignedWords(), map.fraction.row(v) + first));
      std::uint8_t* pixels = out.row(v) + first;
      if (rectify_vector<kFlat>(raw, x, y, fraction, pixels)) continue;
      if (rectify_vector<kSteep>(raw, x, y, fraction, pixels)) continue;
      rectify_columns_ref(raw, map, v, first, first + kPixels, out);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lakshya {

HWY_EXPORT(rectify_rows);

Status rectify_simd(ImageView<const std::uint8_t> raw, const RectifyMap& map, Rows rows,
                    ImageView<std::uint8_t> out) {
  if (!same_size(map.x, out) || !same_size(map.y, out) || !same_size(map.fraction, out)) {
    return Status::size_mismatch;
  }
  if (!rows_inside(rows, out)) return Status::bad_argument;
  HWY_DYNAMIC_DISPATCH(rectify_rows)(raw, map, rows, out);
  return Status::ok;
}

}  // namespace lakshya
#endif

// The reference in three passes over a piece of a row that stays in the first cache: which class each pixel has (16 bits
// a pixel), the columns and disparities of the classes that go into the map gathered side by side, and their cells (32
// bits a pixel). Neighbours fall into one cell more often than not, so equal cells in a row are counted before the map
// is touched. A row whose numbers do not fit (row_terms.h) is the reference's.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/project/project_simd.cc"
#include "hwy/foreach_target.h"
// foreach_target.h comes first, whatever the alphabet says.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/compress_simd-inl.h"
#include "kernels/grid_bin/grid_bin.h"
#include "kernels/project/project.h"
#include "kernels/project/row_terms.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D16 = hn::ScalableTag<std::int16_t>;
using D32 = hn::ScalableTag<std::int32_t>;
using Half16 = hn::Rebind<std::int16_t, D32>;  // as many as D32 has
using DFloat = hn::RebindToFloat<D32>;
using V16 = hn::Vec<D16>;
using V32 = hn::Vec<D32>;
using VFloat = hn::Vec<DFloat>;
using M32 = hn::Mask<D32>;

constexpr int kPiece = 256;                                          // pixels
constexpr int kRoom = kPiece + static_cast<int>(HWY_MAX_BYTES) / 2;  // a vector may hang over
constexpr int kCellRoom = 4 * kPiece;

// Pixels of one class: column << 16 | disparity.
struct Pixels {
  alignas(64) std::int32_t pixel[kRoom] = {};
  int count = 0;
};

// Cells to be counted in one plane of the map, in order.
struct Cells {
  alignas(64) std::int32_t index[kCellRoom + kRoom] = {};
  alignas(64) std::int32_t ends[kCellRoom + kRoom] = {};
  int count = 0;
};

struct Work {
  Pixels obstacles, floor, below;
  alignas(64) std::int16_t disparity[kRoom] = {};  // a piece shorter than a whole number of vectors
  alignas(64) std::int16_t nothing[kRoom], drop[kRoom], floor_limit[kRoom], ceiling_low[kRoom], ceiling_high[kRoom];
  alignas(64) std::uint8_t classes[kRoom];
  alignas(64) std::int32_t heights[kRoom] = {};
  Cells obstacle_cells, first_cells, further_cells;
};

struct Frame {
  const PruneModel& model;
  const NavGrid& grid;
  float cells_per_mm;
  float to_middle;  // half a millimetre less half a cell, in cells
};

// first, first + 1, ...; Highway's Iota with a first that is not known stores the lanes one by one.
HWY_INLINE V32 from(std::int32_t first) {
  const D32 d;
  return hn::Add(hn::Iota(d, 0), hn::Set(d, first));
}

HWY_INLINE V32 value_at(const RowLine& line, V32 u) {
  const D32 d;
  const auto start = hn::Set(d, line.at_0);
  return line.per_u == 0 ? start : hn::Add(start, hn::Mul(u, hn::Set(d, line.per_u)));
}

// ---- classes

// The limits of every column of a piece, for a camera that rolls.
void fill_limits(const PruneModel& model, const RowTerms& t, int begin, int count, Work& w) {
  const D32 d;
  const Half16 half;
  const auto store = [&](V32 limit, std::int16_t* to) { hn::StoreU(hn::DemoteTo(half, limit), half, to); };
  const auto none = hn::Set(d, -1);
  const auto all = hn::Set(d, 32767);
  const auto below = [&](V32 bound) { return hn::ShiftRight<kDisparityToQ16>(hn::Add(bound, none)); };
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
    const auto u = from(begin + i);
    const auto floor = value_at(t.floor, u);
    const auto is_below = hn::Gt(floor, hn::Zero(d));
    const auto drop = hn::Min(value_at(t.drop_relative, u), value_at(t.drop_absolute, u));
    const auto up_to = hn::Max(value_at(t.floor_relative, u), value_at(t.floor_absolute, u));
    store(hn::IfThenElse(hn::Gt(floor, hn::Set(d, t.max_floor_disparity)), all, none), w.nothing + i);
    store(hn::IfThenElse(is_below, below(drop), none), w.drop + i);
    store(hn::IfThenElse(is_below, hn::ShiftRight<kDisparityToQ16>(up_to), none), w.floor_limit + i);
    const auto ceiling = value_at(t.ceiling, u);
    const auto is_above = hn::Lt(floor, hn::Zero(d));
    const auto low = model.ceiling_test == CeilingTest::above_camera ? below(ceiling) : all;
    const bool from_above = model.ceiling_test != CeilingTest::below_camera;
    store(from_above ? hn::IfThenElse(is_above, low, none) : none, w.ceiling_low + i);
    store(from_above ? all : hn::ShiftRight<kDisparityToQ16>(ceiling), w.ceiling_high + i);
  }
}

// A vector of pixels, in two halves of 32-bit lanes.
struct TwoHalves {
  V32 low, high;
};

HWY_INLINE void append(const TwoHalves& pixels, hn::Mask<D16> mask, Pixels& to) {
  const D16 d;
  if (hn::AllFalse(d, mask)) return;
  to.count += static_cast<int>(compress_store_two(pixels.low, pixels.high, mask, D32(), d, to.pixel + to.count));
}

void count_reasons(const D16 d, V16 disparity, std::size_t negative, PixelCounts& counts) {
  for (int reason = 1; reason < kNoDisparityReasons; ++reason) {
    const auto code = hn::Set(d, static_cast<std::int16_t>(-1 - reason));
    const std::size_t found = hn::CountTrue(d, hn::Eq(disparity, code));
    counts.by_reason[reason] += static_cast<std::uint32_t>(found);
    negative -= found;
  }
  counts.by_reason[0] += static_cast<std::uint32_t>(negative);
}

// Pixels [begin, begin + count) of a row, count a whole number of vectors, at `disparity`.
template <bool kLevel>
void sort_pixels(const RowTerms& t, const std::int16_t* disparity, int begin, int count, bool want_classes,
                 PixelCounts& counts, Work& w) {
  const D16 d;
  const D32 d32;
  const Half16 half;
  const hn::Rebind<std::uint8_t, D16> bytes;
  const auto limit = [&](std::int16_t of_row, const std::int16_t* of_column) {
    return kLevel ? hn::Set(d, of_row) : hn::Load(d, of_column);
  };
  const auto far_limit = hn::Set(d, t.far);
  std::size_t far_or_negative = 0, negative = 0, nothing_count = 0, drop_count = 0, floor_count = 0,
              ceiling_count = 0;
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
    const auto x = hn::LoadU(d, disparity + i);
    const auto is_negative = hn::Lt(x, hn::Zero(d));
    const std::size_t negatives = hn::CountTrue(d, is_negative);
    if (negatives > 0) count_reasons(d, x, negatives, counts);
    negative += negatives;
    const auto near = hn::Gt(x, far_limit);
    far_or_negative += hn::CountTrue(d, hn::Not(near));
    const auto known = hn::And(near, hn::Gt(x, limit(t.limits.nothing, w.nothing + i)));
    const auto above_drop = hn::Gt(x, limit(t.limits.drop, w.drop + i));
    const auto above_floor = hn::Gt(x, limit(t.limits.floor, w.floor_limit + i));
    const auto in_room = hn::AndNot(hn::Gt(x, limit(t.limits.ceiling_high, w.ceiling_high + i)),
                                    hn::Gt(x, limit(t.limits.ceiling_low, w.ceiling_low + i)));
    const auto drop = hn::AndNot(above_drop, known);
    const auto standing = hn::And(known, hn::And(above_drop, above_floor));
    const auto floor = hn::AndNot(above_floor, hn::And(known, above_drop));
    const auto obstacle = hn::And(standing, in_room);
    if (!kLevel || t.limits.nothing >= 0) nothing_count += hn::CountTrue(d, hn::AndNot(known, near));
    const auto first = hn::ShiftLeft<16>(from(begin + i));
    const auto half_way = hn::Set(d32, static_cast<std::int32_t>(hn::Lanes(d32)) << 16);
    const TwoHalves pixels = {hn::Or(first, hn::PromoteTo(d32, hn::LowerHalf(half, x))),
                              hn::Or(hn::Add(first, half_way), hn::PromoteTo(d32, hn::UpperHalf(half, x)))};
    append(pixels, obstacle, w.obstacles);
    append(pixels, floor, w.floor);
    append(pixels, drop, w.below);
    if (!want_classes) continue;
    const auto code = [&](PixelClass c) { return hn::Set(d, static_cast<std::int16_t>(c)); };
    auto classes = hn::IfThenElseZero(hn::Not(hn::Or(near, is_negative)), code(PixelClass::too_far));
    classes = hn::IfThenElse(standing, code(PixelClass::ceiling), classes);
    classes = hn::IfThenElse(obstacle, code(PixelClass::obstacle), classes);
    classes = hn::IfThenElse(floor, code(PixelClass::floor), classes);
    classes = hn::IfThenElse(drop, code(PixelClass::drop_off), classes);
    hn::StoreU(hn::DemoteTo(bytes, classes), bytes, w.classes + i);
  }
  drop_count = static_cast<std::size_t>(w.below.count);
  floor_count = static_cast<std::size_t>(w.floor.count);
  const auto obstacle_count = static_cast<std::size_t>(w.obstacles.count);
  ceiling_count =
      static_cast<std::size_t>(count) - far_or_negative - nothing_count - drop_count - floor_count - obstacle_count;
  const auto add = [&](PixelClass c, std::size_t n) {
    counts.by_class[static_cast<int>(c)] += static_cast<std::uint32_t>(n);
  };
  add(PixelClass::no_disparity, negative + nothing_count);
  add(PixelClass::too_far, far_or_negative - negative);
  add(PixelClass::drop_off, drop_count);
  add(PixelClass::floor, floor_count);
  add(PixelClass::ceiling, ceiling_count);
  add(PixelClass::obstacle, obstacle_count);
}

// ---- coordinates

// (a * b + half) >> kShift of every lane, by way of 64 bits; the result's low 32.
template <int kShift>
HWY_INLINE V32 scaled_product(V32 a, V32 b) {
  const D32 d;
  const hn::RepartitionToWide<hn::RebindToUnsigned<D32>> wide;
  const auto round = hn::Set(wide, std::uint64_t{1} << (kShift - 1));
  const auto odd = [&](V32 x) { return hn::BitCast(d, hn::ShiftRight<32>(hn::BitCast(wide, x))); };
  const auto even_product = hn::Add(hn::BitCast(wide, hn::MulEven(a, b)), round);
  const auto odd_product = hn::Add(hn::BitCast(wide, hn::MulEven(odd(a), odd(b))), round);
  return hn::OddEven(hn::BitCast(d, hn::ShiftLeft<32 - kShift>(odd_product)),
                     hn::BitCast(d, hn::ShiftRight<kShift>(even_product)));
}

HWY_INLINE V32 per_depth(const RowDirection& a, V32 u) {
  const D32 d;
  const hn::RebindToUnsigned<D32> unsigned_d;
  const auto whole = hn::Set(d, a.whole);
  if (a.whole_per_u == 0 && a.part_per_u == 0) return whole;
  const auto part =
      hn::Add(hn::Set(unsigned_d, a.part), hn::Mul(hn::BitCast(unsigned_d, u), hn::Set(unsigned_d, a.part_per_u)));
  return hn::Add(hn::Add(whole, hn::Mul(u, hn::Set(d, a.whole_per_u))), hn::BitCast(d, hn::ShiftRight<16>(part)));
}

// floor(mm / cell), exactly: half a millimetre more is at least half a millimetre away from every border, which is
// more than what float rounds at kProjectMaxMm. Less half a cell and rounded to the nearest integer it is the floor;
// adding 1.5 * 2^23 rounds, and leaves the integer in the low bits.
HWY_INLINE V32 cell_of(const Frame& f, V32 mm) {
  const DFloat d;
  const D32 ints;
  constexpr float kRound = 12582912.0F;
  const auto cells = hn::Mul(hn::ConvertTo(d, mm), hn::Set(d, f.cells_per_mm));
  const auto rounded = hn::Add(hn::Add(cells, hn::Set(d, f.to_middle)), hn::Set(d, kRound));
  return hn::Sub(hn::BitCast(ints, rounded), hn::BitCast(ints, hn::Set(d, kRound)));
}

HWY_INLINE V32 depth_at(const PruneModel& m, V32 index) {
  const D32 d;
  const auto last = hn::Set(d, static_cast<std::int32_t>(m.depth_mm.size()) - 1);
  return hn::GatherIndex(d, m.depth_mm.data(), hn::Min(hn::Max(index, hn::Set(d, 1)), last));
}

struct Column {
  V32 u, disparity;
};

HWY_INLINE Column column_at(const Pixels& p, int i) {
  const D32 d;
  const auto pixel = hn::LoadU(d, p.pixel + i);
  return {hn::ShiftRight<16>(pixel), hn::And(pixel, hn::Set(d, 0xFFFF))};
}

// How far right of the map's left border.
HWY_INLINE V32 across_at(const Frame& f, V32 left) {
  const GridGeometry& g = f.grid.geometry;
  return hn::Sub(hn::Set(D32(), g.cols / 2 * g.cell_mm - f.model.left_mm), left);
}

void bin_obstacles(const Frame& f, const RowTerms& t, Work& w) {
  const D32 d;
  const PruneModel& m = f.model;
  const GridGeometry& g = f.grid.geometry;
  Cells& cells = w.obstacle_cells;
  cells.count = 0;
  for (int i = 0; i < w.obstacles.count; i += static_cast<int>(hn::Lanes(d))) {
    const Column c = column_at(w.obstacles, i);
    const auto last = hn::Set(d, static_cast<std::int32_t>(m.depth_mm.size()) - 1);
    const auto index = hn::Min(hn::Max(c.disparity, hn::Set(d, 1)), last);
    const auto depth = hn::GatherIndex(d, m.depth_mm.data(), index);
    const auto ahead = hn::Add(scaled_product<16>(depth, per_depth(t.forward, c.u)), hn::Set(d, m.forward_mm));
    const auto forward = hn::Max(ahead, hn::Zero(d));
    const auto across = across_at(f, scaled_product<16>(depth, per_depth(t.left, c.u)));
    const auto inside = hn::And(
        hn::And(hn::Lt(forward, hn::Set(d, g.rows * g.cell_mm)), hn::Lt(across, hn::Set(d, g.cols * g.cell_mm))),
        hn::Gt(across, hn::Set(d, -1)));
    const auto valid = hn::And(inside, hn::FirstN(d, static_cast<std::size_t>(w.obstacles.count - i)));
    const auto scale = hn::GatherIndex(d, m.height_scale.data(), index);
    const auto height = hn::Sub(hn::Set(d, m.height_mm), scaled_product<28>(value_at(t.floor, c.u), scale));
    const auto cell =
        hn::Add(hn::Mul(cell_of(f, forward), hn::Set(d, static_cast<std::int32_t>(f.grid.count.stride))),
                cell_of(f, across));
    compress_store(height, valid, d, w.heights + cells.count);
    cells.count += static_cast<int>(compress_store(cell, valid, d, cells.index + cells.count));
  }
  for (int i = 0; i < cells.count; ++i) {
    ++f.grid.count.data[cells.index[i]];
    f.grid.height_sum.data[cells.index[i]] += w.heights[i];
  }
}

// ---- ground

// plane[cell] += how often it stands in `cells`, but for kOutside; empties them. Of equal cells in a row only the last
// is looked at.
constexpr std::int32_t kOutside = -1;

HWY_INLINE void count_cells(Cells& cells, std::uint32_t* plane) {
  const D32 d;
  const int count = cells.count;
  cells.index[count] = kOutside - 1;  // ends the last run
  int runs = 0;
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
    const auto here = hn::LoadU(d, cells.index + i);
    const auto next = hn::LoadU(d, cells.index + i + 1);
    runs += static_cast<int>(compress_store(from(i), hn::Ne(here, next), d, cells.ends + runs));
  }
  std::int32_t before = -1;
  for (int r = 0; r < runs; ++r) {
    const std::int32_t last = cells.ends[r];
    const std::int32_t cell = cells.index[last];
    if (cell != kOutside) plane[cell] += static_cast<std::uint32_t>(last - before);
    before = last;
  }
  cells.count = 0;
}

struct Spot {
  V32 forward, across;  // mm; across from the map's left border
};

struct Strip {
  Spot near, far;
  V32 near_row, near_col, far_row, far_col;
};

HWY_INLINE Strip strip_at(const Frame& f, const RowTerms& t, const Column& c) {
  const D32 d;
  const auto here = hn::Max(value_at(t.floor, c.u), hn::ShiftLeft<kDisparityToQ16>(c.disparity));
  const auto half_row = hn::Set(d, t.half_row);
  const auto round = hn::Set(d, 1 << (kDisparityToQ16 - 1));
  const auto depth = [&](V32 q16) {
    return depth_at(f.model, hn::ShiftRight<kDisparityToQ16>(hn::Add(q16, round)));
  };
  const auto near_depth = depth(hn::Add(here, half_row));
  const auto far_depth = depth(hn::Max(hn::Sub(here, half_row), hn::Set(d, t.min_disparity)));
  const auto forward = per_depth(t.forward, c.u);
  const auto left = per_depth(t.left, c.u);
  const auto mount = hn::Set(d, f.model.forward_mm);
  const auto spot = [&](V32 z) {
    return Spot{hn::Add(scaled_product<16>(z, forward), mount), across_at(f, scaled_product<16>(z, left))};
  };
  Strip s;
  s.near = spot(near_depth);
  s.far = spot(far_depth);
  s.near_row = cell_of(f, s.near.forward);
  s.near_col = cell_of(f, s.near.across);
  s.far_row = cell_of(f, s.far.forward);
  s.far_col = cell_of(f, s.far.across);
  return s;
}

// A whole vector, kOutside where a lane is not in `which` or not on the map.
HWY_INLINE void append_cells(const Frame& f, V32 row, V32 col, M32 which, std::int32_t stride, Cells& to) {
  const D32 d;
  const auto outside = hn::Set(d, kOutside);
  const auto inside = hn::And(hn::And(hn::Gt(row, outside), hn::Lt(row, hn::Set(d, f.grid.geometry.rows))),
                              hn::And(hn::Gt(col, outside), hn::Lt(col, hn::Set(d, f.grid.geometry.cols))));
  const auto cell = hn::Add(hn::Mul(row, hn::Set(d, stride)), col);
  hn::StoreU(hn::IfThenElse(hn::And(inside, which), cell, outside), d, to.index + to.count);
  to.count += static_cast<int>(hn::Lanes(d));
}

// The strips' samples between their ends; kMaxSteps keeps the products within what float holds exactly.
constexpr int kMaxSteps = 32;
constexpr int kMaxStripMm = 1 << 15;

void append_between(const Frame& f, const Strip& s, V32 steps, M32 valid, std::int32_t most, std::int32_t stride,
                    std::uint32_t* plane, Cells& to) {
  const D32 d;
  const DFloat floats;
  const auto per_step = hn::Div(hn::Set(floats, 1.0F), hn::ConvertTo(floats, hn::Max(steps, hn::Set(d, 1))));
  // Truncates (far - near) * i / steps as integers do.
  const auto between = [&](V32 near, V32 far, V32 i) {
    const auto product = hn::ConvertTo(floats, hn::Mul(hn::Sub(far, near), i));
    const auto away = hn::Add(product, hn::CopySignToAbs(hn::Set(floats, 0.5F), product));
    return hn::Add(near, hn::ConvertTo(d, hn::Mul(away, per_step)));
  };
  for (std::int32_t step = 1; step < most; ++step) {
    const auto i = hn::Set(d, step);
    if (to.count >= kCellRoom - static_cast<int>(hn::Lanes(d))) count_cells(to, plane);
    append_cells(f, cell_of(f, between(s.near.forward, s.far.forward, i)),
                 cell_of(f, between(s.near.across, s.far.across, i)), hn::And(valid, hn::Gt(steps, i)), stride, to);
  }
}

// Strips too long for append_between.
void bin_long_strips(const Frame& f, const Strip& s, int count, const ImageView<std::uint32_t>& plane) {
  const D32 d;
  constexpr int kMost = static_cast<int>(HWY_MAX_BYTES) / 4;
  std::int32_t mm[4][kMost];
  hn::StoreU(s.near.forward, d, mm[0]);
  hn::StoreU(s.near.across, d, mm[1]);
  hn::StoreU(s.far.forward, d, mm[2]);
  hn::StoreU(s.far.across, d, mm[3]);
  const std::int32_t border = f.grid.geometry.cols / 2 * f.grid.geometry.cell_mm;
  for (int k = 0; k < count; ++k) {
    const GroundStrip strip{mm[0][k], border - mm[1][k], mm[2][k], border - mm[3][k]};
    (void)bin_ground_ref({&strip, 1}, f.grid, plane);  // the caller has checked the grid
  }
}

void bin_ground(const Frame& f, const RowTerms& t, const Pixels& pixels, const ImageView<std::uint32_t>& plane,
                Work& w) {
  const D32 d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto stride = static_cast<std::int32_t>(plane.stride);
  Cells& further = w.further_cells;
  for (int i = 0; i < pixels.count; i += lanes) {
    const Strip s = strip_at(f, t, column_at(pixels, i));
    const auto valid = hn::FirstN(d, static_cast<std::size_t>(pixels.count - i));
    const auto steps = hn::IfThenElseZero(
        valid, hn::Max(hn::Abs(hn::Sub(s.far_row, s.near_row)), hn::Abs(hn::Sub(s.far_col, s.near_col))));
    const auto longer = hn::Gt(steps, hn::Zero(d));
    if (!hn::AllFalse(d, hn::Gt(steps, hn::Set(d, 1)))) {
      const std::int32_t most = hn::GetLane(hn::MaxOfLanes(d, steps));
      const auto extent =
          hn::Max(hn::Abs(hn::Sub(s.far.forward, s.near.forward)), hn::Abs(hn::Sub(s.far.across, s.near.across)));
      if (most > kMaxSteps || !hn::AllFalse(d, hn::And(valid, hn::Gt(extent, hn::Set(d, kMaxStripMm))))) {
        bin_long_strips(f, s, std::min(lanes, pixels.count - i), plane);
        continue;
      }
      append_between(f, s, steps, valid, most, stride, plane.data, further);
    }
    append_cells(f, s.near_row, s.near_col, valid, stride, w.first_cells);
    if (further.count >= kCellRoom - lanes) count_cells(further, plane.data);
    if (!hn::AllFalse(d, longer)) append_cells(f, s.far_row, s.far_col, longer, stride, further);
  }
  count_cells(w.first_cells, plane.data);
  count_cells(further, plane.data);
}

// ---- a row

void project_row(const Frame& f, const RowTerms& t, const std::int16_t* disparity, int width, PixelCounts& counts,
                 PixelClass* classes, Work& w) {
  const int lanes = static_cast<int>(hn::Lanes(D16()));
  for (int begin = 0; begin < width; begin += kPiece) {
    const int count = std::min(kPiece, width - begin);
    const int whole = (count + lanes - 1) / lanes * lanes;
    const std::int16_t* from = disparity + begin;
    if (whole > count) {
      std::copy_n(from, count, w.disparity);
      std::fill(w.disparity + count, w.disparity + whole, std::int16_t{0});
      from = w.disparity;
    }
    w.obstacles.count = w.floor.count = w.below.count = 0;
    if (t.level) {
      sort_pixels<true>(t, from, begin, whole, classes != nullptr, counts, w);
    } else {
      fill_limits(f.model, t, begin, whole, w);
      sort_pixels<false>(t, from, begin, whole, classes != nullptr, counts, w);
    }
    // What filled up the last vector was too far.
    counts.by_class[static_cast<int>(PixelClass::too_far)] -= static_cast<std::uint32_t>(whole - count);
    if (classes != nullptr) {
      std::transform(w.classes, w.classes + count, classes + begin,
                     [](std::uint8_t c) { return static_cast<PixelClass>(c); });
    }
    bin_obstacles(f, t, w);
    bin_ground(f, t, w.floor, f.grid.floor_count, w);
    if (w.below.count > 0) bin_ground(f, t, w.below, f.grid.below_count, w);
  }
}

// One index for count and height_sum, in 32 bits.
bool planes_fit(const NavGrid& grid) {
  const std::ptrdiff_t widest =
      std::max({grid.count.stride, grid.floor_count.stride, grid.below_count.stride, grid.height_sum.stride});
  return grid.count.stride == grid.height_sum.stride && widest <= (1 << 30) / grid.geometry.rows;
}

void project_rows(const PruneModel& model, ImageView<const std::int16_t> disparity, Rows rows, const NavGrid& grid,
                  PixelCounts& counts, ImageView<PixelClass> classes, std::span<std::byte> scratch) {
  const float cells_per_mm = 1.0F / static_cast<float>(grid.geometry.cell_mm);
  const Frame frame{model, grid, cells_per_mm, 0.5F * cells_per_mm - 0.5F};
  Work work;
  RowTerms terms;
  const bool plain = planes_fit(grid);
  for (int v = rows.begin; v < rows.end; ++v) {
    if (plain && make_row_terms(model, grid.geometry, v, disparity.width, terms)) {
      project_row(frame, terms, disparity.row(v), disparity.width, counts,
                  classes.data != nullptr ? classes.row(v) : nullptr, work);
    } else {
      (void)project_rows_ref(model, disparity, {v, v + 1}, grid, counts, classes,
                             scratch);  // arguments are checked
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lakshya {

HWY_EXPORT(project_rows);

Status project_rows_simd(const PruneModel& model, ImageView<const std::int16_t> disparity, Rows rows,
                         const NavGrid& grid, PixelCounts& counts, ImageView<PixelClass> classes,
                         std::span<std::byte> scratch) {
  // The reference checks the arguments.
  const Status checked =
      project_rows_ref(model, disparity, {rows.begin, rows.begin}, grid, counts, classes, scratch);
  if (checked != Status::ok) return checked;
  if (!rows_inside(rows, disparity)) return Status::bad_argument;
  HWY_DYNAMIC_DISPATCH(project_rows)(model, disparity, rows, grid, counts, classes, scratch);
  return Status::ok;
}

}  // namespace lakshya
#endif

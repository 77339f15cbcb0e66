// Second and third pass of project_simd.cc: the cells of the pixels that go into the map, and their counts.
#if defined(KERNELS_PROJECT_BIN_PIXELS_SIMD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef KERNELS_PROJECT_BIN_PIXELS_SIMD_INL_H
#undef KERNELS_PROJECT_BIN_PIXELS_SIMD_INL_H
#else
#define KERNELS_PROJECT_BIN_PIXELS_SIMD_INL_H
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/compress_simd-inl.h"
#include "kernels/base/kept_simd-inl.h"
#include "kernels/grid_bin/grid_bin.h"
#include "kernels/project/pixels_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void bin_obstacles(const Frame& f, const RowTerms& t, Work& w) {
  const D32 d;
  const PruneModel& m = f.model;
  const GridGeometry& g = f.grid.geometry;
  Cells& cells = w.obstacle_cells;
  cells.count = 0;
  for (int i = 0; i < w.obstacles.count; i += static_cast<int>(hn::Lanes(d))) {
    const auto pixels = hn::LoadU(d, w.obstacles.pixel + i);
    const auto u = columns_of(pixels);
    const auto last = hn::Set(d, static_cast<std::int32_t>(m.depth_mm.size()) - 1);
    const auto index = hn::Min(hn::Max(disparities_of(pixels), hn::Set(d, 1)), last);
    const auto depth = hn::GatherIndex(d, m.depth_mm.data(), index);
    const auto ahead = hn::Add(scaled_product<16>(depth, per_depth(t.forward, u)), hn::Set(d, m.forward_mm));
    const auto forward = hn::Max(ahead, hn::Zero(d));
    const auto across = across_at(f, scaled_product<16>(depth, per_depth(t.left, u)));
    const auto inside = hn::And(
        hn::And(hn::Lt(forward, hn::Set(d, g.rows * g.cell_mm)), hn::Lt(across, hn::Set(d, g.cols * g.cell_mm))),
        hn::Gt(across, hn::Set(d, -1)));
    const auto valid = hn::And(inside, hn::FirstN(d, static_cast<std::size_t>(w.obstacles.count - i)));
    const auto scale = hn::GatherIndex(d, m.height_scale.data(), index);
    const auto height = hn::Sub(hn::Set(d, m.height_mm), scaled_product<28>(value_at(t.floor, u), scale));
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

// mm, across from the map's left border. Kept: no constructor of the target's vectors runs outside of inlined functions.
struct Spot {
  HWY_INLINE Spot(V32 forward_mm, V32 across_mm) : forward(forward_mm), across(across_mm) {}
  Kept<D32> forward, across;
};

struct Strip {
  HWY_INLINE Strip(const Spot& near_end, const Spot& far_end) : near(near_end), far(far_end) {}
  Spot near, far;
};

HWY_INLINE Spot spot_at(const Frame& f, V32 depth, V32 forward, V32 left) {
  const auto mount = hn::Set(D32(), f.model.forward_mm);
  return {hn::Add(scaled_product<16>(depth, forward), mount), across_at(f, scaled_product<16>(depth, left))};
}

HWY_INLINE Strip strip_at(const Frame& f, const RowTerms& t, V32 pixels) {
  const D32 d;
  const auto u = columns_of(pixels);
  const auto here = hn::Max(value_at(t.floor, u), hn::ShiftLeft<kDisparityToQ16>(disparities_of(pixels)));
  const auto half_row = hn::Set(d, t.half_row);
  const auto round = hn::Set(d, 1 << (kDisparityToQ16 - 1));
  const auto near_entry = hn::ShiftRight<kDisparityToQ16>(hn::Add(hn::Add(here, half_row), round));
  const auto farthest = hn::Set(d, t.min_disparity);
  const auto far_entry =
      hn::ShiftRight<kDisparityToQ16>(hn::Add(hn::Max(hn::Sub(here, half_row), farthest), round));
  const auto forward = per_depth(t.forward, u);
  const auto left = per_depth(t.left, u);
  return {spot_at(f, depth_at(f.model, near_entry), forward, left),
          spot_at(f, depth_at(f.model, far_entry), forward, left)};
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
  const auto near_forward = s.near.forward.get();
  const auto near_across = s.near.across.get();
  const auto far_forward = s.far.forward.get();
  const auto far_across = s.far.across.get();
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
    append_cells(f, cell_of(f, between(near_forward, far_forward, i)),
                 cell_of(f, between(near_across, far_across, i)), hn::And(valid, hn::Gt(steps, i)), stride, to);
  }
}

// Strips too long for append_between.
void bin_long_strips(const Frame& f, const Strip& s, int count, const ImageView<std::uint32_t>& plane) {
  const D32 d;
  constexpr int kMost = static_cast<int>(HWY_MAX_BYTES) / 4;
  std::int32_t mm[4][kMost];
  hn::StoreU(s.near.forward.get(), d, mm[0]);
  hn::StoreU(s.near.across.get(), d, mm[1]);
  hn::StoreU(s.far.forward.get(), d, mm[2]);
  hn::StoreU(s.far.across.get(), d, mm[3]);
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
    const Strip s = strip_at(f, t, hn::LoadU(d, pixels.pixel + i));
    const auto near_forward = s.near.forward.get();
    const auto near_across = s.near.across.get();
    const auto far_forward = s.far.forward.get();
    const auto far_across = s.far.across.get();
    const auto near_row = cell_of(f, near_forward);
    const auto near_col = cell_of(f, near_across);
    const auto far_row = cell_of(f, far_forward);
    const auto far_col = cell_of(f, far_across);
    const auto valid = hn::FirstN(d, static_cast<std::size_t>(pixels.count - i));
    const auto steps = hn::IfThenElseZero(
        valid, hn::Max(hn::Abs(hn::Sub(far_row, near_row)), hn::Abs(hn::Sub(far_col, near_col))));
    const auto longer = hn::Gt(steps, hn::Zero(d));
    if (!hn::AllFalse(d, hn::Gt(steps, hn::Set(d, 1)))) {
      const std::int32_t most = hn::GetLane(hn::MaxOfLanes(d, steps));
      const auto extent =
          hn::Max(hn::Abs(hn::Sub(far_forward, near_forward)), hn::Abs(hn::Sub(far_across, near_across)));
      if (most > kMaxSteps || !hn::AllFalse(d, hn::And(valid, hn::Gt(extent, hn::Set(d, kMaxStripMm))))) {
        bin_long_strips(f, s, std::min(lanes, pixels.count - i), plane);
        continue;
      }
      append_between(f, s, steps, valid, most, stride, plane.data, further);
    }
    append_cells(f, near_row, near_col, valid, stride, w.first_cells);
    if (further.count >= kCellRoom - lanes) count_cells(further, plane.data);
    if (!hn::AllFalse(d, longer)) append_cells(f, far_row, far_col, longer, stride, further);
  }
  count_cells(w.first_cells, plane.data);
  count_cells(further, plane.data);
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

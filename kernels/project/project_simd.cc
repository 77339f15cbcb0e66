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
#include "kernels/project/bin_narrow_simd-inl.h"
#include "kernels/project/bin_pixels_simd-inl.h"
#include "kernels/project/pixels_simd-inl.h"
#include "kernels/project/project.h"
#include "kernels/project/row_terms.h"
#include "kernels/project/sort_pixels_simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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
    if (!t.level) fill_limits(f.model, t, begin, whole, w);
    const ClassCounts found =
        t.level ? sort_pixels<true>(t, from, whole, counts, w) : sort_pixels<false>(t, from, whole, counts, w);
    // What filled up the last vector was too far.
    counts.by_class[static_cast<int>(PixelClass::too_far)] -= static_cast<std::uint32_t>(whole - count);
    if (classes != nullptr) write_classes(w, count, classes + begin);
    if (t.narrow.fits && f.narrow) {
      bin_narrow(f, t, found, from, begin, whole, w);
      continue;
    }
    gather_class(PixelClass::obstacle, from, begin, whole, w, w.obstacles);
    gather_class(PixelClass::floor, from, begin, whole, w, w.floor);
    gather_class(PixelClass::drop_off, from, begin, whole, w, w.below);
    bin_obstacles(f, t, w);
    bin_ground(f, t, w.floor, f.grid.floor_count, w);
    bin_ground(f, t, w.below, f.grid.below_count, w);
  }
}

// One index for count and height_sum, in 32 bits.
bool planes_fit(const NavGrid& grid) {
  const std::ptrdiff_t widest =
      std::max({grid.count.stride, grid.floor_count.stride, grid.below_count.stride, grid.height_sum.stride});
  return grid.count.stride == grid.height_sum.stride && widest <= (1 << 30) / grid.geometry.rows;
}

// The index of a cell in 16 bits, 0xFFFF not used.
bool cells_fit(const NavGrid& grid) {
  const std::ptrdiff_t widest = std::max({grid.count.stride, grid.floor_count.stride, grid.below_count.stride});
  return widest <= 0xFFFF / grid.geometry.rows;
}

void project_rows(const PruneModel& model, ImageView<const std::int16_t> disparity, Rows rows, const NavGrid& grid,
                  PixelCounts& counts, ImageView<PixelClass> classes, std::span<std::byte> scratch) {
  const float cells_per_mm = 1.0F / static_cast<float>(grid.geometry.cell_mm);
  Work work;
  const Frame frame{model,
                    grid,
                    cells_per_mm,
                    0.5F * cells_per_mm - 0.5F,
                    cells_fit(grid) && make_depth_pairs(model, work),
                    make_cell_divider(grid.geometry.cell_mm)};
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

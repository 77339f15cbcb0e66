// Sums over the window by running sums: each pixel's gradient enters the sum of its column once and leaves it once, and
// nine column sums make a pixel's. Columns outside the image have no gradient, because their pixels are all alike.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/texture/texture_simd.cc"
#include "hwy/foreach_target.h"
// foreach_target.h comes first, whatever the alphabet says.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "hwy/highway.h"
#include "kernels/texture/texture.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A sum of 63 gradients is at most 16065.
using Sums = hn::ScalableTag<std::int16_t>;
using Bytes = hn::Rebind<std::uint8_t, Sums>;

constexpr int kWindowHeight = 2 * kTextureRadiusV + 1;
constexpr int kStrip = 1024;   // columns at a time, so that their sums need no memory of the caller's
constexpr int kLongest = 128;  // lanes of the longest vector (SVE), written beyond the last column

// Element i belongs to column first + i.
using ColumnSums = std::array<std::int16_t, kStrip + 2 * kTextureRadiusU + kLongest>;

hn::Vec<Sums> gradient(const std::uint8_t* pixel) {
  const Bytes d;
  const auto left = hn::LoadU(d, pixel - 1);
  const auto right = hn::LoadU(d, pixel + 1);
  return hn::PromoteTo(Sums(), hn::Sub(hn::Max(left, right), hn::Min(left, right)));
}

// Columns [begin, end) of the image.
struct Columns {
  int begin;
  int end;
};

// sums = before + the entering row's gradients - the leaving row's (null: none), in `columns` of an image `width` wide;
// element 0 belongs to column `first`.
void move_sums(const std::uint8_t* entering, const std::uint8_t* leaving, int width, int first, Columns columns,
               const ColumnSums& before, ColumnSums& sums) {
  const Sums d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto index = [first](int column) { return static_cast<std::size_t>(column - first); };
  const int end = std::min(columns.end, width - 1);
  for (int u = std::max(columns.begin, 1); u < end; u += lanes) {
    const int at = std::min(u, end - lanes);  // the last vector overlaps the one before
    auto sum = hn::Add(hn::LoadU(d, &before[index(at)]), gradient(entering + at));
    if (leaving != nullptr) sum = hn::Sub(sum, gradient(leaving + at));
    hn::StoreU(sum, d, &sums[index(at)]);
  }
  // The image's first and last column have one neighbour and themselves.
  const auto move_one = [&](int u, int inner) {
    int sum = before[index(u)] + std::abs(entering[u] - entering[inner]);
    if (leaving != nullptr) sum -= std::abs(leaving[u] - leaving[inner]);
    sums[index(u)] = static_cast<std::int16_t>(sum);
  };
  if (columns.begin == 0) move_one(0, 1);
  if (columns.end == width) move_one(width - 1, width - 2);
}

// Row of `out` from the sums of its columns and of kTextureRadiusU more on either side; element 0 is the leftmost.
void compare_row(const ColumnSums& sums, int threshold, int width, std::uint8_t* out) {
  static_assert(kTextureRadiusU == 4, "nine columns are three times three");
  const Sums d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto index = [](int i) { return static_cast<std::size_t>(i); };
  ColumnSums threes;  // element i: columns i, i + 1, i + 2
  for (int i = 0; i < width + 6; i += lanes) {
    const auto sum = hn::Add(hn::Add(hn::LoadU(d, &sums[index(i)]), hn::LoadU(d, &sums[index(i + 1)])),
                             hn::LoadU(d, &sums[index(i + 2)]));
    hn::StoreU(sum, d, &threes[index(i)]);
  }
  const auto below = hn::Set(d, static_cast<std::int16_t>(std::min(threshold, 0x7fff) - 1));
  for (int i = 0; i < width; i += lanes) {
    const int at = std::min(i, width - lanes);
    const auto sum = hn::Add(hn::Add(hn::LoadU(d, &threes[index(at)]), hn::LoadU(d, &threes[index(at + 3)])),
                             hn::LoadU(d, &threes[index(at + 6)]));
    const auto flag = hn::IfThenElseZero(hn::Gt(sum, below), hn::Set(d, 1));
    hn::StoreU(hn::DemoteTo(Bytes(), flag), Bytes(), out + at);
  }
}

void texture_strip(const ImageView<const std::uint8_t>& image, int threshold, Rows rows, Columns strip,
                   const ImageView<std::uint8_t>& textured) {
  const int first = strip.begin - kTextureRadiusU;
  const Columns columns = {std::max(first, 0), std::min(strip.end + kTextureRadiusU, image.width)};
  const auto row = [&](int v) { return image.row(std::clamp(v, 0, image.height - 1)); };
  ColumnSums buffers[2] = {};
  ColumnSums* sums = &buffers[0];
  ColumnSums* before = &buffers[1];
  for (int v = rows.begin - kTextureRadiusV; v < rows.end + kTextureRadiusV; ++v) {
    std::swap(sums, before);
    const std::uint8_t* leaving =
        v - kWindowHeight < rows.begin - kTextureRadiusV ? nullptr : row(v - kWindowHeight);
    move_sums(row(v), leaving, image.width, first, columns, *before, *sums);
    const int centre = v - kTextureRadiusV;
    if (centre < rows.begin) continue;
    compare_row(*sums, threshold, strip.end - strip.begin, textured.row(centre) + strip.begin);
  }
}

// The arguments are right.
Status texture_rows(const ImageView<const std::uint8_t>& image, int threshold, Rows rows,
                    const ImageView<std::uint8_t>& textured) {
  if (rows.begin == rows.end) return Status::ok;
  if (image.width - 2 < static_cast<int>(hn::Lanes(Sums()))) return texture_ref(image, threshold, rows, textured);
  const int strips = (image.width + kStrip - 1) / kStrip;
  for (int i = 0; i < strips; ++i) {
    const Rows strip = rows_of_band(image.width, strips, i);
    texture_strip(image, threshold, rows, {strip.begin, strip.end}, textured);
  }
  return Status::ok;
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lakshya {

HWY_EXPORT(texture_rows);

Status texture_simd(ImageView<const std::uint8_t> image, int threshold, Rows rows,
                    ImageView<std::uint8_t> textured) {
  if (!same_size(image, textured)) return Status::size_mismatch;
  if (threshold < 0 || !rows_inside(rows, image)) return Status::bad_argument;
  return HWY_DYNAMIC_DISPATCH(texture_rows)(image, threshold, rows, textured);
}

}  // namespace lakshya
#endif

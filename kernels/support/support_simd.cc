// A vector of pixels counts its neighbours one by one, and stops when every pixel of it is decided.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/support/support_simd.cc"
#include "hwy/foreach_target.h"
// foreach_target.h comes first, whatever the alphabet says.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/units.h"
#include "kernels/support/support.h"

#ifndef LAKSHYA_SUPPORT_SIMD
#define LAKSHYA_SUPPORT_SIMD
namespace lakshya {

inline constexpr int kMaxSupportRadius = 15;
inline constexpr int kMaxSupportLanes = 32;

// The window of a vector of pixels: rows around the pixel that are inside the image, and where its columns lie.
struct SupportWindow {
  const std::int16_t* center = nullptr;  // the vector's first pixel
  std::ptrdiff_t stride = 0;
  int radius = 0;
  int above = 0;  // rows inside the image, above and below the pixel's own
  int below = 0;
  std::int16_t max_difference = 0;
  const std::int16_t* too_few = nullptr;  // the largest count that is not enough, per lane
};

inline constexpr int kUsualRadius = 4;

// The largest count with 100 count < min_percent pixels.
constexpr std::int16_t too_few_of(int min_percent, int pixels) {
  return static_cast<std::int16_t>((min_percent * pixels + 99) / 100 - 1);
}

}  // namespace lakshya
#endif

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Disparities = hn::CappedTag<std::int16_t, kMaxSupportLanes>;

// kRadius: w.radius, for rows of known length; or 0.
template <int kRadius>
void support_vector(const SupportWindow& w, std::int16_t* out) {
  const Disparities d;
  const auto own = hn::LoadU(d, w.center);
  const auto without = hn::Lt(own, hn::Zero(d));
  if (hn::AllTrue(d, without)) return hn::StoreU(own, d, out);

  // A neighbour counts in [lowest, own + range], lowest being at least 0: less `lowest` and wrapped around, so that the
  // whole interval lies at the lower end of the signed numbers, that is one comparison.
  const auto range = hn::Set(d, w.max_difference);
  const auto end = hn::Set(d, std::int16_t{-32768});
  const auto lowest = hn::Max(hn::SaturatedSub(own, range), hn::Zero(d));
  const auto offset = hn::Sub(end, lowest);
  const auto limit =
      hn::Add(hn::Add(end, hn::Sub(hn::SaturatedAdd(own, range), lowest)), hn::Set(d, std::int16_t{1}));
  const auto too_few = hn::LoadU(d, w.too_few);
  auto count = hn::Zero(d);
  const int radius = kRadius > 0 ? kRadius : w.radius;
  const std::int16_t* center = w.center;
  const std::ptrdiff_t stride = w.stride;
  const auto add_row = [&](int y) HWY_ATTR {
    const std::int16_t* row = center + y * stride;
#pragma GCC unroll 16
    for (int x = -radius; x <= radius; ++x) {
      // A true comparison is -1.
      count = hn::Sub(count, hn::VecFromMask(d, hn::Lt(hn::Add(hn::LoadU(d, row + x), offset), limit)));
    }
  };
  // From the pixel's own row outwards: most pixels of a surface have enough before the window is done.
  add_row(0);
  for (int y = 1; y <= std::max(w.above, w.below); ++y) {
    if (y <= w.above) add_row(-y);
    if (y <= w.below) add_row(y);
    if (hn::AllTrue(d, hn::Or(without, hn::Gt(count, too_few)))) return hn::StoreU(own, d, out);
  }
  const auto keep = hn::Or(without, hn::Gt(count, too_few));
  hn::StoreU(hn::IfThenElse(keep, own, hn::Set(d, std::int16_t{kNoSupport})), d, out);
}

// `count` pixels from column u, some of which have a window that leaves the image: through a copy, surrounded by
// pixels without a disparity.
void support_border(const ImageView<const std::int16_t>& disparity, int u, int count, const SupportParams& p, int v,
                    SupportWindow w, std::int16_t* out) {
  constexpr std::ptrdiff_t kStride = kMaxSupportLanes + 2 * kMaxSupportRadius;
  std::int16_t rows[(2 * kMaxSupportRadius + 1) * kStride];
  std::int16_t too_few[kMaxSupportLanes] = {};
  std::int16_t result[kMaxSupportLanes];
  const int begin = std::max(u - p.radius, 0);
  const int end = std::min(u + count + p.radius, disparity.width);
  std::fill_n(rows, (w.above + 1 + w.below) * kStride, std::int16_t{kNotSearched});
  for (int y = -w.above; y <= w.below; ++y) {
    std::copy(disparity.row(v + y) + begin, disparity.row(v + y) + end,
              rows + (w.above + y) * kStride + begin - (u - p.radius));
  }
  for (int k = 0; k < count; ++k) {
    const int columns = std::min(u + k + p.radius + 1, disparity.width) - std::max(u + k - p.radius, 0);
    too_few[k] = too_few_of(p.min_percent, columns * (w.above + 1 + w.below));
  }
  w.center = rows + w.above * kStride + p.radius;
  w.stride = kStride;
  w.too_few = too_few;
  support_vector<0>(w, result);
  std::copy_n(result, count, out);
}

void support_row(const ImageView<const std::int16_t>& disparity, const SupportParams& p, int v, std::int16_t* out) {
  const Disparities d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  SupportWindow w;
  w.stride = disparity.stride;
  w.radius = p.radius;
  w.above = std::min(p.radius, v);
  w.below = std::min(p.radius, disparity.height - 1 - v);
  w.max_difference = static_cast<std::int16_t>(std::min(p.max_difference, 32767));
  const int pixels = (2 * p.radius + 1) * (w.above + 1 + w.below);
  std::int16_t too_few[kMaxSupportLanes];
  std::fill_n(too_few, lanes, too_few_of(p.min_percent, pixels));
  for (int u = 0; u < disparity.width; u += lanes) {
    if (u >= p.radius && u + lanes + p.radius <= disparity.width) {
      w.center = disparity.row(v) + u;
      w.too_few = too_few;
      if (p.radius == kUsualRadius) {
        support_vector<kUsualRadius>(w, out + u);
      } else {
        support_vector<0>(w, out + u);
      }
    } else {
      support_border(disparity, u, std::min(lanes, disparity.width - u), p, v, w, out + u);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lakshya {

HWY_EXPORT(support_row);

Status support_simd(ImageView<const std::int16_t> disparity, const SupportParams& params, Rows rows,
                    ImageView<std::int16_t> out) {
  if (!same_size(disparity, out)) return Status::size_mismatch;
  if (params.radius < 0 || params.radius > kMaxSupportRadius || params.min_percent < 0 ||
      params.min_percent > 100 || params.max_difference < 0 || !rows_inside(rows, disparity)) {
    return Status::bad_argument;
  }
  for (int v = rows.begin; v < rows.end; ++v)
    HWY_DYNAMIC_DISPATCH(support_row)(disparity, params, v, out.row(v));
  return Status::ok;
}

}  // namespace lakshya
#endif

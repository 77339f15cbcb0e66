// Taking the ground's residual out of the image.
#include <algorithm>
#include <cstddef>

#include "kernels/base/units.h"
#include "kernels/slope/slope.h"
#include "kernels/slope/slope_bins.h"

namespace lakshya {
namespace {

// Of the ground at row v: a straight line between the middles of bins.
int residual_at(const SlopeStrip& slope, int height, int v) {
  const int at =
      (2 * v + 1) * kSlopeBins - height;  // from the first bin's middle, in units of which a bin has 2 * height
  const int bin = at < 0 ? -1 : at / (2 * height);
  const int a = slope.residual16[static_cast<std::size_t>(std::clamp(bin, slope.first, slope.end - 1))];
  const int b = slope.residual16[static_cast<std::size_t>(std::clamp(bin + 1, slope.first, slope.end - 1))];
  const int part = at - bin * 2 * height;
  return a + ((b - a) * part + (b >= a ? height : -height)) / (2 * height);
}

// Of a pixel above the slope's end in the image.
bool says_nothing(const PruneModel& m, const SlopeParams& params, const SlopeStrip& slope, int u, int v,
                  std::int16_t d16) {
  const PixelClass pixel = classify_pixel(m, u, v, d16);
  if (pixel != PixelClass::drop_off && !(pixel == PixelClass::obstacle && slope.goes_on)) return false;
  const ObstaclePoint p = reproject_pixel(m, u, v, d16);
  if (pixel == PixelClass::drop_off) return p.forward_mm > params.drop_reach_mm;
  const std::int64_t way = p.forward_mm - slope.forward_mm;
  const std::int64_t noise = std::int64_t{m.height_mm} * 2 * kSlopeNoise / d16;
  const std::int64_t rise = p.height_mm - slope.height_mm - params.tolerance_mm - noise;
  return rise * 100 <= way * params.steepest_percent;
}

// What the mount's plane takes for a drop-off just so, from 1; a pixel that shows lower ground.
std::int16_t drop_off(const PruneModel& m, int u, int v) {
  const std::int64_t bound = std::min(m.drop_relative.at(u, v), m.drop_absolute.at(u, v));
  return static_cast<std::int16_t>(std::max<std::int64_t>((bound >> kDisparityToQ16) - 1, 1));
}

}  // namespace

Status level_strip(const PruneModel& model, const SlopeParams& params, const Slopes& slopes,
                   ImageView<const std::int16_t> disparity, int strip, ImageView<std::int16_t> levelled) {
  if (!has_slope_boxes(disparity) || !same_size(disparity, levelled)) return Status::size_mismatch;
  if (strip < 0 || strip >= kSlopeStrips) return Status::bad_argument;
  const SlopeStrip& slope = slopes[static_cast<std::size_t>(strip)];
  const SlopeBox all = slope_box(disparity, strip, 0);
  const int begin = slope.found() ? slope_box(disparity, strip, slope.first).top : 0;
  const int end = slope.found() ? slope_box(disparity, strip, slope.end - 1).bottom : 0;
  for (int v = 0; v < disparity.height; ++v) {
    const std::int16_t* const from = disparity.row(v);
    std::int16_t* const to = levelled.row(v);
    std::copy(from + all.left, from + all.right, to + all.left);
    const auto bin = static_cast<std::size_t>(v * kSlopeBins / disparity.height);
    if (slope.fall[bin]) {
      for (int u = all.left; u < all.right; ++u) {
        if (from[u] > 0 && reproject_pixel(model, u, v, from[u]).height_mm < kSlopeSideMm)
          to[u] = drop_off(model, u, v);
      }
      continue;
    }
    if (v >= end || slope.edge[bin]) continue;
    const int residual = v < begin ? 0 : residual_at(slope, disparity.height, v);
    for (int u = all.left; u < all.right; ++u) {
      if (from[u] <= 0) continue;
      if (v < begin) {
        if (says_nothing(model, params, slope, u, v, from[u])) to[u] = 0;
      } else {
        const auto level = static_cast<std::int16_t>(from[u] - residual);
        if (level > 0 && classify_pixel(model, u, v, level) == PixelClass::floor) to[u] = level;
      }
    }
  }
  return Status::ok;
}

}  // namespace lakshya

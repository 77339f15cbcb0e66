// How the image is cut, and where the ground lies in a piece of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "kernels/base/image_view.h"
#include "kernels/base/units.h"
#include "kernels/prune/prune.h"
#include "kernels/slope/slope.h"

namespace lakshya {

struct SlopeBox {
  int left, right, top, bottom;
};

inline SlopeBox slope_box(ImageView<const std::int16_t> image, int strip, int bin) {
  return {image.width * strip / kSlopeStrips, image.width * (strip + 1) / kSlopeStrips,
          image.height * bin / kSlopeBins, image.height * (bin + 1) / kSlopeBins};
}

inline bool has_slope_boxes(ImageView<const std::int16_t> image) {
  return image.width >= kSlopeStrips && image.height >= kSlopeBins;
}

inline std::int64_t slope_sixteenths(std::int64_t q16) {
  return (q16 + (1 << (kDisparityToQ16 - 1))) >> kDisparityToQ16;
}

inline constexpr int kSlopeReach16 = 4 * kDisparityScale;  // of a residual

// Residuals of some pixels.
struct SlopeHistogram {
  std::array<int, 2 * kSlopeReach16 + 1> count{};
  int inside = 0;
  int pixels = 0;

  void add(const SlopeHistogram& other) {
    for (std::size_t i = 0; i < count.size(); ++i)
      count[i] += other.count[i];
    inside += other.inside;
    pixels += other.pixels;
  }
};
using SlopeHistograms = std::array<SlopeHistogram, kSlopeStrips>;  // of one bin

SlopeHistograms slope_histograms(const PruneModel& model, ImageView<const std::int16_t> disparity, int bin);

// Of a strip's ground in a bin, 1/16 px; none: its pixels do not lie at one height.
std::optional<int> slope_residual(const SlopeHistograms& bin, int strip);

}  // namespace lakshya

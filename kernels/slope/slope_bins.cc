// Where the ground lies in a bin.
#include "kernels/slope/slope_bins.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace lakshya {
namespace {

SlopeHistogram histogram_of(const PruneModel& m, ImageView<const std::int16_t> disparity, const SlopeBox& box) {
  SlopeHistogram h;
  h.pixels = (box.right - box.left) * (box.bottom - box.top);
  for (int v = box.top; v < box.bottom; ++v) {
    for (int u = box.left; u < box.right; ++u) {
      const std::int16_t d = disparity.at(u, v);
      if (d <= 0) continue;
      const std::int64_t residual = d - slope_sixteenths(m.floor.at(u, v));
      if (std::abs(residual) > kSlopeReach16) continue;
      ++h.count[static_cast<std::size_t>(residual + kSlopeReach16)];
      ++h.inside;
    }
  }
  return h;
}

// Where most pixels lie.
struct Level {
  int residual16 = 0;
  int percent = 0;  // of those with a disparity that lie there
};

std::optional<Level> level_of(const SlopeHistogram& h) {
  if (h.inside == 0 || h.inside * 100 < h.pixels * kSlopeSeenPercent) return std::nullopt;
  int median = 0;
  for (int below = h.count[0]; 2 * below < h.inside; below += h.count[static_cast<std::size_t>(median)])
    ++median;
  int near = 0;
  for (int k = std::max(median - kSlopeInlier, 0); k <= std::min(median + kSlopeInlier, 2 * kSlopeReach16); ++k)
    near += h.count[static_cast<std::size_t>(k)];
  return Level{median - kSlopeReach16, near * 100 / h.inside};
}

}  // namespace

SlopeHistograms slope_histograms(const PruneModel& model, ImageView<const std::int16_t> disparity, int bin) {
  SlopeHistograms strips;
  for (int s = 0; s < kSlopeStrips; ++s)
    strips[static_cast<std::size_t>(s)] = histogram_of(model, disparity, slope_box(disparity, s, bin));
  return strips;
}

std::optional<int> slope_residual(const SlopeHistograms& bin, int strip) {
  std::optional<Level> best;
  for (const int first : {strip - 1, strip - 2, strip}) {
    SlopeHistogram sum;
    for (int s = std::max(first, 0); s <= std::min(first + 2, kSlopeStrips - 1); ++s)
      sum.add(bin[static_cast<std::size_t>(s)]);
    const std::optional<Level> level = level_of(sum);
    if (level && (!best || level->percent > best->percent)) best = level;
  }
  if (!best || best->percent < kSlopeInlierPercent) best = level_of(bin[static_cast<std::size_t>(strip)]);
  if (!best || best->percent < kSlopeInlierPercent) return std::nullopt;
  return best->residual16;
}

}  // namespace lakshya

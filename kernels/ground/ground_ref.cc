#include <algorithm>
#include <cstdlib>

#include "kernels/base/integer.h"
#include "kernels/base/units.h"
#include "kernels/ground/ground.h"

namespace lakshya {
namespace {

// Index of a residual.
std::size_t bin(std::int64_t residual) {
  return static_cast<std::size_t>(residual + kGroundReach);
}

struct Window {
  std::int64_t count = 0;
  std::int64_t weighted = 0;  // sum of residual * count
};

Window window_at(const GroundHistogram& h, int center) {
  Window w;
  for (int r = std::max(center - kGroundWindow, -kGroundReach); r <= std::min(center + kGroundWindow, kGroundReach);
       ++r) {
    const std::int64_t n = h[bin(r)];
    w.count += n;
    w.weighted += r * n;
  }
  return w;
}

bool stands_out(const Window& best, std::int64_t total, int range, std::int64_t pixels) {
  const int width = 2 * kGroundWindow + 1;
  const int percent = std::min(100 * kGroundContrast * width / (2 * range + 1), kGroundEnoughPercent);
  return best.count > 0 && best.count * 100 >= total * percent &&
         best.count * 100 >= pixels * kGroundMinImagePercent;
}

}  // namespace

Status ground_residuals_ref(const PruneModel& mount, ImageView<const std::int16_t> disparity, Rows rows,
                            GroundHistogram& histogram) {
  if (!rows_inside(rows, disparity)) return Status::bad_argument;
  const std::int64_t nearest_limit = mount.min_disparity;
  for (int v = rows.begin; v < rows.end; ++v) {
    for (int u = 0; u < disparity.width; ++u) {
      const std::int64_t d = std::int64_t{disparity.at(u, v)} << kDisparityToQ16;
      const std::int64_t floor = mount.floor.at(u, v);
      if (d <= 0 || d < nearest_limit || floor < nearest_limit || floor > mount.max_floor_disparity) continue;
      const std::int64_t residual = (d - floor + (1 << (kDisparityToQ16 - 1))) >> kDisparityToQ16;
      if (std::abs(residual) <= kGroundReach) ++histogram[bin(residual)];
    }
  }
  return Status::ok;
}

std::int32_t ground_scatter(const GroundHistogram& histogram, std::int32_t offset16, std::int64_t pixels) {
  const int middle = std::clamp(offset16, -kGroundReach + kGroundWindow, kGroundReach - kGroundWindow);
  const Window whole = window_at(histogram, middle);
  if (whole.count == 0 || whole.count * 100 < pixels * kGroundMinImagePercent) return 0;
  // Three bins: fewer jump, more are wider than a sharp pile.
  const auto height = [&](int center) {
    std::int64_t sum = 0;
    for (int r = std::max(center - 1, -kGroundReach); r <= std::min(center + 1, kGroundReach); ++r)
      sum += histogram[bin(r)];
    return sum;
  };
  std::int64_t top = 0;
  for (int r = middle - kGroundWindow; r <= middle + kGroundWindow; ++r)
    top = std::max(top, height(r));
  // A normal distribution is 1.18 standard deviations wide there.
  constexpr int kWidthPercent = 118;
  constexpr int kWidest = kGroundScatterMost * kWidthPercent / 100;
  int half = 0;
  while (half < kWidest && 2 * height(middle - half) > top && 2 * height(middle + half) > top)
    ++half;
  return (100 * half + kWidthPercent / 2) / kWidthPercent;
}

std::int32_t ground_offset(const GroundHistogram& histogram, std::int32_t range16, std::int64_t pixels) {
  const int range = std::clamp(range16, 0, kGroundReach);
  Window best;
  std::int64_t total = 0;
  for (int distance = 0; distance <= range; ++distance) {
    for (const int center : {distance, -distance}) {
      const Window w = window_at(histogram, center);
      if (w.count > best.count) best = w;
      total += histogram[bin(center)];
      if (distance == 0) break;  // 0 and -0 are one window
    }
  }
  if (!stands_out(best, total, range, pixels)) return 0;
  const auto mean = static_cast<std::int32_t>(floor_divide(2 * best.weighted + best.count, 2 * best.count));
  return std::clamp(mean, -range, range);
}

}  // namespace lakshya

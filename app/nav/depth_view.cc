#include "app/nav/depth_view.h"

#include <algorithm>
#include <cmath>

#include "kernels/base/units.h"

namespace lakshya {
namespace {

constexpr double kNearest = 0.2;  // m of depth
constexpr double kAbove = 0.03;   // m about the mean height
constexpr double kBelow = 0.12;
constexpr double kFloor = 0.10;  // what is lower may be floor
constexpr int kThingShare = 10;  // percent of the pixels looked at
constexpr int kBehindShare = 25;
constexpr double kHigh =
    0.75;  // m: what is higher on the average hangs; a walking person, whose trail must go, is lower
constexpr int kBehindShareHigh = 50;  // of a bar before a wall that shows little most pixels have no disparity

}  // namespace

DepthView::DepthView(const DepthViewParams& params) : params_(params) {
  const double sp = std::sin(params.pitch), cp = std::cos(params.pitch);
  const double sr = std::sin(params.roll), cr = std::cos(params.roll);
  const double sy = std::sin(params.yaw), cy = std::cos(params.yaw);
  const double ahead[3] = {-sp * sr, -sp * cr, cp};
  const double right[3] = {cr, -sr, 0};
  const double down[3] = {cp * sr, cp * cr, sp};
  for (int i = 0; i < 3; ++i) {
    forward_[i] = cy * ahead[i] + sy * right[i];
    left_[i] = sy * ahead[i] - cy * right[i];
    down_[i] = down[i];
  }
}

DepthView::Pixel DepthView::project(double forward_m, double left_m, double height_m) const {
  const double x = forward_m - params_.forward_m;
  const double y = left_m - params_.left_m;
  const double down = params_.height_m - height_m;
  double p[3];
  for (int i = 0; i < 3; ++i)
    p[i] = x * forward_[i] + y * left_[i] + down * down_[i];
  if (p[2] < kNearest) return {};
  return {params_.center_u + params_.focal_px * p[0] / p[2], params_.center_v + params_.focal_px * p[1] / p[2],
          p[2]};
}

Shown DepthView::at(ImageView<const std::int16_t> disparity, double forward_m, double left_m, double height_m,
                    double cell_m) const {
  const Pixel top = project(forward_m, left_m, height_m + kAbove);
  const Pixel low = project(forward_m, left_m, std::max(height_m - kBelow, std::min(kFloor, height_m)));
  if (top.depth_m == 0 || low.depth_m == 0) return Shown::outside;
  const double half = 0.5 * cell_m * params_.focal_px / low.depth_m;
  const int u0 = static_cast<int>(std::floor(low.u - half));
  const int u1 = static_cast<int>(std::ceil(low.u + half));
  const int v0 = static_cast<int>(std::floor(top.v));
  const int v1 = static_cast<int>(std::ceil(low.v));
  if (v0 < kUnmatchedRows || v1 >= disparity.height || u1 < 0 || u0 >= disparity.width) return Shown::outside;
  const double beyond_m = low.depth_m + cell_m + params_.depth_sigma * low.depth_m * low.depth_m;
  const double behind16 = kDisparityScale * params_.focal_px * params_.baseline_m / beyond_m;
  int looked_at = 0;
  int behind = 0;
  int things = 0;
  for (int v = v0; v <= v1; ++v) {
    for (int u = std::max(u0, 0); u <= std::min(u1, disparity.width - 1); ++u) {
      const std::int16_t d = disparity.at(u, v);
      ++looked_at;
      if (d < 0) continue;
      ++(d < behind16 ? behind : things);
    }
  }
  if (100 * things >= kThingShare * looked_at) return Shown::thing;
  const int share = height_m >= kHigh ? kBehindShareHigh : kBehindShare;
  return 100 * behind >= share * looked_at ? Shown::behind : Shown::nothing;
}

}  // namespace lakshya

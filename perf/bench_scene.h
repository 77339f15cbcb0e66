// A camera over a floor with a wall, for the benchmarks of projection and map.
#pragma once

#include <algorithm>
#include <vector>

#include "kernels/prune/prune.h"
#include "perf/bench_image.h"

namespace lakshya::bench {

class Scene {
 public:
  Scene()
      : depth_(prune_table_entries(64)),
        height_(prune_table_entries(64)),
        obstacles_(kWidth),
        floor_(kWidth),
        below_(kWidth) {
    PruneGeometry g;
    g.focal_px = 420;
    g.baseline_m = 0.12;
    g.center_u = 319.5;
    g.center_v = 239.5;
    g.height_m = 0.6;
    g.pitch = 0.087;
    require_ok(build_prune_model(g, depth_, height_, model));
    row.obstacles = obstacles_;
    row.floor = floor_;
    row.below = below_;
  }

  // The floor below the horizon, a wall of 12.5 px (4 m) above it.
  Image<std::int16_t> disparity() const {
    Image<std::int16_t> image(kWidth, kHeight);
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const auto floor = model.floor.at(u, v) >> 12;
        image.view().at(u, v) = static_cast<std::int16_t>(std::max<std::int64_t>(floor, 200));
      }
    }
    return image;
  }

  PruneModel model;
  PrunedRow row;

 private:
  std::vector<std::int32_t> depth_;
  std::vector<std::int32_t> height_;
  std::vector<ObstaclePoint> obstacles_;
  std::vector<GroundStrip> floor_;
  std::vector<GroundStrip> below_;
};

}  // namespace lakshya::bench

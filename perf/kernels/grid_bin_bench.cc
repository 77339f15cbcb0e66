#include "kernels/grid_bin/grid_bin.h"
#include "perf/bench_scene.h"
#include "tests/support/test_grid.h"

namespace lakshya {
namespace {

// Points of one frame, collected first so that only binning is measured.
void grid_bin_reference(benchmark::State& state) {
  bench::Scene scene;
  const Image<std::int16_t> disparity = scene.disparity();
  PixelCounts counts;
  std::vector<ObstaclePoint> obstacles;
  std::vector<GroundStrip> floor;
  for (int v = 0; v < bench::kHeight; ++v) {
    bench::require_ok(
        reproject_prune_row_ref(scene.model, v, {disparity.view().row(v), bench::kWidth}, scene.row, counts, {}));
    const auto row = scene.row.obstacles.first(scene.row.obstacle_count);
    obstacles.insert(obstacles.end(), row.begin(), row.end());
    const auto ground = scene.row.floor.first(scene.row.floor_count);
    floor.insert(floor.end(), ground.begin(), ground.end());
  }
  test::TestGrid grid(200, 200);
  for (auto _ : state) {
    bench::require_ok(bin_obstacles_ref(obstacles, grid.view()));
    bench::require_ok(bin_ground_ref(floor, grid.view(), grid.view().floor_count));
  }
  bench::report_per(state, "per_point", static_cast<double>(obstacles.size() + floor.size()));
}
BENCHMARK(grid_bin_reference)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lakshya

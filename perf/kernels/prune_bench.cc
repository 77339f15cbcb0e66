#include "kernels/prune/prune.h"
#include "perf/bench_scene.h"

namespace lakshya {
namespace {

void prune_reference(benchmark::State& state) {
  bench::Scene scene;
  const Image<std::int16_t> disparity = scene.disparity();
  PixelCounts counts;
  for (auto _ : state) {
    for (int v = 0; v < bench::kHeight; ++v) {
      bench::require_ok(
          reproject_prune_row_ref(scene.model, v, {disparity.view().row(v), bench::kWidth}, scene.row, counts, {}));
    }
    benchmark::DoNotOptimize(counts);
  }
  bench::report_per(state, "per_pixel", bench::kPixels);
}
BENCHMARK(prune_reference)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lakshya

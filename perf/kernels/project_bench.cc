// What follows disparity: the ground estimate, the map cleared, all rows pruned and binned. One thread.
#include <vector>

#include "kernels/base/isa.h"
#include "kernels/grid_bin/grid_bin.h"
#include "kernels/ground/ground.h"
#include "kernels/project/project.h"
#include "perf/bench_scene.h"
#include "tests/support/test_grid.h"

namespace lakshya {
namespace {

void project_frame(benchmark::State& state, decltype(&project_rows_ref) project,
                   decltype(&ground_residuals_ref) residuals) {
  bench::Scene scene;
  const Image<std::int16_t> disparity = scene.disparity();
  test::TestGrid grid(200, 200);
  PixelCounts counts;
  std::vector<std::byte> scratch(project_scratch_bytes(bench::kWidth));
  for (auto _ : state) {
    GroundHistogram histogram{};
    bench::require_ok(residuals(scene.model, disparity.view(), {0, bench::kHeight}, histogram));
    benchmark::DoNotOptimize(histogram);
    bench::require_ok(clear_grid(grid.view()));
    bench::require_ok(
        project(scene.model, disparity.view(), {0, bench::kHeight}, grid.view(), counts, {}, scratch));
    benchmark::DoNotOptimize(counts);
  }
  bench::report_per(state, "per_pixel", bench::kPixels);
}

void project_reference(benchmark::State& state) {
  project_frame(state, project_rows_ref, ground_residuals_ref);
}
BENCHMARK(project_reference)->Unit(benchmark::kMillisecond);

// By instruction set, best first.
void project_simd(benchmark::State& state) {
  const char* isa = available_isas()[static_cast<std::size_t>(state.range(0))];
  bench::require_ok(use_isa(isa));
  state.SetLabel(isa);
  project_frame(state, project_rows_simd, ground_residuals_simd);
  bench::require_ok(use_isa("best"));
}
BENCHMARK(project_simd)
    ->DenseRange(0, static_cast<int>(available_isas().size()) - 1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lakshya

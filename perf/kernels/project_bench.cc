// What follows disparity: the ground estimate, the map cleared, all rows pruned and binned. One thread.
#include <vector>

#include "kernels/grid_bin/grid_bin.h"
#include "kernels/ground/ground.h"
#include "kernels/project/project.h"
#include "perf/bench_scene.h"
#include "tests/support/test_grid.h"

namespace lakshya {
namespace {

template <auto kProject, auto kResiduals>
void project_frame(benchmark::State& state) {
  bench::Scene scene;
  const Image<std::int16_t> disparity = scene.disparity();
  test::TestGrid grid(200, 200);
  PixelCounts counts;
  std::vector<std::byte> scratch(project_scratch_bytes(bench::kWidth));
  for (auto _ : state) {
    GroundHistogram histogram{};
    bench::require_ok(kResiduals(scene.model, disparity.view(), {0, bench::kHeight}, histogram));
    benchmark::DoNotOptimize(histogram);
    bench::require_ok(clear_grid(grid.view()));
    bench::require_ok(
        kProject(scene.model, disparity.view(), {0, bench::kHeight}, grid.view(), counts, {}, scratch));
    benchmark::DoNotOptimize(counts);
  }
  bench::report_per(state, "per_pixel", bench::kPixels);
}

BENCHMARK(project_frame<project_rows_ref, ground_residuals_ref>)
    ->Name("project_reference")
    ->Unit(benchmark::kMillisecond);

const bool kRegistered =
    bench::register_each_isa("project_simd", project_frame<project_rows_simd, ground_residuals_simd>);

}  // namespace
}  // namespace lakshya

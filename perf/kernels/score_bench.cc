#include <vector>

#include "kernels/score/score.h"
#include "perf/bench_image.h"
#include "tests/support/test_grid.h"

namespace lakshya {
namespace {

void score_frame(benchmark::State& state, decltype(&score_ref) score) {
  test::TestGrid grid(200, 200);
  ScoreGeometry geometry;
  geometry.focal_px = 420;
  geometry.baseline_m = 0.12;
  geometry.height_m = 0.6;
  std::vector<CellThresholds> thresholds(std::size_t{200} * 200);
  bench::require_ok(build_score_table(grid.view().geometry, geometry, thresholds));
  for (auto _ : state)
    bench::require_ok(score(thresholds, 70, grid.view()));
  bench::report_per(state, "per_cell", 200.0 * 200.0);
}
BENCHMARK_CAPTURE(score_frame, ref, score_ref)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(score_frame, simd, score_simd)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace lakshya

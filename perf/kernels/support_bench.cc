#include "kernels/support/support.h"
#include "perf/bench_image.h"

namespace lakshya {
namespace {

void support_reference(benchmark::State& state) {
  const auto disparity = bench::random_image<std::int16_t>(-5, 200);
  Image<std::int16_t> out(bench::kWidth, bench::kHeight);
  for (auto _ : state) {
    bench::require_ok(support_ref(disparity.view(), {}, {0, bench::kHeight}, out.view()));
    benchmark::DoNotOptimize(out.view().data);
  }
  bench::report_per(state, "per_pixel", bench::kPixels);
}
BENCHMARK(support_reference)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lakshya

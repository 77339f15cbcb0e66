#include "kernels/rectify/rectify.h"
#include "perf/bench_image.h"

namespace lakshya {
namespace {

void rectify_reference(benchmark::State& state) {
  const auto raw = bench::random_image<std::uint8_t>(0, 255);
  Image<std::int32_t> map_x(bench::kWidth, bench::kHeight);
  Image<std::int32_t> map_y(bench::kWidth, bench::kHeight);
  for (int v = 0; v < bench::kHeight; ++v) {
    for (int u = 0; u < bench::kWidth; ++u) {
      map_x.view().at(u, v) = u * 128 + 37;
      map_y.view().at(u, v) = v * 128 + u / 8;
    }
  }
  Image<std::uint8_t> out(bench::kWidth, bench::kHeight);
  for (auto _ : state) {
    bench::require_ok(rectify_ref(raw.view(), map_x.view(), map_y.view(), {0, bench::kHeight}, out.view()));
    benchmark::DoNotOptimize(out.view().data);
  }
  bench::report_per(state, "per_pixel", bench::kPixels);
}
BENCHMARK(rectify_reference)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lakshya

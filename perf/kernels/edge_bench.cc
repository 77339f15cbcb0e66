#include "kernels/edge/edge.h"
#include "perf/bench_image.h"

namespace lakshya {
namespace {

template <auto kFilter>
void edge_kernel(benchmark::State& state) {
  const auto image = bench::random_image<std::uint8_t>(0, 255);
  Image<std::uint8_t> edges(bench::kWidth, bench::kHeight);
  for (auto _ : state) {
    bench::require_ok(kFilter(image.view(), 31, {0, bench::kHeight}, edges.view()));
    benchmark::DoNotOptimize(edges.view().data);
  }
  bench::report_per(state, "per_pixel", bench::kPixels);
}
BENCHMARK(edge_kernel<edge_sobel_ref>)->Name("edge_sobel_reference")->Unit(benchmark::kMillisecond);
BENCHMARK(edge_kernel<edge_log_ref>)->Name("edge_log_reference")->Unit(benchmark::kMillisecond);

const bool kRegistered = bench::register_each_isa("edge_sobel_simd", edge_kernel<edge_sobel_simd>) &&
                         bench::register_each_isa("edge_log_simd", edge_kernel<edge_log_simd>);

}  // namespace
}  // namespace lakshya

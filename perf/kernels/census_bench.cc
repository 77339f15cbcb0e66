#include "kernels/census/census.h"
#include "perf/bench_image.h"

namespace lakshya {
namespace {

template <auto kCensus>
void census_kernel(benchmark::State& state) {
  const auto image = bench::random_image<std::uint8_t>(0, 255);
  Image<CensusCode> codes(bench::kWidth, bench::kHeight);
  for (auto _ : state) {
    bench::require_ok(kCensus(image.view(), {0, bench::kHeight}, codes.view()));
    benchmark::DoNotOptimize(codes.view().data);
  }
  bench::report_per(state, "per_pixel", bench::kPixels);
}
BENCHMARK(census_kernel<census_ref>)->Name("census_reference")->Unit(benchmark::kMillisecond);

const bool kRegistered = bench::register_each_isa("census_simd", census_kernel<census_simd>);

}  // namespace
}  // namespace lakshya

#include "kernels/texture/texture.h"
#include "perf/bench_image.h"

namespace lakshya {
namespace {

template <auto kTexture>
void texture_kernel(benchmark::State& state) {
  const auto image = bench::random_image<std::uint8_t>(0, 255);
  Image<std::uint8_t> textured(bench::kWidth, bench::kHeight);
  for (auto _ : state) {
    bench::require_ok(kTexture(image.view(), 100, {0, bench::kHeight}, textured.view()));
    benchmark::DoNotOptimize(textured.view().data);
  }
  bench::report_per(state, "per_pixel", bench::kPixels);
}
BENCHMARK(texture_kernel<texture_ref>)->Name("texture_reference")->Unit(benchmark::kMillisecond);

const bool kRegistered = bench::register_each_isa("texture_simd", texture_kernel<texture_simd>);

}  // namespace
}  // namespace lakshya

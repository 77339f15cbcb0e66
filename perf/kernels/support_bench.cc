#include "kernels/support/support.h"
#include "perf/bench_image.h"

namespace lakshya {
namespace {

// Noise, where nearly every pixel needs its whole window, and a slanted surface with a hole in eight pixels, where the
// early decision helps.
Image<std::int16_t> surface() {
  Image<std::int16_t> image = bench::random_image<std::int16_t>(0, 7);
  for (int v = 0; v < bench::kHeight; ++v) {
    for (int u = 0; u < bench::kWidth; ++u) {
      std::int16_t& d = image.view().at(u, v);
      d = static_cast<std::int16_t>(d == 0 ? -3 : 300 + v + d);
    }
  }
  return image;
}

Image<std::int16_t> noise() {
  return bench::random_image<std::int16_t>(-5, 200);
}

template <auto kSupport, auto kDisparity>
void support(benchmark::State& state) {
  const Image<std::int16_t> disparity = kDisparity();
  Image<std::int16_t> out(bench::kWidth, bench::kHeight);
  for (auto _ : state) {
    bench::require_ok(kSupport(disparity.view(), {}, {0, bench::kHeight}, out.view()));
    benchmark::DoNotOptimize(out.view().data);
  }
  bench::report_per(state, "per_pixel", bench::kPixels);
}
BENCHMARK(support<support_ref, noise>)->Name("support_reference_noise")->Unit(benchmark::kMillisecond);
BENCHMARK(support<support_ref, surface>)->Name("support_reference_surface")->Unit(benchmark::kMillisecond);

const bool kRegistered = bench::register_each_isa("support_simd_noise", support<support_simd, noise>) &&
                         bench::register_each_isa("support_simd_surface", support<support_simd, surface>);

}  // namespace
}  // namespace lakshya

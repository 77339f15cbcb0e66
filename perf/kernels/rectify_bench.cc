#include <cmath>

#include "kernels/rectify/rectify.h"
#include "perf/bench_image.h"

namespace lakshya {
namespace {

// A wide lens: barrel distortion and a small rotation, everything inside the raw image.
struct Lens {
  Image<std::int16_t> x = Image<std::int16_t>(bench::kWidth, bench::kHeight);
  Image<std::int16_t> y = Image<std::int16_t>(bench::kWidth, bench::kHeight);
  Image<std::uint16_t> fraction = Image<std::uint16_t>(bench::kWidth, bench::kHeight);

  Lens() {
    constexpr double kFocal = 450;
    for (int v = 0; v < bench::kHeight; ++v) {
      for (int u = 0; u < bench::kWidth; ++u) {
        const double ideal_x = (u - bench::kWidth / 2.0 + 0.01 * v) / kFocal;
        const double ideal_y = (v - bench::kHeight / 2.0 - 0.01 * u) / kFocal;
        const double radial = 1 - 0.28 * (ideal_x * ideal_x + ideal_y * ideal_y);
        const long px = std::lround((kFocal * ideal_x * radial + bench::kWidth / 2.0) * 128);
        const long py = std::lround((kFocal * ideal_y * radial + bench::kHeight / 2.0) * 128);
        x.view().at(u, v) = static_cast<std::int16_t>(px >> kRectifyFractionBits);
        y.view().at(u, v) = static_cast<std::int16_t>(py >> kRectifyFractionBits);
        fraction.view().at(u, v) = rectify_fraction(static_cast<int>(px & 127), static_cast<int>(py & 127));
      }
    }
  }
  RectifyMap view() const { return {x.view(), y.view(), fraction.view()}; }
};

template <auto kRectify>
void rectify_kernel(benchmark::State& state) {
  const auto raw = bench::random_image<std::uint8_t>(0, 255);
  const Lens lens;
  Image<std::uint8_t> out(bench::kWidth, bench::kHeight);
  for (auto _ : state) {
    bench::require_ok(kRectify(raw.view(), lens.view(), {0, bench::kHeight}, out.view()));
    benchmark::DoNotOptimize(out.view().data);
  }
  bench::report_per(state, "per_pixel", bench::kPixels);
}
BENCHMARK(rectify_kernel<rectify_ref>)->Name("rectify_reference")->Unit(benchmark::kMillisecond);

const bool kRegistered = bench::register_each_isa("rectify_simd", rectify_kernel<rectify_simd>);

}  // namespace
}  // namespace lakshya

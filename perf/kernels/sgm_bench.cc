// The whole matching of a band: cost, aggregation, selection.
#include "app/core/arena.h"
#include "kernels/sgm/sgm.h"
#include "perf/bench_image.h"

namespace lakshya {
namespace {

void sgm_reference(benchmark::State& state) {
  const int disparities = static_cast<int>(state.range(0));
  const auto left = bench::random_image<CensusCode>(0, 0xFFFF, 1);
  const auto right = bench::random_image<CensusCode>(0, 0xFFFF, 2);
  const auto image = bench::random_image<std::uint8_t>(0, 255, 3);
  const Image<std::uint8_t> textured(bench::kWidth, bench::kHeight, 1);
  Image<std::int16_t> disparity(bench::kWidth, bench::kHeight);
  SgmParams params;
  params.range = {.first = 0, .disparities = disparities, .valid_begin = 0, .valid_end = bench::kWidth};
  params.paths = static_cast<int>(state.range(1));
  const std::size_t bytes = sgm_scratch_bytes(bench::kWidth, disparities);
  Arena arena(bytes);
  const std::span<std::byte> scratch = arena.take<std::byte>(bytes);
  for (auto _ : state) {
    bench::require_ok(sgm_ref(image.view(), left.view(), right.view(), textured.view(), {0, bench::kHeight}, params,
                              {0, bench::kHeight}, scratch, disparity.view()));
    benchmark::DoNotOptimize(disparity.view().data);
  }
  bench::report_per(state, "per_pixel_disparity", double{bench::kPixels} * disparities);
}
BENCHMARK(sgm_reference)->Args({64, 3})->Args({64, 5})->Args({128, 3})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lakshya

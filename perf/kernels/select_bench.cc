#include <vector>

#include "kernels/select/select.h"
#include "perf/bench_image.h"

namespace lakshya {
namespace {

void select_reference(benchmark::State& state) {
  const int disparities = static_cast<int>(state.range(0));
  std::mt19937 random(3);
  std::vector<std::uint16_t> sums(static_cast<std::size_t>(bench::kWidth * disparities));
  for (std::uint16_t& s : sums)
    s = static_cast<std::uint16_t>(random() % 300);
  const std::vector<std::uint8_t> textured(bench::kWidth, 1);
  std::vector<std::int16_t> scratch(select_scratch_elements(bench::kWidth));
  std::vector<std::int16_t> disparity(bench::kWidth);
  const SearchRange range{.first = 0, .disparities = disparities, .valid_begin = 4, .valid_end = bench::kWidth - 4};
  for (auto _ : state) {
    bench::require_ok(select_row_ref(sums, textured, range, {}, scratch, disparity));
    benchmark::DoNotOptimize(disparity.data());
  }
  bench::report_per(state, "per_pixel_disparity", bench::kWidth * disparities);
}
BENCHMARK(select_reference)->Arg(64)->Arg(128);

}  // namespace
}  // namespace lakshya

#include <vector>

#include "kernels/sad/sad.h"
#include "perf/bench_image.h"

namespace lakshya {
namespace {

void sad_reference(benchmark::State& state) {
  const int disparities = static_cast<int>(state.range(0));
  const auto edges = bench::random_image<std::uint8_t>(0, 62);
  const std::span<const std::uint8_t> left(edges.view().row(0), bench::kWidth);
  const std::span<const std::uint8_t> right(edges.view().row(1), bench::kWidth);
  const SearchRange range{.first = 0, .disparities = disparities, .valid_begin = 4, .valid_end = bench::kWidth - 4};
  std::vector<std::uint8_t> cost(static_cast<std::size_t>(bench::kWidth * disparities));
  for (auto _ : state) {
    bench::require_ok(sad_row_ref(left, right, range, sad_outside_cost(31), cost));
    benchmark::DoNotOptimize(cost.data());
  }
  bench::report_per(state, "per_pixel_disparity", bench::kWidth * disparities);
}
BENCHMARK(sad_reference)->Arg(64)->Arg(128);

}  // namespace
}  // namespace lakshya

#include <vector>

#include "kernels/hamming/hamming.h"
#include "perf/bench_image.h"

namespace lakshya {
namespace {

void hamming_reference(benchmark::State& state) {
  const int disparities = static_cast<int>(state.range(0));
  const auto codes = bench::random_image<CensusCode>(0, 0xFFFF);
  const std::span<const CensusCode> left(codes.view().row(0), bench::kWidth);
  const std::span<const CensusCode> right(codes.view().row(1), bench::kWidth);
  const SearchRange range{.first = 0, .disparities = disparities, .valid_begin = 4, .valid_end = bench::kWidth - 4};
  std::vector<std::uint8_t> cost(static_cast<std::size_t>(bench::kWidth * disparities));
  for (auto _ : state) {
    bench::require_ok(hamming_row_ref(left, right, range, cost));
    benchmark::DoNotOptimize(cost.data());
  }
  bench::report_per(state, "per_pixel_disparity", bench::kWidth * disparities);
}
BENCHMARK(hamming_reference)->Arg(64)->Arg(128);

void smooth_cost_reference(benchmark::State& state) {
  const int disparities = static_cast<int>(state.range(0));
  const SearchRange range{.first = 0, .disparities = disparities, .valid_begin = 0, .valid_end = bench::kWidth};
  const std::vector<std::uint8_t> row(static_cast<std::size_t>(bench::kWidth * disparities), 7);
  std::vector<std::uint8_t> out(row.size());
  for (auto _ : state) {
    bench::require_ok(smooth_cost_row_ref(row, row, row, range, out));
    benchmark::DoNotOptimize(out.data());
  }
  bench::report_per(state, "per_pixel_disparity", bench::kWidth * disparities);
}
BENCHMARK(smooth_cost_reference)->Arg(64)->Arg(128);

}  // namespace
}  // namespace lakshya

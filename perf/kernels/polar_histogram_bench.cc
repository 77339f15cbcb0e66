// Polar histogram on the default map (200 x 200 cells of 0.1 m), by share of obstacle cells in percent.
#include <vector>

#include "kernels/base/units.h"
#include "kernels/polar_histogram/polar_histogram.h"
#include "perf/bench_image.h"

namespace lakshya {
namespace {

constexpr GridGeometry kGeometry{};
constexpr PolarParams kParams{};
constexpr double kCells = kGeometry.rows * kGeometry.cols;

Image<std::uint8_t> scattered_obstacles(int percent) {
  std::mt19937 random(1);
  Image<std::uint8_t> type(kGeometry.cols, kGeometry.rows, kCellUnoccupied);
  for (int r = 0; r < kGeometry.rows; ++r) {
    for (int c = 0; c < kGeometry.cols; ++c)
      if (static_cast<int>(random() % 100) < percent) type.view().at(c, r) = kCellObstacle;
  }
  return type;
}

void polar_table(benchmark::State& state) {
  std::vector<PolarEntry> table(polar_table_entries(kGeometry));
  for (auto _ : state) {
    bench::require_ok(build_polar_table(kGeometry, kParams, table));
    benchmark::DoNotOptimize(table.data());
  }
  bench::report_per(state, "per_cell", kCells);
}
BENCHMARK(polar_table);

void polar_histogram(benchmark::State& state, decltype(&polar_histogram_ref) sum, const PolarWindow& window) {
  std::vector<PolarEntry> table(polar_table_entries(kGeometry));
  bench::require_ok(build_polar_table(kGeometry, kParams, table));
  const auto type = scattered_obstacles(static_cast<int>(state.range(0)));
  PolarHistogram histogram{};
  for (auto _ : state) {
    bench::require_ok(sum(type.view(), table, histogram, window));
    benchmark::DoNotOptimize(histogram.data());
  }
  bench::report_per(state, "per_cell", kCells);
}
BENCHMARK_CAPTURE(polar_histogram, ref_whole_grid, polar_histogram_ref, PolarWindow{})->Arg(0)->Arg(5)->Arg(50);
BENCHMARK_CAPTURE(polar_histogram, ref_active_window, polar_histogram_ref, polar_window(kGeometry, kParams))
    ->Arg(0)
    ->Arg(5)
    ->Arg(50);
BENCHMARK_CAPTURE(polar_histogram, simd_active_window, polar_histogram_simd, polar_window(kGeometry, kParams))
    ->Arg(0)
    ->Arg(5)
    ->Arg(50);

}  // namespace
}  // namespace lakshya

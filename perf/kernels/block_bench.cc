// The whole matching of a band: cost, window sums, selection. Arguments: disparities, radius of the window.
#include "app/core/arena.h"
#include "kernels/block/block.h"
#include "perf/bench_image.h"

namespace lakshya {
namespace {

template <class Descriptor, auto kMatch>
void block(benchmark::State& state, int disparities, int radius) {
  constexpr int kLargest = sizeof(Descriptor) == 1 ? 62 : 0xFFFF;
  const auto left = bench::random_image<Descriptor>(0, kLargest, 1);
  const auto right = bench::random_image<Descriptor>(0, kLargest, 2);
  const Image<std::uint8_t> textured(bench::kWidth, bench::kHeight, 1);
  Image<std::int16_t> disparity(bench::kWidth, bench::kHeight);
  BlockParams params;
  params.range = {.first = 0, .disparities = disparities, .valid_begin = 4, .valid_end = bench::kWidth - 4};
  params.radius_u = params.radius_v = radius;
  const std::size_t bytes = block_scratch_bytes(bench::kWidth, disparities, params.radius_v);
  Arena arena(bytes);
  const std::span<std::byte> scratch = arena.take<std::byte>(bytes);
  for (auto _ : state) {
    bench::require_ok(kMatch(left.view(), right.view(), textured.view(), {4, bench::kHeight - 4}, params,
                             {0, bench::kHeight}, scratch, disparity.view()));
    benchmark::DoNotOptimize(disparity.view().data);
  }
  bench::report_per(state, "per_pixel_disparity", double{bench::kPixels} * disparities);
}

template <class Descriptor, auto kMatch>
void block_reference(benchmark::State& state) {
  block<Descriptor, kMatch>(state, static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
}

// The pipeline's defaults.
template <class Descriptor, auto kMatch>
void block_simd(benchmark::State& state) {
  block<Descriptor, kMatch>(state, 64, 5);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->Args({64, 4})->Args({64, 5})->Args({64, 7})->Args({128, 4})->Unit(benchmark::kMillisecond);
}
BENCHMARK(block_reference<CensusCode, census_block_ref>)->Name("census_block_reference")->Apply(sizes);
BENCHMARK(block_reference<std::uint8_t, sad_block_ref>)->Name("sad_block_reference")->Apply(sizes);

const bool kRegistered = bench::register_each_isa("census_block_simd", block_simd<CensusCode, census_block_simd>) &&
                         bench::register_each_isa("sad_block_simd", block_simd<std::uint8_t, sad_block_simd>);

}  // namespace
}  // namespace lakshya

// Random input of the usual frame size for the benchmarks; fixed seeds, so that runs compare.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "app/core/image.h"
#include "kernels/base/isa.h"
#include "kernels/base/status.h"

namespace lakshya::bench {

inline constexpr int kWidth = 640;
inline constexpr int kHeight = 480;
inline constexpr int kPixels = kWidth * kHeight;

template <class T>
Image<T> random_image(int low, int high, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::int64_t> value(low, high);
  Image<T> image(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u)
      image.view().at(u, v) = static_cast<T>(value(random));
  }
  return image;
}

// A benchmark of a kernel that refuses its input would measure nothing.
inline void require_ok(Status status) {
  if (status == Status::ok) return;
  std::fprintf(stderr, "benchmark input refused: %s\n", to_string(status));
  std::abort();
}

// Time per pixel (or per `items` of another kind), in seconds.
inline void report_per(benchmark::State& state, const char* name, double items) {
  state.counters[name] =
      benchmark::Counter(items, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// One row for each instruction set that this machine has: NAME/avx2.
inline bool register_each_isa(const std::string& name, void (*run)(benchmark::State&)) {
  for (const char* isa : available_isas()) {
    const auto on_isa = [isa, run](benchmark::State& state) {
      require_ok(use_isa(isa));
      run(state);
      require_ok(use_isa("best"));
    };
    benchmark::RegisterBenchmark((name + "/" + isa).c_str(), on_isa)->Unit(benchmark::kMillisecond);
  }
  return true;
}

}  // namespace lakshya::bench

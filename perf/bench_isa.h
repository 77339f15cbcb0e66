// Benchmarks of *_simd kernels: one row per instruction set, Apply(each_isa), and choose_isa at the beginning.
#pragma once

#include <benchmark/benchmark.h>

#include "kernels/base/isa.h"
#include "perf/bench_image.h"

namespace lakshya::bench {

inline void each_isa(benchmark::internal::Benchmark* b) {
  for (int i = 0; i < static_cast<int>(available_isas().size()); ++i)
    b->Arg(i);
}

inline void choose_isa(benchmark::State& state) {
  const char* isa = available_isas()[static_cast<std::size_t>(state.range(0))];
  require_ok(use_isa(isa));
  state.SetLabel(isa);
}

}  // namespace lakshya::bench

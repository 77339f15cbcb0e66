// One setting of `lakshya bench`: what is measured, on what, and what came out.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/core/kernel_table.h"
#include "app/core/vehicle_config.h"
#include "app/tools/bench_input.h"
#include "app/tools/bench_measure.h"

namespace lakshya {

// In the order in which they are reported; docs/performance.md says what each one is.
inline constexpr std::array<const char*, 8> kBenchRows{"rectify",   "sad",    "census",          "sgm",
                                                       "sgm_vs_bm", "ground", "project_and_bin", "frame"};

struct BenchSetting {
  int width = 640;
  int height = 480;
  int threads = 1;
  VehicleConfig config;          // with the disparities
  std::string backend = "simd";  // the kernels' name, for the report
  KernelTable kernels = kSimdKernels;
  std::vector<std::string> rows{kBenchRows.begin(), kBenchRows.end()};
  BenchRounds rounds;
  int reference_runs = 3;  // 0: the scalar reference is not timed
  BenchPair pair;
};

struct BenchRow {
  std::string name;
  double ms = 0;
  std::optional<double> reference_ms;
  std::string peer;  // empty: nothing to compare with
  std::optional<double> peer_ms;
  std::optional<double> speedup() const { return peer_ms ? std::optional(*peer_ms / ms) : std::nullopt; }
};

struct BenchResult {
  std::string backend;
  std::string isa;
  int width = 0;
  int height = 0;
  int disparities = 0;
  int threads = 0;
  int bands = 0;
  double density = 0;         // share of the pixels with a disparity (sgm)
  double obstacle_share = 0;  // share of the pixels that the map gets as obstacle points, and as floor
  double floor_share = 0;
  std::vector<BenchRow> rows;
};

// The vehicle that is measured: the defaults, with the camera mounted as in bench_scene.h. `sets`: KEY=VALUE.
VehicleConfig bench_config(int disparities, const std::vector<std::string>& sets);

// Processors that this process may use.
int usable_processors();

// On the instruction set in use (kernels/base/isa.h). `before` is told each row's name. Throws InputError: a size,
// search range or number of threads that cannot be measured here, or a pair that cannot be read.
BenchResult run_bench(const BenchSetting& setting, const std::function<void(const std::string&)>& before);

}  // namespace lakshya

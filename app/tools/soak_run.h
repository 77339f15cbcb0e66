// The endurance test: the firmware's own loop on the virtual clock, a recording again and again, one fault after the other, and
// whether memory, handles or latency grow meanwhile.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "app/core/kernel_table.h"
#include "app/core/vehicle_config.h"
#include "app/tools/soak_checker.h"

namespace lakshya {

struct SoakSettings {
  std::string source;
  std::string config_path;  // where relative paths in the configuration begin
  std::uint64_t frames = 100'000;
  std::uint64_t seed = 1;
};

// The configuration with what the endurance test needs: recorded pairs at folder.rate_hz again and again, no way points, a compass
// and drives that only count.
VehicleConfig soak_config(VehicleConfig config);

// How the process was after so many frames; times and faults since the sample before.
struct SoakSample {
  std::uint64_t frames = 0;
  Nanoseconds time = 0;  // virtual, since the start
  std::uint64_t faults = 0;
  std::uint64_t resident_bytes = 0;
  std::uint64_t handles = 0;
  Nanoseconds p50 = 0;  // of perception's time for a frame, on the machine's clock
  Nanoseconds p99 = 0;
  std::uint64_t allocations = 0;  // by the loop
};

struct SoakResult {
  SoakSettings settings;
  SoakLimits limits;
  int pairs = 0;  // of the recording
  int width = 0;
  int height = 0;
  std::uint64_t frames = 0;
  std::uint64_t turns = 0;
  Nanoseconds virtual_time = 0;
  double wall_s = 0;
  Nanoseconds start = 0;  // of virtual time
  bool allocations_are_counted = false;
  std::vector<SoakSample> samples;
  std::array<FaultRecord, kFaultKinds> records{};
  std::uint64_t faults = 0;
  std::uint64_t violations = 0;
  std::vector<SoakViolation> first_violations;
};

// `progress`, if there is one, is called now and then. Throws InputError where the loop cannot begin.
SoakResult run_soak(const VehicleConfig& config, const SoakSettings& settings, const KernelTable& kernels,
                    const std::function<void(const SoakResult& so_far)>& progress);

// How the last fifth of the run compares with the second one; the first is for warming up.
struct SoakGrowth {
  double resident_before = 0;  // bytes, mean
  double resident_after = 0;
  std::uint64_t handles_before = 0;  // most
  std::uint64_t handles_after = 0;
  double p50_before_ms = 0;  // median of the windows' medians
  double p50_after_ms = 0;
};
SoakGrowth soak_growth(const SoakResult& result);

struct SoakVerdict {
  std::vector<std::string> failures;  // none: passed
  std::vector<std::string> warnings;
};
SoakVerdict soak_verdict(const SoakResult& result);

}  // namespace lakshya

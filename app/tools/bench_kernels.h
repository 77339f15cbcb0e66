// Each kernel's time within a frame on one thread, and the machine's limits beside it.
#pragma once

#include <string>
#include <vector>

#include "app/tools/bench_setting.h"

namespace lakshya {

// What a kernel has to do for one item by its definition, whatever the implementation does. An operation on a lane of
// n bytes counts n, because it takes that much room in a vector; loads and stores are not counted. Bytes are what
// goes between the core and the caches beyond its first-level cache.
struct KernelWork {
  const char* name;     // member of KernelTable
  const char* matcher;  // the matcher whose frame it is timed in
  bool per_disparity;   // an item is a pixel and disparity; else a pixel
  double operations;
  double bytes;
};

struct KernelTime {
  std::string isa;
  KernelWork work;
  double ms = 0;  // per frame
  double items = 0;
  double operations_per_s() const { return work.operations * items / (ms * 1e-3); }
};

// On the instruction set in use and one thread, medians of `runs` frames.
std::vector<KernelTime> time_kernels(const BenchSetting& setting, int runs);

struct MachinePeak {
  std::string isa;
  double operations_per_s = 0;  // operations on one byte
  double l2_bytes_per_s = 0;
  double memory_bytes_per_s = 0;
};
// Of one core, on the instruction set in use.
MachinePeak measure_peak();

}  // namespace lakshya

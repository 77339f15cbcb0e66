// One run of the main loop from start to report: what `run` and `replay` of both programs do.
#pragma once

#include <string>

#include "app/core/kernel_table.h"
#include "app/core/vehicle_config.h"
#include "app/loop/perception.h"
#include "app/loop/stepped_run.h"

namespace lakshya {

struct SessionOptions {
  std::string config_path;  // where relative paths in the configuration begin
  std::string source;       // for the report
  bool virtual_clock = false;
  RunLimits limits;
  std::string report;               // file; empty: none
  std::string latch;                // file that keeps the state FAULT over a crash; empty: none
  std::string out;                  // folder; empty: none
  std::uint64_t picture_every = 1;  // with `out`: a map picture for every so many plans; 0: none
  bool json = false;                // the report to stdout as JSON
};

// Runs until the end that the limits, the recording or a signal set; the report goes to stdout, messages and status to stderr.
// Throws InputError where it cannot begin: nothing is written then.
void run_session(const VehicleConfig& config, const SessionOptions& options, const KernelTable& kernels);

}  // namespace lakshya

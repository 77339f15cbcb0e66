// What `lakshya profile` prints.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/tools/profile_run.h"

namespace lakshya {

struct ProfileReport {
  std::string isa;
  std::string backend;
  std::string matcher;
  int threads = 1;
  int width = 0;
  int height = 0;
  int disparities = 0;
  std::size_t arena_bytes = 0;
  Nanoseconds measuring = 0;  // per frame
  const StageTimes& times;
  const ProfileCounts& counts;
};

// isa, backend, matcher, threads, width, height, disparities, frames, arena_bytes, stages: [{"stage", "of" (match's
// passes), "p50_ms", "p99_ms", "max_ms", "share"}], the first of them the whole frame; pruning: [{"step", "in", "out"}]
// and cells, both means of a frame; measuring: {"us_per_frame", "share"}. Shares are of the frames' time, 0 to 1.
nlohmann::ordered_json profile_json(const ProfileReport& report);

std::string profile_table(const ProfileReport& report);

}  // namespace lakshya

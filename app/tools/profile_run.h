// Frame after frame through one pipeline, with its counters: what `lakshya profile` measures.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "app/core/pipeline.h"

namespace lakshya {

// Sums over the frames.
struct ProfileCounts {
  std::uint64_t frames = 0;
  std::uint64_t pixels = 0;
  std::uint64_t without_disparity = 0;
  std::array<std::uint64_t, kPixelClasses> by_class{};
  std::uint64_t points_in_map = 0;
  std::array<std::uint64_t, 3> cells{};  // index CellType
};

// One step of pruning: what comes in, and what goes on to the next step.
struct PruningStep {
  const char* name;
  std::uint64_t in = 0;
  std::uint64_t out = 0;
};

// In the order of docs/contract.md section 3, from the image's pixels to the points in the map.
std::vector<PruningStep> pruning_steps(const ProfileCounts& counts);

class ProfileRun {
 public:
  // With `trace` the times of so many frames are kept; the memory is taken here.
  explicit ProfileRun(std::size_t trace_frames);

  // One frame, which is counted. Allocates nothing.
  Status frame(Pipeline& pipeline, ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right);

  const ProfileCounts& counts() const { return counts_; }
  const std::vector<FrameTimes>& trace() const { return trace_; }

 private:
  void count(const FrameResult& result);

  ProfileCounts counts_;
  std::vector<FrameTimes> trace_;
  FrameResult result_;
};

// What the measuring itself costs per frame: the looks at the clock and the counters of one frame, and nothing else.
Nanoseconds measuring_cost(const Clock& clock);

}  // namespace lakshya

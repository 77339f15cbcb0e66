#include "app/tools/profile_run.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>

namespace lakshya {

std::vector<PruningStep> pruning_steps(const ProfileCounts& c) {
  const auto of = [&](PixelClass pixel) { return c.by_class[static_cast<std::size_t>(pixel)]; };
  std::vector<PruningStep> steps;
  std::uint64_t left = c.pixels;
  const auto step = [&](const char* name, std::uint64_t dropped) {
    steps.push_back({name, left, left - dropped});
    left -= dropped;
  };
  step("no_disparity", c.without_disparity);
  step("too_far", of(PixelClass::too_far));
  // Their floor lies nearer than the search range reaches (docs/contract.md section 3, 2.).
  step("not_concluded", of(PixelClass::no_disparity) - c.without_disparity);
  step("drop_off", of(PixelClass::drop_off));
  step("floor", of(PixelClass::floor));
  step("ceiling", of(PixelClass::ceiling));
  step("outside_map", of(PixelClass::obstacle) - c.points_in_map);
  return steps;
}

ProfileRun::ProfileRun(std::size_t trace_frames) {
  trace_.reserve(trace_frames);
}

Status ProfileRun::frame(Pipeline& pipeline, ImageView<const std::uint8_t> left,
                         ImageView<const std::uint8_t> right) {
  const Status status = pipeline.process(left, right, {}, result_);
  if (status != Status::ok) return status;
  count(result_);
  if (trace_.size() < trace_.capacity()) trace_.push_back(result_.times);
  return status;
}

void ProfileRun::count(const FrameResult& result) {
  ++counts_.frames;
  counts_.pixels +=
      static_cast<std::uint64_t>(result.classes.width) * static_cast<std::uint64_t>(result.classes.height);
  for (std::size_t i = 0; i < counts_.by_class.size(); ++i)
    counts_.by_class[i] += result.pixels.by_class[i];
  counts_.without_disparity +=
      std::accumulate(std::begin(result.pixels.by_reason), std::end(result.pixels.by_reason), std::uint64_t{0});
  const NavGrid& grid = result.grid;
  for (int r = 0; r < grid.geometry.rows; ++r) {
    for (int c = 0; c < grid.geometry.cols; ++c) {
      counts_.points_in_map += grid.count.at(c, r);
      ++counts_.cells[grid.type.at(c, r)];
    }
  }
}

namespace {

// The looks at the clock and the counters of one frame, as Pipeline and Matcher make them.
void measure_nothing(const Clock& clock, StageTimes& times) {
  FrameTimes frame;
  for (std::size_t stage = 0; stage < frame.begin.size(); ++stage) {
    frame.begin[stage] = clock.now();
    frame.took[stage] = clock.now() - frame.begin[stage];
  }
  for (Nanoseconds& at : frame.match.at)
    at = clock.now();
  times.add(frame);
}

}  // namespace

Nanoseconds measuring_cost(const Clock& clock) {
  constexpr int kRounds = 50;
  constexpr int kFrames = 200;
  const auto times = std::make_unique<StageTimes>();
  Nanoseconds least = std::numeric_limits<Nanoseconds>::max();  // of the rounds that nothing interrupted
  for (int round = 0; round < kRounds; ++round) {
    const Nanoseconds start = clock.now();
    for (int i = 0; i < kFrames; ++i)
      measure_nothing(clock, *times);
    least = std::min(least, (clock.now() - start) / kFrames);
  }
  return least;
}

}  // namespace lakshya

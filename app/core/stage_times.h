// How long the stages of a frame take, counted for as long as the machine runs, in memory that never grows: one
// histogram per stage with logarithmic buckets. Always on: a frame costs a dozen looks at the clock and as many
// counters (docs/profiling.md has the figure).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hal/clock.h"

namespace lakshya {

enum class Stage : std::uint8_t { rectify, match, ground, project_and_bin, score, remember, plan };
inline constexpr int kStages = 7;
const char* to_string(Stage stage);

// The three passes over the image inside Stage::match: descriptors, search for each pixel's partner, local support.
enum class MatchPass : std::uint8_t { describe, search, support };
inline constexpr int kMatchPasses = 3;
const char* to_string(MatchPass pass);

// When each pass began, and when the last one ended.
struct MatchTimes {
  std::array<Nanoseconds, kMatchPasses + 1> at{};
};

// One writer, and readers in the same thread: a copy is what another thread gets.
class TimeHistogram {
 public:
  // Buckets are 1/32 of the power of two below them wide: a quantile is off by less than 1.6 %. What takes longer than
  // 2^36 ns (69 s) is counted in the last bucket.
  static constexpr int kFractionBits = 5;
  static constexpr int kMaxBits = 36;
  static constexpr int kBuckets = (kMaxBits - kFractionBits + 1) << kFractionBits;

  void add(Nanoseconds time) {
    time = std::max<Nanoseconds>(time, 0);
    std::uint32_t& bucket = buckets_[static_cast<std::size_t>(bucket_of(time))];
    if (bucket == std::numeric_limits<std::uint32_t>::max()) return;  // four years at 30 frames a second
    ++bucket;
    ++count_;
    sum_ += time;
    max_ = std::max(max_, time);
  }

  std::uint64_t count() const { return count_; }
  Nanoseconds sum() const { return sum_; }
  Nanoseconds max() const { return max_; }

  // The least time that `per_mille` of all samples do not exceed, to the middle of its bucket; never above max().
  // 0 when nothing was added.
  Nanoseconds quantile(int per_mille) const;

 private:
  static constexpr int bucket_of(Nanoseconds time) {
    constexpr Nanoseconds kExact = Nanoseconds{1} << (kFractionBits + 1);
    if (time < kExact) return static_cast<int>(time);
    if (time >= Nanoseconds{1} << kMaxBits) return kBuckets - 1;
    const auto bits = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(time)));
    const int shift = bits - 1 - kFractionBits;
    return (shift << kFractionBits) + static_cast<int>(time >> shift);
  }

  std::array<std::uint32_t, kBuckets> buckets_{};
  std::uint64_t count_ = 0;
  Nanoseconds sum_ = 0;
  Nanoseconds max_ = 0;
};

// All that one frame took: the stages, and inside match the passes.
struct FrameTimes {
  std::array<Nanoseconds, kStages> begin{};
  std::array<Nanoseconds, kStages> took{};
  MatchTimes match;
  // From the beginning of the first stage to the end of the last one.
  Nanoseconds frame() const { return begin.back() + took.back() - begin.front(); }
  Nanoseconds pass(MatchPass p) const {
    const auto i = static_cast<std::size_t>(p);
    return match.at[i + 1] - match.at[i];
  }
};

class StageTimes {
 public:
  void add(const FrameTimes& times);

  const TimeHistogram& frame() const { return frame_; }
  const TimeHistogram& of(Stage stage) const { return stages_[static_cast<std::size_t>(stage)]; }
  const TimeHistogram& of(MatchPass pass) const { return passes_[static_cast<std::size_t>(pass)]; }

 private:
  TimeHistogram frame_;
  std::array<TimeHistogram, kStages> stages_;
  std::array<TimeHistogram, kMatchPasses> passes_;
};

}  // namespace lakshya

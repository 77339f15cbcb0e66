#include "app/core/stage_times.h"

namespace lakshya {

const char* to_string(Stage stage) {
  constexpr const char* kNames[kStages] = {"rectify", "match",    "ground", "project_and_bin",
                                           "score",   "remember", "plan"};
  return kNames[static_cast<int>(stage)];
}

const char* to_string(MatchPass pass) {
  constexpr const char* kNames[kMatchPasses] = {"describe", "search", "support"};
  return kNames[static_cast<int>(pass)];
}

Nanoseconds TimeHistogram::quantile(int per_mille) const {
  if (count_ == 0) return 0;
  const auto share = static_cast<std::uint64_t>(std::clamp(per_mille, 0, 1000));
  const std::uint64_t wanted = std::max<std::uint64_t>((count_ * share + 999) / 1000, 1);
  int bucket = 0;
  for (std::uint64_t seen = buckets_[0]; seen < wanted; seen += buckets_[static_cast<std::size_t>(bucket)])
    ++bucket;
  if (bucket == kBuckets - 1) return max_;
  // bucket_of() the other way round: the first time of the bucket, and half its width.
  const int shift = std::max((bucket >> kFractionBits) - 1, 0);
  const Nanoseconds first = Nanoseconds{bucket - (shift << kFractionBits)} << shift;
  return std::min(first + (Nanoseconds{1} << shift) / 2, max_);
}

void StageTimes::add(const FrameTimes& times) {
  frame_.add(times.frame());
  for (std::size_t i = 0; i < stages_.size(); ++i)
    stages_[i].add(times.took[i]);
  for (std::size_t i = 0; i < passes_.size(); ++i)
    passes_[i].add(times.pass(static_cast<MatchPass>(i)));
}

}  // namespace lakshya

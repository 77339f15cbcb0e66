// What a run of the endurance test must show.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <span>

#include "app/tools/soak_run.h"

namespace lakshya {
namespace {

using Samples = std::span<const SoakSample>;

constexpr double kResidentShare = 0.01;
constexpr double kResidentBytes = 256 * 1024;
constexpr double kSlower = 1.3;

Samples fifth(const SoakResult& result, std::size_t n) {
  const std::size_t count = result.samples.size();
  return Samples(result.samples).subspan(n * count / 5, (n + 1) * count / 5 - n * count / 5);
}

double mean_resident(Samples samples) {
  double sum = 0;
  for (const SoakSample& s : samples)
    sum += static_cast<double>(s.resident_bytes);
  return samples.empty() ? 0 : sum / static_cast<double>(samples.size());
}

std::uint64_t most_handles(Samples samples) {
  std::uint64_t most = 0;
  for (const SoakSample& s : samples)
    most = std::max(most, s.handles);
  return most;
}

double median_p50_ms(Samples samples) {
  std::vector<Nanoseconds> times;
  for (const SoakSample& s : samples)
    times.push_back(s.p50);
  std::ranges::sort(times);
  return times.empty() ? 0 : static_cast<double>(times[times.size() / 2]) / 1e6;
}

}  // namespace

SoakGrowth soak_growth(const SoakResult& result) {
  const Samples before = fifth(result, 1);
  const Samples after = fifth(result, 4);
  return {.resident_before = mean_resident(before),
          .resident_after = mean_resident(after),
          .handles_before = most_handles(before),
          .handles_after = most_handles(after),
          .p50_before_ms = median_p50_ms(before),
          .p50_after_ms = median_p50_ms(after)};
}

SoakVerdict soak_verdict(const SoakResult& result) {
  SoakVerdict verdict;
  if (result.violations > 0)
    verdict.failures.push_back(fmt::format("a safety rule was broken {} times", result.violations));
  const bool felt = std::ranges::any_of(result.records, [](const FaultRecord& r) { return r.stopped > 0; });
  if (!felt) verdict.failures.emplace_back("no fault stopped turning wheels: nothing was tested (more --frames)");
  std::uint64_t allocations = 0;
  for (const SoakSample& s : result.samples)
    allocations += s.allocations;
  if (allocations > 0)
    verdict.failures.push_back(fmt::format("the loop allocated {} times after READY", allocations));

  const SoakGrowth g = soak_growth(result);
  if (g.resident_after > g.resident_before * (1 + kResidentShare) + kResidentBytes) {
    verdict.failures.push_back(fmt::format("resident memory has grown from {:.2f} to {:.2f} MB",
                                           g.resident_before / 1e6, g.resident_after / 1e6));
  }
  if (g.handles_after != g.handles_before)
    verdict.failures.push_back(fmt::format("open handles: first {}, then {}", g.handles_before, g.handles_after));
  if (g.p50_after_ms > g.p50_before_ms * kSlower) {
    verdict.warnings.push_back(
        fmt::format("a frame took {:.2f} ms first and {:.2f} ms at the end: is the machine busy?", g.p50_before_ms,
                    g.p50_after_ms));
  }
  return verdict;
}

}  // namespace lakshya

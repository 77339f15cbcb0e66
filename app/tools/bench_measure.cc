#include "app/tools/bench_measure.h"

#include <time.h>  // clock_gettime is POSIX

#include <algorithm>

#include "hal/clock/monotonic_clock.h"

namespace lakshya {
namespace {

class ThreadClock final : public Clock {
 public:
  Nanoseconds now() const override {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return t.tv_sec * kSecond + t.tv_nsec;
  }
  // Nothing here waits.
  void sleep_until(Nanoseconds /*deadline*/) override {}
  Status wait_for(int /*fd*/, Ready /*what*/, Nanoseconds /*deadline*/) override { return Status::timeout; }
};

BenchClock& chosen_clock() {
  static BenchClock clock = BenchClock::wall;
  return clock;
}

}  // namespace

void use_bench_clock(BenchClock clock) {
  chosen_clock() = clock;
}

const Clock& bench_clock() {
  static const MonotonicClock wall;
  static const ThreadClock thread;
  if (chosen_clock() == BenchClock::wall) return wall;
  return thread;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

std::vector<double> interleaved_medians(const std::vector<BenchTask>& tasks, const BenchRounds& rounds) {
  const Clock& clock = bench_clock();
  const Nanoseconds start = clock.now();
  for (const BenchTask& task : tasks)
    (void)task();
  const double round_ms = static_cast<double>(clock.now() - start) * 1e-6;
  const double affordable = rounds.budget_ms / std::max(round_ms, 1e-3);
  const int count = rounds.rounds > 0 ? rounds.rounds
                                      : static_cast<int>(std::clamp<double>(affordable, rounds.least, rounds.most));
  std::vector<std::vector<double>> times(tasks.size());
  MonotonicClock wall;
  const auto rest = static_cast<Nanoseconds>(rounds.rest_ms * 1e6);
  for (int round = 0; round < count; ++round) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      if (rest > 0) wall.sleep_until(wall.now() + rest);
      times[i].push_back(tasks[i]());
    }
  }
  std::vector<double> medians;
  medians.reserve(times.size());
  for (const std::vector<double>& t : times)
    medians.push_back(median(t));
  return medians;
}

BenchTask timed_task(std::function<void()> work) {
  return [work = std::move(work)] {
    const Clock& clock = bench_clock();
    const Nanoseconds start = clock.now();
    work();
    return static_cast<double>(clock.now() - start) * 1e-6;
  };
}

}  // namespace lakshya

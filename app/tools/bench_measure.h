// Timing two or more things that are to be compared.
#pragma once

#include <functional>
#include <vector>

#include "hal/clock.h"

namespace lakshya {

// Runs once and says how long that took, in ms.
using BenchTask = std::function<double()>;

// What everything here is timed with: the wall clock, or the time that the processor spent on the calling thread. The
// latter is only right for one thread that waits for nothing; there it does not see what else a busy machine does.
enum class BenchClock { wall, thread };
void use_bench_clock(BenchClock clock);
const Clock& bench_clock();

// How often: a fixed number of rounds, or (rounds = 0) as many as fit in budget_ms, between `least` and `most`.
struct BenchRounds {
  int rounds = 0;
  int least = 15;
  int most = 100;
  double budget_ms = 1500;
  double rest_ms = 0;  // before each task
};

// OpenMP's threads keep their processors busy for some time after their work (libgomp: 300,000 rounds, about 16 ms here),
// which would be time taken from whoever runs next: from OpenCV.
inline constexpr double kOpenMpRestMs = 20;

double median(std::vector<double> values);

// Median of each task, ms. They take turns (first, second, first, second, ...), so that what slows the machine down for
// a while slows all of them; one round before counts for nothing.
std::vector<double> interleaved_medians(const std::vector<BenchTask>& tasks, const BenchRounds& rounds);

// The task that times `work` as a whole.
BenchTask timed_task(std::function<void()> work);

}  // namespace lakshya

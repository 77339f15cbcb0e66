// The pipeline's one way to spread work over OpenMP's threads.
#pragma once

#include <omp.h>

#include <algorithm>

#include "kernels/base/status.h"

namespace lakshya {

// work(i) for i in 0..count-1, by `team` threads (0: as many as OpenMP has); the status whose number is the greatest. A team of one is
// no team: OpenMP would allocate it anew every time (libgomp keeps the last team only if it had more than one thread).
template <class Work>
Status over_bands(int count, int team, const Work& work) {
  if (team == 0) team = omp_get_max_threads();
  int worst = static_cast<int>(Status::ok);
  if (team == 1) {
    for (int i = 0; i < count; ++i)
      worst = std::max(worst, static_cast<int>(work(i)));
    return static_cast<Status>(worst);
  }
#pragma omp parallel for schedule(dynamic) num_threads(team) reduction(max : worst)
  for (int i = 0; i < count; ++i)
    worst = std::max(worst, static_cast<int>(work(i)));
  return static_cast<Status>(worst);
}

template <class Work>
Status over_bands(int count, const Work& work) {
  return over_bands(count, 0, work);
}

}  // namespace lakshya

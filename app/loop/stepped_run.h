// A run on the virtual clock: one thread does everything in order of time. What comes out depends on the input alone, not on the
// machine's speed nor on how many threads process an image.
#pragma once

#include <cstdint>
#include <functional>

#include "app/loop/machinery.h"
#include "app/loop/stepped_clock.h"

namespace lakshya {

struct RunLimits {
  std::uint64_t frames = 0;   // ends after so many; 0: with the recording, or never
  std::uint64_t damaged = 0;  // ends after so many captures in a row that gave damaged pairs; 0: never
};

// `clock` is the one that the machinery was given. Pairs are captured when they are due; each is processed at once, and its plan
// reaches control loop.virtual_latency_s after its capture. `after_turn` is called after every turn of the control loop.
void run_stepped(Machinery& machinery, SteppedClock& clock, const RunLimits& limits,
                 const std::function<void()>& after_turn);

}  // namespace lakshya

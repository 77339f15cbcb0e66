// The machine's clock: clock_gettime(CLOCK_MONOTONIC) and clock_nanosleep with an absolute deadline.
#pragma once

#include "hal/clock.h"

namespace lakshya {

class MonotonicClock final : public Clock {
 public:
  Nanoseconds now() const override;
  void sleep_until(Nanoseconds deadline) override;
};

}  // namespace lakshya

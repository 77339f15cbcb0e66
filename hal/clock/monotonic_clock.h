// The machine's clock: clock_gettime(CLOCK_MONOTONIC) and clock_nanosleep with an absolute deadline, ppoll.
#pragma once

#include "hal/clock.h"

namespace lakshya {

class MonotonicClock final : public Clock {
 public:
  Nanoseconds now() const override;
  void sleep_until(Nanoseconds deadline) override;
  Status wait_for(int fd, Ready what, Nanoseconds deadline) override;
};

}  // namespace lakshya

// When to look again for a device that is gone: often enough to notice that it is back, seldom enough to cost nothing.
#pragma once

#include <algorithm>

#include "hal/clock.h"

namespace lakshya {

class Retry {
 public:
  explicit Retry(Nanoseconds pause = 200 * kMillisecond) : pause_(pause) {}

  // True at most once in every pause; the next one is counted from `now`, also for a device that comes and goes.
  bool due(Nanoseconds now) {
    if (now < next_) return false;
    next_ = now + pause_;
    return true;
  }

  // The same for those who may wait: sleeps until it is time, at most until `deadline`.
  bool wait(Clock& clock, Nanoseconds deadline) {
    clock.sleep_until(std::min(deadline, next_));
    return due(clock.now());
  }

  // It went just now: not due before a pause has passed.
  void lost(Nanoseconds now) { next_ = now + pause_; }

 private:
  Nanoseconds pause_;
  Nanoseconds next_ = 0;
};

}  // namespace lakshya

// When to look again for a device that is gone: often enough to notice that it is back, seldom enough to cost nothing.
#pragma once

#include "hal/clock.h"

namespace lakshya {

class Retry {
 public:
  explicit Retry(Nanoseconds pause = 200 * kMillisecond) : pause_(pause) {}

  // True at most once in every pause.
  bool due(Nanoseconds now) {
    if (now < next_) return false;
    next_ = now + pause_;
    return true;
  }

 private:
  Nanoseconds pause_;
  Nanoseconds next_ = 0;
};

}  // namespace lakshya

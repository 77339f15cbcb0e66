// A clock that stands still until somebody waits.
#pragma once

#include <algorithm>
#include <functional>

#include "hal/clock.h"

namespace lakshya {

class ManualClock final : public Clock {
 public:
  Nanoseconds now() const override { return now_; }
  void sleep_until(Nanoseconds deadline) override { now_ = std::max(now_, deadline); }

  // What `ready` says, once; where there is none or it says no, time passes to the deadline.
  Status wait_for(int fd, Ready what, Nanoseconds deadline) override {
    if (ready && ready(fd, what)) return Status::ok;
    sleep_until(deadline);
    return Status::timeout;
  }

  void advance(Nanoseconds by) { now_ += by; }

  std::function<bool(int fd, Ready what)> ready;

 private:
  Nanoseconds now_ = 1000 * kSecond;
};

}  // namespace lakshya

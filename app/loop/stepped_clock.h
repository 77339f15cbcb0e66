// Time that passes only when somebody waits: a run on it gives the same on any machine.
#pragma once

#include <poll.h>

#include <algorithm>

#include "hal/clock.h"

namespace lakshya {

class SteppedClock final : public Clock {
 public:
  Nanoseconds now() const override { return now_; }
  void sleep_until(Nanoseconds deadline) override { now_ = std::max(now_, deadline); }

  // A file that has nothing to tell now will have nothing until the deadline, which comes at once.
  Status wait_for(int fd, Ready what, Nanoseconds deadline) override {
    pollfd event{.fd = fd, .events = static_cast<short>(what == Ready::to_read ? POLLIN : POLLOUT), .revents = 0};
    if (fd < 0 || ::poll(&event, 1, 0) < 0 || (event.revents & POLLNVAL) != 0) return Status::bad_argument;
    if (event.revents != 0) return Status::ok;
    sleep_until(deadline);
    return Status::timeout;
  }

 private:
  Nanoseconds now_ = kSecond;
};

}  // namespace lakshya

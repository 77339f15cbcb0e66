#include "hal/clock/monotonic_clock.h"

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <ctime>

namespace lakshya {

Nanoseconds MonotonicClock::now() const {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return Nanoseconds{t.tv_sec} * kSecond + t.tv_nsec;
}

void MonotonicClock::sleep_until(Nanoseconds deadline) {
  if (deadline <= 0) return;
  const timespec t{.tv_sec = deadline / kSecond, .tv_nsec = deadline % kSecond};
  // A signal ends the sleep early; the deadline is absolute, so sleeping again adds nothing.
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
  }
}

Status MonotonicClock::wait_for(int fd, Ready what, Nanoseconds deadline) {
  if (fd < 0) return Status::bad_argument;
  pollfd event{.fd = fd, .events = static_cast<short>(what == Ready::to_read ? POLLIN : POLLOUT), .revents = 0};
  for (;;) {
    const Nanoseconds left = std::max<Nanoseconds>(deadline - now(), 0);
    const timespec t{.tv_sec = left / kSecond, .tv_nsec = left % kSecond};
    const int ready = ppoll(&event, 1, &t, nullptr);
    if (ready == 0) return Status::timeout;
    if (ready > 0) return (event.revents & POLLNVAL) != 0 ? Status::bad_argument : Status::ok;
    if (errno != EINTR) return Status::bad_argument;
  }
}

}  // namespace lakshya

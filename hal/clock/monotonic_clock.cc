#include "hal/clock/monotonic_clock.h"

#include <cerrno>
#include <ctime>

namespace lakshya {
namespace {

constexpr Nanoseconds kSecond = 1'000'000'000;

}  // namespace

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

}  // namespace lakshya

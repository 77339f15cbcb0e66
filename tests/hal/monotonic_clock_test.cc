#include "hal/clock/monotonic_clock.h"

#include <gtest/gtest.h>

namespace lakshya {
namespace {

TEST(MonotonicClock, NeverStepsBack) {
  const MonotonicClock clock;
  Nanoseconds before = clock.now();
  for (int i = 0; i < 1000; ++i) {
    const Nanoseconds after = clock.now();
    ASSERT_GE(after, before);
    before = after;
  }
}

TEST(MonotonicClock, SleepsUntilTheDeadline) {
  MonotonicClock clock;
  const Nanoseconds deadline = clock.now() + 20'000'000;
  clock.sleep_until(deadline);
  EXPECT_GE(clock.now(), deadline);
}

TEST(MonotonicClock, ReturnsAtOnceWhenTheDeadlineHasPassed) {
  MonotonicClock clock;
  const Nanoseconds start = clock.now();
  clock.sleep_until(start - 1'000'000'000);
  clock.sleep_until(-1);
  EXPECT_LT(clock.now() - start, 1'000'000'000);
}

}  // namespace
}  // namespace lakshya

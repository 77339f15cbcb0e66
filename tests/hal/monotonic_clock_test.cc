#include "hal/clock/monotonic_clock.h"

#include <gtest/gtest.h>

#include "tests/support/pseudo_terminal.h"

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

TEST(MonotonicClock, WaitsForAFileUntilItIsReadyOrTheDeadlineHasCome) {
  MonotonicClock clock;
  const PseudoTerminal line;
  const int fd = open(line.path().c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(fd, 0);
  EXPECT_EQ(clock.wait_for(fd, Ready::to_write, clock.now()), Status::ok);
  const Nanoseconds deadline = clock.now() + 20 * kMillisecond;
  EXPECT_EQ(clock.wait_for(fd, Ready::to_read, deadline), Status::timeout);
  EXPECT_GE(clock.now(), deadline);
  line.write("x");
  EXPECT_EQ(clock.wait_for(fd, Ready::to_read, clock.now() + 10 * kSecond), Status::ok);
  close(fd);
  EXPECT_EQ(clock.wait_for(fd, Ready::to_read, clock.now() + 10 * kSecond), Status::bad_argument);
}

}  // namespace
}  // namespace lakshya

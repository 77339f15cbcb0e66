#include "hal/retry.h"

#include <gtest/gtest.h>

#include "tests/support/manual_clock.h"

namespace lakshya {
namespace {

class RetryTest : public testing::Test {
 protected:
  ManualClock clock_;
  const Nanoseconds start_ = clock_.now();
  Retry retry_;
};

TEST_F(RetryTest, IsDueAtOnceAndThenOnceInEveryPause) {
  EXPECT_TRUE(retry_.due(start_));
  EXPECT_FALSE(retry_.due(start_));
  EXPECT_FALSE(retry_.due(start_ + 200 * kMillisecond - 1));
  EXPECT_TRUE(retry_.due(start_ + 200 * kMillisecond));
  EXPECT_TRUE(retry_.due(start_ + kSecond));
  EXPECT_FALSE(retry_.due(start_ + kSecond + 199 * kMillisecond)) << "counted from the last one";
}

TEST_F(RetryTest, ThePauseIsAsAsked) {
  Retry seldom(3 * kSecond);
  EXPECT_TRUE(seldom.due(start_));
  EXPECT_FALSE(seldom.due(start_ + 2 * kSecond));
  EXPECT_TRUE(seldom.due(start_ + 3 * kSecond));
}

TEST_F(RetryTest, AfterALossItIsDueOnePauseLater) {
  EXPECT_TRUE(retry_.due(start_));
  clock_.advance(10 * kSecond);
  retry_.lost(clock_.now());
  EXPECT_FALSE(retry_.due(clock_.now() + 199 * kMillisecond));
  EXPECT_TRUE(retry_.due(clock_.now() + 200 * kMillisecond));
}

TEST_F(RetryTest, WaitSleepsUntilItIsTimeAndNotPastTheDeadline) {
  EXPECT_TRUE(retry_.wait(clock_, start_ + kSecond));
  EXPECT_EQ(clock_.now(), start_) << "due, and yet it slept";
  EXPECT_FALSE(retry_.wait(clock_, start_ + 150 * kMillisecond));
  EXPECT_EQ(clock_.now(), start_ + 150 * kMillisecond);
  EXPECT_TRUE(retry_.wait(clock_, start_ + kSecond));
  EXPECT_EQ(clock_.now(), start_ + 200 * kMillisecond);
  EXPECT_FALSE(retry_.wait(clock_, start_)) << "a deadline that has passed";
  EXPECT_EQ(clock_.now(), start_ + 200 * kMillisecond);
}

}  // namespace
}  // namespace lakshya

#include "hal/compass/sim_compass.h"

#include <gtest/gtest.h>

#include "tests/support/manual_clock.h"

namespace lakshya {
namespace {

// Turns by a thousandth of a radian per millisecond.
class Turning final : public HeadingProducer {
 public:
  explicit Turning(Nanoseconds start) : start_(start) {}
  Status heading(Nanoseconds time, HeadingSample& sample) override {
    sample.yaw = static_cast<double>(time - start_) * 1e-9;
    return failing ? Status::bad_data : Status::ok;
  }
  bool failing = false;

 private:
  Nanoseconds start_;
};

TEST(SimCompass, GivesReadingsAtItsRateAndTheNewestToWhoComesLate) {
  ManualClock clock;
  const Nanoseconds start = clock.now();
  Turning producer(start);
  SimCompass compass(10, producer, clock);
  HeadingSample sample;
  EXPECT_EQ(compass.read(start + kSecond, sample), Status::disconnected);
  ASSERT_EQ(compass.open(), Status::ok);
  ASSERT_EQ(compass.read(start + kSecond, sample), Status::ok);
  EXPECT_EQ(sample.time, start);
  EXPECT_EQ(compass.read(start + 99 * kMillisecond, sample), Status::timeout);
  EXPECT_EQ(clock.now(), start + 99 * kMillisecond);
  ASSERT_EQ(compass.read(start + kSecond, sample), Status::ok);
  EXPECT_EQ(clock.now(), start + 100 * kMillisecond);
  EXPECT_DOUBLE_EQ(sample.yaw, 0.1);
  clock.advance(350 * kMillisecond);
  ASSERT_EQ(compass.read(clock.now(), sample), Status::ok);
  EXPECT_EQ(sample.time, start + 400 * kMillisecond);
  EXPECT_EQ(compass.counters()[0].value, 2U);
  producer.failing = true;
  EXPECT_EQ(compass.read(clock.now() + kSecond, sample), Status::bad_data);
}

TEST(SimCompass, RefusesRatesThatAreNone) {
  ManualClock clock;
  Turning producer(0);
  for (const double rate : {0.0, -1.0, 1e6}) {
    SimCompass compass(rate, producer, clock);
    EXPECT_EQ(compass.open(), Status::bad_argument);
  }
}

}  // namespace
}  // namespace lakshya

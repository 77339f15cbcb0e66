#include "hal/camera/folder_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "tests/support/count_allocations.h"
#include "tests/support/manual_clock.h"

namespace lakshya {
namespace {

// Pair n is even: left n, right 100 + n.
class NumberedPairs final : public RecordedPairs {
 public:
  explicit NumberedPairs(int count) : count_(count) {}
  int count() const override { return count_; }
  int width() const override { return 3; }
  int height() const override { return 2; }
  std::optional<Nanoseconds> time(int n) const override {
    if (times.empty()) return std::nullopt;
    return times[static_cast<std::size_t>(n)];
  }
  Status load(int n, ImageView<std::uint8_t> left, ImageView<std::uint8_t> right) override {
    if (n == broken) return Status::bad_data;
    std::fill_n(left.data, 6, static_cast<std::uint8_t>(n));
    std::fill_n(right.data, 6, static_cast<std::uint8_t>(100 + n));
    return Status::ok;
  }

  std::vector<Nanoseconds> times;
  int broken = -1;

 private:
  int count_;
};

class FolderCameraTest : public testing::Test {
 protected:
  Nanoseconds in_ms(int ms) const { return clock_.now() + ms * kMillisecond; }

  ManualClock clock_;
  StereoFrame frame_;
};

TEST_F(FolderCameraTest, GivesEveryPairInOrderAsFastAsItIsAsked) {
  NumberedPairs pairs(3);
  FolderCamera camera({.pace = Pace::fastest}, pairs, clock_);
  ASSERT_EQ(camera.open(), Status::ok);
  EXPECT_FALSE(camera.is_static());
  test::allocations = 0;
  for (int n = 0; n < 3; ++n) {
    ASSERT_EQ(camera.capture(clock_.now(), frame_), Status::ok);
    EXPECT_EQ(frame_.left.at(2, 1), n);
    EXPECT_EQ(frame_.right.at(2, 1), 100 + n);
    EXPECT_EQ(frame_.sequence, static_cast<std::uint64_t>(n));
    EXPECT_EQ(frame_.left_time, clock_.now());
  }
  EXPECT_EQ(camera.capture(in_ms(50), frame_), Status::end_of_data);
  EXPECT_EQ(test::allocations, 0);
}

TEST_F(FolderCameraTest, KeepsTheRecordingsPaceAndItsTimes) {
  NumberedPairs pairs(3);
  pairs.times = {7'000 * kMillisecond, 7'100 * kMillisecond, 7'250 * kMillisecond};
  FolderCamera camera({.pace = Pace::recorded}, pairs, clock_);
  ASSERT_EQ(camera.open(), Status::ok);
  const Nanoseconds start = clock_.now();
  ASSERT_EQ(camera.capture(in_ms(50), frame_), Status::ok);
  EXPECT_EQ(frame_.left_time, start);
  EXPECT_EQ(camera.capture(start + 60 * kMillisecond, frame_), Status::timeout);
  EXPECT_EQ(clock_.now(), start + 60 * kMillisecond);
  ASSERT_EQ(camera.capture(in_ms(1000), frame_), Status::ok);
  EXPECT_EQ(clock_.now(), start + 100 * kMillisecond);
  ASSERT_EQ(camera.capture(in_ms(1000), frame_), Status::ok);
  EXPECT_EQ(frame_.right_time, start + 250 * kMillisecond);
}

TEST_F(FolderCameraTest, WhoComesLateGetsTheNewestPairAndTheMissedOnesAreCounted) {
  NumberedPairs pairs(10);
  FolderCamera camera({.pace = Pace::rate, .rate_hz = 10}, pairs, clock_);
  ASSERT_EQ(camera.open(), Status::ok);
  ASSERT_EQ(camera.capture(in_ms(0), frame_), Status::ok);
  clock_.advance(350 * kMillisecond);
  ASSERT_EQ(camera.capture(in_ms(0), frame_), Status::ok);
  EXPECT_EQ(frame_.left.at(0, 0), 3);
  EXPECT_EQ(frame_.sequence, 3U);
  EXPECT_EQ(camera.counters()[0].value, 2U);
}

TEST_F(FolderCameraTest, RepeatsWithoutAPauseAndCountsOn) {
  NumberedPairs pairs(2);
  FolderCamera camera({.pace = Pace::rate, .rate_hz = 20, .repeat = true}, pairs, clock_);
  ASSERT_EQ(camera.open(), Status::ok);
  const Nanoseconds start = clock_.now();
  for (int n = 0; n < 5; ++n) {
    ASSERT_EQ(camera.capture(in_ms(100), frame_), Status::ok);
    EXPECT_EQ(frame_.left.at(0, 0), n % 2);
    EXPECT_EQ(frame_.sequence, static_cast<std::uint64_t>(n));
    EXPECT_EQ(frame_.left_time, start + n * (50 * kMillisecond));
  }
}

TEST_F(FolderCameraTest, ASinglePairIsStatic) {
  NumberedPairs pairs(1);
  FolderCamera camera({.pace = Pace::recorded, .rate_hz = 10, .repeat = true}, pairs, clock_);
  ASSERT_EQ(camera.open(), Status::ok);
  EXPECT_TRUE(camera.is_static());
  ASSERT_EQ(camera.capture(in_ms(0), frame_), Status::ok);
  EXPECT_EQ(camera.capture(in_ms(99), frame_), Status::timeout);
  EXPECT_EQ(camera.capture(in_ms(99), frame_), Status::ok);
}

TEST_F(FolderCameraTest, ABrokenPairIsBadDataAndTheNextOneComes) {
  NumberedPairs pairs(3);
  pairs.broken = 1;
  FolderCamera camera({.pace = Pace::fastest}, pairs, clock_);
  ASSERT_EQ(camera.open(), Status::ok);
  EXPECT_EQ(camera.capture(clock_.now(), frame_), Status::ok);
  EXPECT_EQ(camera.capture(clock_.now(), frame_), Status::bad_data);
  EXPECT_STREQ(camera.problem(), "pair 1 of the recording cannot be read");
  EXPECT_EQ(camera.counters()[1].value, 1U);
  EXPECT_EQ(camera.capture(clock_.now(), frame_), Status::ok);
  EXPECT_EQ(frame_.left.at(0, 0), 2);
}

TEST_F(FolderCameraTest, RefusesNoPairsAndRatesThatAreNone) {
  NumberedPairs none(0);
  FolderCamera empty({}, none, clock_);
  EXPECT_EQ(empty.open(), Status::end_of_data);
  NumberedPairs pairs(1);
  for (const double rate : {0.0, -1.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
    FolderCamera camera({.rate_hz = rate}, pairs, clock_);
    EXPECT_EQ(camera.open(), Status::bad_argument) << rate;
    EXPECT_EQ(camera.capture(in_ms(10), frame_), Status::disconnected);
  }
}

}  // namespace
}  // namespace lakshya

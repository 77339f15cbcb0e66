#include "hal/camera/sim_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/count_allocations.h"
#include "tests/support/manual_clock.h"

namespace lakshya {
namespace {

// Every pixel is the frame's number, in the right eye plus 100.
class Numbers final : public FrameProducer {
 public:
  Status produce(Nanoseconds time, std::uint64_t number, ImageView<std::uint8_t> left,
                 ImageView<std::uint8_t> right) override {
    last_time = time;
    if (answer != Status::ok) return answer;
    for (int v = 0; v < left.height; ++v) {
      std::fill_n(left.row(v), left.width, static_cast<std::uint8_t>(number));
      std::fill_n(right.row(v), right.width, static_cast<std::uint8_t>(number + 100));
    }
    return Status::ok;
  }
  Status answer = Status::ok;
  Nanoseconds last_time = 0;
};

class SimCameraTest : public testing::Test {
 protected:
  Status capture(int ms) { return camera_.capture(clock_.now() + ms * kMillisecond, frame_); }

  ManualClock clock_;
  const Nanoseconds start_ = clock_.now();
  Numbers numbers_;
  SimCamera camera_{{.width = 6, .height = 4, .fps = 20}, numbers_, clock_};
  StereoFrame frame_;
};

TEST_F(SimCameraTest, FramesComeAtTheirTimes) {
  ASSERT_EQ(camera_.open(), Status::ok);
  for (std::uint64_t i = 0; i < 3; ++i) {
    ASSERT_EQ(capture(60), Status::ok);
    EXPECT_EQ(frame_.sequence, i);
    EXPECT_EQ(frame_.left_time, start_ + static_cast<Nanoseconds>(i) * 50 * kMillisecond);
    EXPECT_EQ(frame_.right_time, frame_.left_time);
    EXPECT_EQ(numbers_.last_time, frame_.left_time);
    EXPECT_EQ(clock_.now(), frame_.left_time);
    EXPECT_EQ(frame_.left.at(5, 3), i);
    EXPECT_EQ(frame_.right.at(0, 0), 100 + i);
    EXPECT_EQ(frame_.right.at(5, 3), 100 + i);
  }
  EXPECT_EQ(camera_.width(), 6);
  EXPECT_EQ(camera_.height(), 4);
  EXPECT_FALSE(camera_.is_static());
}

TEST_F(SimCameraTest, ADeadlineBeforeTheNextFrameIsATimeout) {
  ASSERT_EQ(camera_.open(), Status::ok);
  ASSERT_EQ(capture(0), Status::ok);
  EXPECT_EQ(capture(49), Status::timeout);
  EXPECT_EQ(clock_.now(), start_ + 49 * kMillisecond);
  EXPECT_EQ(camera_.capture(start_, frame_), Status::timeout);
  EXPECT_EQ(clock_.now(), start_ + 49 * kMillisecond);
  EXPECT_EQ(capture(1), Status::ok);
  EXPECT_EQ(frame_.sequence, 1U);
}

TEST_F(SimCameraTest, TheNewestThatIsDueIsGivenAndTheOthersAreDropped) {
  ASSERT_EQ(camera_.open(), Status::ok);
  clock_.advance(220 * kMillisecond);
  ASSERT_EQ(capture(0), Status::ok);
  EXPECT_EQ(frame_.sequence, 4U);
  EXPECT_EQ(frame_.left_time, start_ + 200 * kMillisecond);
  EXPECT_EQ(camera_.counters()[0].value, 4U);
}

TEST_F(SimCameraTest, WhatTheProducerAnswersIsAnswered) {
  ASSERT_EQ(camera_.open(), Status::ok);
  numbers_.answer = Status::end_of_data;
  EXPECT_EQ(capture(10), Status::end_of_data);
  EXPECT_EQ(camera_.counters()[1].value, 1U);
  EXPECT_NE(std::string(camera_.problem()).find("frame 0: end of data"), std::string::npos) << camera_.problem();
  numbers_.answer = Status::ok;
  EXPECT_EQ(capture(60), Status::ok);
  EXPECT_EQ(frame_.sequence, 1U);
}

TEST_F(SimCameraTest, ClosedAndReopened) {
  EXPECT_EQ(capture(10), Status::disconnected);
  EXPECT_EQ(clock_.now(), start_);
  ASSERT_EQ(camera_.open(), Status::ok);
  ASSERT_EQ(capture(0), Status::ok);
  camera_.close();
  camera_.close();
  EXPECT_EQ(capture(10), Status::disconnected);
  ASSERT_EQ(camera_.open(), Status::ok);
  ASSERT_EQ(capture(0), Status::ok);
  EXPECT_EQ(frame_.sequence, 0U);
}

TEST_F(SimCameraTest, ImpossibleSettings) {
  for (const SimCameraSettings& settings :
       {SimCameraSettings{.width = 0}, SimCameraSettings{.width = 16385}, SimCameraSettings{.height = -1},
        SimCameraSettings{.height = 16385}, SimCameraSettings{.fps = 0}, SimCameraSettings{.fps = 1001},
        SimCameraSettings{.fps = std::nan("")}}) {
    SimCamera camera(settings, numbers_, clock_);
    EXPECT_EQ(camera.open(), Status::bad_argument);
    EXPECT_NE(std::string(camera.problem()).find("no such setting"), std::string::npos);
  }
}

TEST_F(SimCameraTest, NothingIsAllocatedAfterOpen) {
  ASSERT_EQ(camera_.open(), Status::ok);
  const int before = test::allocations;
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(capture(60), Status::ok);
  EXPECT_EQ(test::allocations, before);
}

}  // namespace
}  // namespace lakshya

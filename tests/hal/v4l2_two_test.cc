// V4l2Camera with two devices, whose pictures are paired by their times.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/count_allocations.h"
#include "tests/support/eye_pair.h"
#include "tests/support/v4l2_rig.h"

namespace lakshya {
namespace {

class V4l2TwoTest : public test::V4l2Rig {
 protected:
  void open(bool swap = false) {
    V4l2Settings s = two_devices();
    s.swap = swap;
    camera_.emplace(s, clock_, kernel_);
    ASSERT_EQ(camera_->open(), Status::ok) << camera_->problem();
  }
  Status capture(int ms = 200) { return camera_->capture(in_ms(ms), frame_); }
  std::uint64_t count(const char* name) const { return test::count_of(*camera_, name); }

  std::optional<V4l2Camera> camera_;
};

TEST_F(V4l2TwoTest, FramesOfTheSameTimeAreAPair) {
  add_many(left(), 10);
  add_many(right(), 10, kPeriod + 4 * kMillisecond, 51);
  open();
  for (int i = 1; i <= 10; ++i) {
    ASSERT_EQ(capture(), Status::ok) << camera_->problem();
    EXPECT_EQ(frame_.left.at(0, 0), i);
    EXPECT_EQ(frame_.right.at(0, 0), 50 + i);
    EXPECT_EQ(frame_.right_time - frame_.left_time, 4 * kMillisecond);
  }
  EXPECT_EQ(count("unpaired_frames"), 0U);
}

TEST_F(V4l2TwoTest, SwapExchangesTheDevicesAndTheirTimes) {
  add_many(left(), 1);
  add_many(right(), 1, kPeriod + kMillisecond, 51);
  open(true);
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_EQ(frame_.left.at(0, 0), 51);
  EXPECT_EQ(frame_.left_time - frame_.right_time, kMillisecond);
}

TEST_F(V4l2TwoTest, AFrameWithoutAPartnerIsDroppedAndCounted) {
  add_many(left(), 10);
  add_many(right(), 8, 3 * kPeriod, 53);  // the first two are missing
  open();
  ASSERT_EQ(capture(), Status::ok) << camera_->problem();
  EXPECT_EQ(frame_.left.at(0, 0), 3);
  EXPECT_EQ(frame_.right.at(0, 0), 53);
  EXPECT_GE(count("unpaired_frames") + count("dropped_frames"), 2U);
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_EQ(frame_.left.at(0, 0), 4);
  EXPECT_EQ(frame_.right.at(0, 0), 54);
}

TEST_F(V4l2TwoTest, CamerasThatRunApartAreBadDataBeforeTheDeadline) {
  add_many(left(), 60);
  add_many(right(), 60, kPeriod + 15 * kMillisecond);
  open();
  const Nanoseconds deadline = in_ms(1900);
  EXPECT_EQ(capture(1900), Status::bad_data);
  EXPECT_LT(clock_.now(), deadline);
  EXPECT_NE(std::string(camera_->problem()).find("ms apart, at most 5"), std::string::npos) << camera_->problem();
  EXPECT_EQ(count("unpaired_frames"), 9U);
}

TEST_F(V4l2TwoTest, OneThatGivesNothingIsATimeoutAndThePairsGoOnAfterwards) {
  add_many(left(), 30);
  add_many(right(), 3, 10 * kPeriod, 60);
  open();
  const Nanoseconds deadline = in_ms(100);
  EXPECT_EQ(capture(100), Status::timeout);
  EXPECT_EQ(clock_.now(), deadline);
  ASSERT_EQ(capture(1000), Status::ok) << camera_->problem();
  EXPECT_GE(frame_.left.at(0, 0), 10);
  EXPECT_EQ(frame_.right.at(0, 0), frame_.left.at(0, 0) + 50);
}

TEST_F(V4l2TwoTest, OnePulledPlugClosesBothAndBothComeBack) {
  add_many(left(), 60);
  add_many(right(), 60);
  open();
  ASSERT_EQ(capture(), Status::ok);
  right().unplugged_at = start_ + 90 * kMillisecond;
  right().plugged_at = start_ + 500 * kMillisecond;
  Status status = capture();
  while (status == Status::ok)
    status = capture();
  EXPECT_EQ(status, Status::disconnected);
  EXPECT_FALSE(left().streaming);
  EXPECT_EQ(left().mapped, 0);
  int calls = 0;
  while (status != Status::ok && ++calls < 50)
    status = capture(100);
  ASSERT_EQ(status, Status::ok) << camera_->problem();
  EXPECT_EQ(frame_.left_time, frame_.right_time);
  EXPECT_EQ(count("disconnections"), 1U);
}

// Both plugs are pulled, and the devices come back under each other's name.
class V4l2TwoExchangedTest : public V4l2TwoTest {
 protected:
  static constexpr int kFramesBefore = 20;

  V4l2TwoExchangedTest() : left_eye_(copy(scene_.left())), right_eye_(copy(scene_.right())), grey_(left_eye_) {
    std::fill(grey_.begin(), grey_.end(), std::uint8_t{90});
  }
  static std::vector<std::uint8_t> copy(ImageView<const std::uint8_t> image) {
    std::vector<std::uint8_t> bytes;
    for (int v = 0; v < image.height; ++v)
      bytes.insert(bytes.end(), image.row(v), image.row(v) + image.width);
    return bytes;
  }
  void film(const std::vector<std::uint8_t>& left_shows, const std::vector<std::uint8_t>& right_shows, int count) {
    for (int i = 0; i < count; ++i) {
      ++filmed_;
      left().frames.push_back({.time = start_ + filmed_ * kPeriod, .bytes = &left_shows});
      right().frames.push_back({.time = start_ + filmed_ * kPeriod, .bytes = &right_shows});
    }
  }
  void open_with_check() {
    V4l2Settings s = two_devices();
    s.width = 160;
    s.height = 120;
    s.check_eyes = true;
    left().modes = right().modes = {{.width = 160, .height = 120}};
    for (test::FakeV4l2Node* node : {&left(), &right()}) {
      node->unplugged_at = start_ + 10 * kPeriod;
      node->plugged_at = start_ + kFramesBefore * kPeriod;
    }
    camera_.emplace(s, clock_, kernel_);
    ASSERT_EQ(camera_->open(), Status::ok) << camera_->problem();
  }
  // Captures until the devices have gone and are back, and so many pairs more.
  void replug(int pairs) {
    const int before = test::allocations;
    ASSERT_EQ(capture(), Status::ok) << camera_->problem();
    while (clock_.now() < start_ + kFramesBefore * kPeriod)
      (void)capture(40);
    int good = 0;
    for (int i = 0; i < pairs + 10 && good < pairs; ++i)
      good += capture(100) == Status::ok ? 1 : 0;
    const int after = test::allocations;
    EXPECT_EQ(after, before);
    EXPECT_EQ(good, pairs) << camera_->problem();
  }
  bool left_is_left() const { return std::equal(left_eye_.begin(), left_eye_.end(), frame_.left.data); }

  const test::EyePair scene_{{.width = 160, .height = 120}};
  std::vector<std::uint8_t> left_eye_;
  std::vector<std::uint8_t> right_eye_;
  std::vector<std::uint8_t> grey_;
  int filmed_ = 0;
};

TEST_F(V4l2TwoExchangedTest, TheirEyesAreLookedAtAgain) {
  film(left_eye_, right_eye_, kFramesBefore);
  film(right_eye_, left_eye_, 30);
  open_with_check();
  replug(4);
  EXPECT_TRUE(left_is_left());
  EXPECT_EQ(count("eyes_corrected"), 1U);
}

TEST_F(V4l2TwoExchangedTest, ACorrectionIsTakenBack) {
  film(right_eye_, left_eye_, kFramesBefore);
  film(left_eye_, right_eye_, 30);
  open_with_check();
  replug(4);
  EXPECT_TRUE(left_is_left());
  EXPECT_EQ(count("eyes_corrected"), 1U);
}

TEST_F(V4l2TwoExchangedTest, WhatWasFoundHoldsWhereNothingCanBeSeen) {
  film(right_eye_, left_eye_, kFramesBefore);
  film(grey_, grey_, 12);
  film(right_eye_, left_eye_, 30);
  open_with_check();
  replug(20);
  EXPECT_EQ(count("eyes_unsure"), 5U);
  EXPECT_TRUE(left_is_left());
  EXPECT_EQ(count("eyes_corrected"), 1U);
}

}  // namespace
}  // namespace lakshya

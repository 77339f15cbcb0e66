#include "app/loop/capture.h"

#include <gtest/gtest.h>

#include "tests/support/manual_clock.h"
#include "tests/support/test_image.h"

namespace lakshya {
namespace {

constexpr int kWidth = 33;
constexpr int kHeight = 5;

using Bytes = test::PaddedImage<std::uint8_t>;

Bytes grey(int width = kWidth, int height = kHeight) {
  Bytes image(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u)
      image.view().at(u, v) = 100;
  }
  return image;
}

// Gives what it is told to, and takes `exposure` to do so.
class FakeCamera final : public StereoCamera {
 public:
  explicit FakeCamera(ManualClock& clock) : clock_(&clock) {}

  Status open() override { return Status::ok; }
  void close() override {}
  std::span<const Counter> counters() const override { return {}; }
  int width() const override { return kWidth; }
  int height() const override { return kHeight; }
  bool is_static() const override { return still; }
  Status capture(Nanoseconds deadline, StereoFrame& frame) override {
    asked_until = deadline;
    if (status != Status::ok) return status;
    frame = {.left = left.view(),
             .right = right.view(),
             .left_time = clock_->now() + left_delay,
             .right_time = clock_->now() + right_delay,
             .sequence = 0};
    clock_->advance(exposure);
    return Status::ok;
  }

  Bytes left = grey();
  Bytes right = grey();
  Status status = Status::ok;
  bool still = false;
  Nanoseconds left_delay = 0;
  Nanoseconds right_delay = 0;
  Nanoseconds exposure = 3 * kMillisecond;
  Nanoseconds asked_until = 0;

 private:
  ManualClock* clock_;
};

class CaptureTest : public testing::Test {
 protected:
  CaptureTest() {
    for (std::size_t i = 0; i < 3; ++i) {
      exchange_.raw.slots()[i].left = memory_[2 * i].view();
      exchange_.raw.slots()[i].right = memory_[2 * i + 1].view();
    }
  }
  // What control is told of one capture.
  FrameNote step() {
    status_ = capture_.step(clock_.now() + kSecond);
    EXPECT_TRUE(exchange_.frame.take());
    EXPECT_EQ(exchange_.frame.reading().status, status_);
    return exchange_.frame.reading();
  }

  ManualClock clock_;
  FakeCamera camera_{clock_};
  std::array<Bytes, 6> memory_{grey(), grey(), grey(), grey(), grey(), grey()};
  Exchange exchange_;
  Capture capture_{SafetyConfig{}, camera_, clock_, exchange_};
  Status status_ = Status::timeout;
};

TEST_F(CaptureTest, APairIsCopiedNumberedAndStamped) {
  std::mt19937 random(3);
  test::fill_random(camera_.left.view(), random, 0, 255);
  test::fill_random(camera_.right.view(), random, 0, 255);
  const Nanoseconds begin = clock_.now();
  EXPECT_EQ(step().count, 1U);
  EXPECT_EQ(camera_.asked_until, begin + kSecond);
  ASSERT_TRUE(exchange_.raw.take());
  const RawPair& raw = exchange_.raw.reading();
  EXPECT_TRUE(test::equal_images(raw.left, camera_.left.view()));
  EXPECT_TRUE(test::equal_images(raw.right, camera_.right.view()));
  EXPECT_EQ(raw.number, 1U);
  EXPECT_EQ(raw.taken, begin);
  EXPECT_EQ(raw.arrived, begin + camera_.exposure);
  EXPECT_EQ(step().count, 2U);
  ASSERT_TRUE(exchange_.raw.take());
  EXPECT_EQ(exchange_.raw.reading().number, 2U);
  for (const Bytes& image : memory_)
    EXPECT_TRUE(image.canaries_alive());
}

TEST_F(CaptureTest, ThePairIsAsOldAsItsOlderEye) {
  const Nanoseconds begin = clock_.now();
  camera_.left_delay = -2 * kMillisecond;
  camera_.right_delay = -9 * kMillisecond;
  FrameNote note = step();
  EXPECT_EQ(note.skew, 7 * kMillisecond);
  EXPECT_EQ(note.taken, begin - 9 * kMillisecond);
  EXPECT_EQ(note.arrived, begin + camera_.exposure);
  camera_.left_delay = -11 * kMillisecond;
  note = step();
  EXPECT_EQ(note.skew, 2 * kMillisecond);
  EXPECT_EQ(note.taken, begin + camera_.exposure - 11 * kMillisecond);
}

TEST_F(CaptureTest, TheDarkerAndTheBrighterEyeCount) {
  for (int u = 0; u < 11; ++u) {
    camera_.left.view().at(u, 2) = 3;
    camera_.right.view().at(u, 1) = 252;
    camera_.right.view().at(u, 3) = 252;
  }
  camera_.right.view().at(0, 0) = 0;
  camera_.left.view().at(0, 0) = 255;
  const FrameNote note = step();
  EXPECT_DOUBLE_EQ(note.dark, 11.0 / (33 * 5));
  EXPECT_DOUBLE_EQ(note.bright, 22.0 / (33 * 5));
}

TEST_F(CaptureTest, PairsThatAreTheSameAreCountedInARow) {
  EXPECT_EQ(step().same, 0);
  EXPECT_EQ(step().same, 1);
  EXPECT_EQ(step().same, 2);
  // One eye is enough, the one that has been the same for longer.
  camera_.right.view().at(32, 4) = 101;
  EXPECT_EQ(step().same, 3);
  camera_.left.view().at(0, 0) = 99;
  EXPECT_EQ(step().same, 1);
  camera_.left.view().at(0, 0) = 98;
  camera_.right.view().at(32, 4) = 102;
  EXPECT_EQ(step().same, 0);
  std::swap(camera_.left, camera_.right);
  EXPECT_EQ(step().same, 0);
}

TEST_F(CaptureTest, WhatDidNotComeIsNoPairThatIsTheSame) {
  (void)step();
  EXPECT_EQ(step().same, 1);
  camera_.status = Status::timeout;
  EXPECT_EQ(step().same, 1);
  EXPECT_EQ(step().same, 1);
  camera_.status = Status::ok;
  EXPECT_EQ(step().same, 2);
}

TEST_F(CaptureTest, AStillPictureIsNotAFrozenCamera) {
  camera_.still = true;
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(step().same, 0);
}

TEST_F(CaptureTest, WhatFailedIsToldAndHandsNothingOver) {
  const FrameNote first = step();
  ASSERT_TRUE(exchange_.raw.take());
  for (const Status status : {Status::timeout, Status::disconnected, Status::bad_data, Status::end_of_data}) {
    camera_.status = status;
    clock_.advance(kSecond);
    const FrameNote note = step();
    EXPECT_EQ(status_, status);
    EXPECT_EQ(note.count, 1U);
    EXPECT_EQ(note.arrived, first.arrived);
    EXPECT_EQ(note.taken, first.taken);
    EXPECT_EQ(note.over, status == Status::end_of_data);
    EXPECT_FALSE(exchange_.raw.take());
  }
  camera_.status = Status::ok;
  const FrameNote note = step();
  EXPECT_EQ(note.count, 2U);
  EXPECT_FALSE(note.over);
  EXPECT_EQ(note.damaged, 1U);  // so far
}

TEST_F(CaptureTest, DamagedPairsAreCounted) {
  camera_.status = Status::bad_data;
  EXPECT_EQ(step().damaged, 1U);
  EXPECT_EQ(step().damaged, 2U);
  camera_.status = Status::timeout;
  EXPECT_EQ(step().damaged, 2U);
  camera_.status = Status::ok;
  EXPECT_EQ(step().damaged, 2U);
}

TEST_F(CaptureTest, APairOfAnotherSizeIsDamaged) {
  const Bytes usual = grey();
  std::uint64_t damaged = 0;
  for (const auto& [width, height] :
       {std::pair{kWidth + 1, kHeight}, {kWidth - 1, kHeight}, {kWidth, kHeight + 1}, {0, 0}}) {
    camera_.left = grey(width, height);
    camera_.right = usual;
    EXPECT_EQ(step().damaged, ++damaged) << width << "x" << height;
    EXPECT_EQ(status_, Status::bad_data);
    std::swap(camera_.left, camera_.right);
    EXPECT_EQ(step().damaged, ++damaged) << width << "x" << height;
    camera_.left = camera_.right;
    EXPECT_EQ(step().damaged, ++damaged) << width << "x" << height;
  }
  EXPECT_FALSE(exchange_.raw.take());
  for (const Bytes& image : memory_)
    EXPECT_TRUE(image.canaries_alive());
}

TEST_F(CaptureTest, PairsThatPerceptionDidNotTakeAreDropped) {
  (void)step();
  EXPECT_EQ(exchange_.dropped, 0U);
  (void)step();
  (void)step();
  EXPECT_EQ(exchange_.dropped, 2U);
  ASSERT_TRUE(exchange_.raw.take());
  EXPECT_EQ(exchange_.raw.reading().number, 3U);
  (void)step();
  EXPECT_EQ(exchange_.dropped, 2U);
  camera_.status = Status::timeout;
  (void)step();
  EXPECT_EQ(exchange_.dropped, 2U);
}

}  // namespace
}  // namespace lakshya

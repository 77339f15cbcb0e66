// V4l2Camera: streaming, times, faults, the plug.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "hal/camera/v4l2_camera.h"
#include "tests/support/count_allocations.h"
#include "tests/support/eye_pair.h"
#include "tests/support/jpeg_picture.h"
#include "tests/support/v4l2_rig.h"

namespace lakshya {
namespace {

class V4l2Test : public test::V4l2Rig {
 protected:
  void open(const V4l2Settings& s) {
    camera_.emplace(s, clock_, kernel_);
    ASSERT_EQ(camera_->open(), Status::ok) << camera_->problem();
  }
  Status capture(int ms = 100) { return camera_->capture(in_ms(ms), frame_); }
  std::uint64_t count(const char* name) const { return test::count_of(*camera_, name); }

  std::optional<V4l2Camera> camera_;
};

TEST_F(V4l2Test, GreyHalvesLieInTheDriversBuffer) {
  left().line_padding = 6;
  left().frames.push_back({.time = start_ + kPeriod, .bytes = picture(7, 70), .stamped_before = 5 * kMillisecond});
  open(settings());
  EXPECT_EQ(camera_->width(), 32);
  EXPECT_EQ(camera_->height(), 32);
  ASSERT_EQ(capture(), Status::ok) << camera_->problem();
  EXPECT_EQ(frame_.left.at(0, 0), 7);
  EXPECT_EQ(frame_.left.at(31, 31), 7);
  EXPECT_EQ(frame_.right.at(3, 0), 107);
  EXPECT_EQ(frame_.right.data - frame_.left.data, 32);
  EXPECT_EQ(frame_.left.stride, 70);
  EXPECT_EQ(frame_.left_time, start_ + kPeriod - 5 * kMillisecond);
  EXPECT_EQ(frame_.right_time, frame_.left_time);
  EXPECT_EQ(clock_.now(), start_ + kPeriod);
  EXPECT_EQ(count("decoded_jpegs"), 0U);
}

TEST_F(V4l2Test, SwapExchangesTheHalves) {
  add_many(left(), 1);
  V4l2Settings s = settings();
  s.swap = true;
  open(s);
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_EQ(frame_.left.at(0, 0), 101);
  EXPECT_EQ(frame_.right.at(0, 0), 1);
}

TEST_F(V4l2Test, TheNewestOfThoseThatWaitIsTaken) {
  add_many(left(), 5);
  open(settings());
  time_.advance(3 * kPeriod - kMillisecond);  // two wait
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_EQ(frame_.left.at(0, 0), 2);
  EXPECT_EQ(clock_.waits, 0);
  EXPECT_EQ(count("dropped_frames"), 1U);
  EXPECT_EQ(count("lost_frames"), 0U);
  const std::uint64_t first = frame_.sequence;
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_EQ(frame_.left.at(0, 0), 3);
  EXPECT_EQ(frame_.sequence, first + 1);
}

TEST_F(V4l2Test, AfterAPauseAFreshFrameIsWaitedFor) {
  add_many(left(), 20);
  open(settings());
  time_.advance(10 * kPeriod + kMillisecond);  // four fill, six find no room
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_EQ(frame_.left.at(0, 0), 11);
  EXPECT_EQ(count("dropped_frames"), 4U);
  EXPECT_EQ(count("lost_frames"), 6U);
}

TEST_F(V4l2Test, AfterAPauseThatHasNoEndTheLastOneIsBetterThanNone) {
  add_many(left(), 4);
  open(settings());
  time_.advance(10 * kPeriod);
  const Nanoseconds before = clock_.now();
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_EQ(frame_.left.at(0, 0), 4);
  EXPECT_LE(clock_.now(), before + 2 * kSecond / 30);
  EXPECT_EQ(frame_.left_time, start_ + 4 * kPeriod - 2 * kMillisecond);
}

TEST_F(V4l2Test, TheBufferInUseIsNotFilledAgain) {
  add_many(left(), 40);
  open(settings());
  ASSERT_EQ(capture(), Status::ok);
  time_.advance(20 * kPeriod);
  (void)kernel_.ready(100);  // the kernel delivers what it can
  EXPECT_EQ(frame_.left.at(31, 31), 1);
}

TEST_F(V4l2Test, ACaptureEndsAtItsDeadline) {
  open(settings());
  const Nanoseconds deadline = in_ms(70);
  EXPECT_EQ(capture(70), Status::timeout);
  EXPECT_EQ(clock_.now(), deadline);
  EXPECT_EQ(camera_->capture(clock_.now() - kSecond, frame_), Status::timeout);
  EXPECT_EQ(clock_.now(), deadline);
}

TEST_F(V4l2Test, ADescriptorThatIsAlwaysReadyDoesNotSpin) {
  left().false_alarm = true;
  open(settings());
  const Nanoseconds deadline = in_ms(50);
  EXPECT_EQ(capture(50), Status::timeout);
  EXPECT_EQ(clock_.now(), deadline);
  EXPECT_LT(clock_.waits, 60);
}

TEST_F(V4l2Test, TornAndShortFramesAreBadDataAndTheNextIsGood) {
  add(left(), 1 * kPeriod, 1).flags |= V4L2_BUF_FLAG_ERROR;
  add(left(), 2 * kPeriod, 2).used = 64 * 32 - 1;
  add(left(), 3 * kPeriod, 3).used = 0;
  add_many(left(), 3, 4 * kPeriod, 4);
  open(settings());
  EXPECT_EQ(capture(), Status::bad_data);
  EXPECT_NE(std::string(camera_->problem()).find("torn"), std::string::npos) << camera_->problem();
  EXPECT_EQ(capture(), Status::bad_data);
  EXPECT_NE(std::string(camera_->problem()).find("short frame: 2047"), std::string::npos) << camera_->problem();
  EXPECT_EQ(capture(), Status::bad_data);
  for (int i = 4; i <= 6; ++i) {
    ASSERT_EQ(capture(), Status::ok) << i;  // no buffer went missing
    EXPECT_EQ(frame_.left.at(0, 0), i);
  }
  EXPECT_EQ(count("torn_frames"), 1U);
  EXPECT_EQ(count("short_frames"), 2U);
}

TEST_F(V4l2Test, AGoodFrameBeforeATornOneIsGiven) {
  add(left(), kPeriod, 1);
  add(left(), kPeriod + 1, 2).flags |= V4L2_BUF_FLAG_ERROR;
  open(settings());
  time_.advance(2 * kPeriod);
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_EQ(frame_.left.at(0, 0), 1);
}

TEST_F(V4l2Test, GapsInTheNumbersAreLostPairs) {
  add_many(left(), 1);
  add(left(), 2 * kPeriod, 2).gap = 3;
  open(settings());
  ASSERT_EQ(capture(), Status::ok);
  const std::uint64_t first = frame_.sequence;
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_EQ(frame_.sequence, first + 4);
  EXPECT_EQ(count("lost_frames"), 3U);
}

TEST_F(V4l2Test, StampsOfAnotherClockAreReplaced) {
  add(left(), 1 * kPeriod, 1).flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  add(left(), 2 * kPeriod, 2).stamped_before = -kSecond;      // in the future
  add(left(), 3 * kPeriod, 3).stamped_before = 11 * kSecond;  // long ago
  add(left(), 4 * kPeriod, 4);
  open(settings());
  for (int i = 1; i <= 3; ++i) {
    ASSERT_EQ(capture(), Status::ok);
    EXPECT_EQ(frame_.left_time, start_ + i * kPeriod);
    EXPECT_EQ(count("unstamped_frames"), static_cast<std::uint64_t>(i));
  }
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_EQ(frame_.left_time, start_ + 4 * kPeriod - 2 * kMillisecond);
  EXPECT_EQ(count("unstamped_frames"), 3U);
}

TEST_F(V4l2Test, APulledPlugIsNoticedAndTheCameraIsUsedAgainWhenItIsBack) {
  add_many(left(), 60);
  open(settings());
  ASSERT_EQ(capture(), Status::ok);
  const std::uint64_t last = frame_.sequence;
  left().unplugged_at = start_ + 2 * kPeriod - kMillisecond;
  left().plugged_at = start_ + 700 * kMillisecond;
  EXPECT_EQ(capture(), Status::disconnected);
  EXPECT_EQ(clock_.now(), left().unplugged_at);
  EXPECT_NE(std::string(camera_->problem()).find("/dev/video0: gone: No such device"), std::string::npos)
      << camera_->problem();
  EXPECT_EQ(left().mapped, 0);
  EXPECT_EQ(left().opened, left().closed);

  int calls = 0;
  Status status = Status::disconnected;
  const Nanoseconds gone = clock_.now();
  while (status != Status::ok && calls < 100) {
    const Nanoseconds deadline = in_ms(50);
    status = capture(50);
    EXPECT_LE(clock_.now(), deadline);
    ++calls;
  }
  EXPECT_EQ(status, Status::ok) << camera_->problem();
  EXPECT_LE(clock_.now(), left().plugged_at + 200 * kMillisecond + kPeriod);
  EXPECT_GE(calls, static_cast<int>((left().plugged_at - gone) / (50 * kMillisecond)));  // nobody spins
  EXPECT_GT(frame_.sequence, last);
  EXPECT_EQ(left().opened, 2);
  EXPECT_EQ(count("disconnections"), 1U);
}

TEST_F(V4l2Test, AClosedCameraStaysClosed) {
  add_many(left(), 9);
  open(settings());
  ASSERT_EQ(capture(), Status::ok);
  camera_->close();
  EXPECT_FALSE(left().streaming);
  EXPECT_EQ(left().mapped, 0);
  EXPECT_EQ(capture(), Status::disconnected);
  EXPECT_EQ(left().opened, 1);
  camera_->close();
  ASSERT_EQ(camera_->open(), Status::ok);
  ASSERT_EQ(camera_->open(), Status::ok);  // closes it first
  EXPECT_EQ(left().mapped, 4);
  EXPECT_EQ(capture(), Status::ok);
  camera_.reset();
  EXPECT_EQ(left().mapped, 0);
  EXPECT_EQ(left().opened, left().closed);
}

TEST_F(V4l2Test, FailuresOfTheDriver) {
  add_many(left(), 90);
  open(settings());
  left().io_errors = 2;
  EXPECT_EQ(capture(), Status::bad_data);
  EXPECT_EQ(capture(), Status::bad_data);
  EXPECT_EQ(capture(), Status::ok);
  EXPECT_EQ(count("io_errors"), 2U);

  left().io_errors = 8;  // in a row: it is set up anew
  int bad = 0;
  Status status = capture();
  for (; status == Status::bad_data; status = capture())
    ++bad;
  EXPECT_EQ(bad, 7);
  EXPECT_EQ(status, Status::disconnected);
  EXPECT_EQ(capture(300), Status::ok);
  EXPECT_EQ(left().opened, 2);

  left().wrong_index = 50;
  EXPECT_EQ(capture(), Status::disconnected);
  left().wrong_index = 0;
  EXPECT_EQ(capture(400), Status::ok);
  left().errors[VIDIOC_QBUF] = EIO;
  EXPECT_EQ(capture(), Status::disconnected);
}

TEST_F(V4l2Test, LumaOfYuyv) {
  left().modes = {{.fourcc = V4L2_PIX_FMT_YUYV}};
  std::vector<std::uint8_t> bytes(std::size_t{128} * 32, 128);
  for (std::size_t i = 0; i < bytes.size(); i += 2)
    bytes[i] = static_cast<std::uint8_t>(i % 128 < 64 ? 20 : 30);
  left().frames.push_back({.time = start_ + kPeriod, .bytes = &bytes});
  V4l2Settings s = settings();
  s.format = V4l2Format::yuyv;
  open(s);
  ASSERT_EQ(capture(), Status::ok);
  for (int u = 0; u < 32; ++u) {
    EXPECT_EQ(frame_.left.at(u, 31), 20);
    EXPECT_EQ(frame_.right.at(u, 31), 30);
  }
}

TEST_F(V4l2Test, MotionJpegGoodAndDamaged) {
  const std::vector<std::uint8_t>* const plain = picture(40);
  const auto jpeg = test::without_tables(test::jpeg_of({plain->data(), 64, 32}));
  auto damaged = jpeg;
  damaged.resize(jpeg.size() / 2);
  left().modes = {{.fourcc = V4L2_PIX_FMT_MJPEG}};
  left().frames = {{.time = start_ + kPeriod, .bytes = &damaged}, {.time = start_ + 2 * kPeriod, .bytes = &jpeg}};
  V4l2Settings s = settings();
  s.format = V4l2Format::mjpg;
  open(s);
  EXPECT_EQ(capture(), Status::bad_data);
  EXPECT_NE(std::string(camera_->problem()).find("damaged"), std::string::npos) << camera_->problem();
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_NEAR(frame_.left.at(5, 5), 40, 2);
  EXPECT_NEAR(frame_.right.at(5, 5), 140, 2);
  EXPECT_EQ(count("damaged_jpegs"), 1U);
  EXPECT_EQ(count("decoded_jpegs"), 2U);
}

TEST_F(V4l2Test, NothingIsAllocatedAfterOpen) {
  const test::EyePair scene({.width = 160, .height = 120});
  left().modes = {{.width = 320, .height = 120}};
  for (int i = 1; i <= 60; ++i)
    left().frames.push_back({.time = start_ + i * kPeriod, .bytes = &scene.side_by_side()});
  left().frames[3].flags |= V4L2_BUF_FLAG_ERROR;
  V4l2Settings s = settings();
  s.width = 160;
  s.height = 120;
  s.check_eyes = true;
  open(s);
  left().unplugged_at = start_ + 10 * kPeriod;
  left().plugged_at = start_ + 20 * kPeriod;
  const int before = test::allocations;
  int good = 0;
  for (int i = 0; i < 50; ++i)
    good += capture(40) == Status::ok ? 1 : 0;
  EXPECT_EQ(test::allocations, before);
  EXPECT_GT(good, 20);
  EXPECT_EQ(count("disconnections"), 1U);
}

TEST_F(V4l2Test, SwappedEyesAreCorrectedOnce) {
  const test::EyePair scene({.width = 160, .height = 120});
  left().modes = {{.width = 320, .height = 120}};
  for (int i = 1; i <= 3; ++i)
    left().frames.push_back({.time = start_ + i * kPeriod, .bytes = &scene.side_by_side()});
  V4l2Settings s = settings();
  s.width = 160;
  s.height = 120;
  s.check_eyes = true;
  s.swap = true;  // wrong: the left half is the left eye
  open(s);
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(capture(), Status::ok);
    EXPECT_EQ(frame_.right.data - frame_.left.data, 160);
  }
  EXPECT_EQ(count("eyes_corrected"), 1U);
  EXPECT_NE(std::string(camera_->problem()).find("swapped"), std::string::npos) << camera_->problem();
}

TEST_F(V4l2Test, WhereTheEyesCannotBeToldTheSettingHolds) {
  add_many(left(), 8);
  V4l2Settings s = settings();
  s.check_eyes = true;
  s.swap = true;
  open(s);
  for (int i = 1; i <= 8; ++i) {
    ASSERT_EQ(capture(), Status::ok);
    EXPECT_EQ(frame_.left.at(0, 0), 100 + i);
  }
  EXPECT_EQ(count("eyes_unsure"), 5U);
  EXPECT_EQ(count("eyes_corrected"), 0U);
}

}  // namespace
}  // namespace lakshya

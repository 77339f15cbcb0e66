#include "hal/camera/bumblebee_camera.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "hal/camera/dc1394_camera.h"
#include "tests/support/bumblebee_bytes.h"
#include "tests/support/count_allocations.h"
#include "tests/support/eye_pair.h"
#include "tests/support/fake_iidc.h"

namespace lakshya {
namespace {

constexpr Nanoseconds kPeriod = 50 * kMillisecond;

class BumblebeeCameraTest : public testing::Test {
 protected:
  static BumblebeeSettings settings() { return {.width = 160, .height = 120, .check_eyes = false}; }

  // `count` more frames, one each period, taken 3 ms before they are there.
  void add(int count) {
    for (int i = 0; i < count; ++i) {
      last_ += kPeriod;
      bus_.frames.push_back({last_, {bytes_, 160, 120, 320, 3 * kMillisecond, false}});
    }
  }
  void open(const BumblebeeSettings& s) {
    camera_.emplace(s, bus_, clock_);
    ASSERT_EQ(camera_->open(), Status::ok) << camera_->problem();
  }
  Status capture(int ms = 100) { return camera_->capture(clock_.now() + ms * kMillisecond, frame_); }
  std::uint64_t count(const std::string& name) const {
    for (const Counter& counter : camera_->counters()) {
      if (name == counter.name) return counter.value;
    }
    ADD_FAILURE() << name;
    return 0;
  }
  bool left_is(ImageView<const std::uint8_t> image) const {
    for (int v = 0; v < image.height; ++v) {
      if (!std::equal(image.row(v), image.row(v) + image.width, frame_.left.row(v))) return false;
    }
    return true;
  }

  ManualClock clock_;
  test::FakeIidc bus_{clock_};
  test::EyePair scene_{{.width = 160, .height = 120}};
  std::vector<std::uint8_t> bytes_ = test::interleaved(scene_.right(), scene_.left());
  const Nanoseconds start_ = clock_.now();
  Nanoseconds last_ = start_;
  StereoFrame frame_;
  std::optional<BumblebeeCamera> camera_;
};

TEST_F(BumblebeeCameraTest, BothEyesOfAGreyHead) {
  add(2);
  BumblebeeSettings s = settings();
  s.guid = 0x00b09d0100112233;
  s.packet_bytes = 2048;
  open(s);
  EXPECT_EQ(bus_.request.guid, s.guid);
  EXPECT_EQ(bus_.request.packet_bytes, 2048);
  EXPECT_EQ(camera_->width(), 160);
  EXPECT_EQ(camera_->height(), 120);
  ASSERT_EQ(capture(), Status::ok) << camera_->problem();
  EXPECT_TRUE(left_is(scene_.left()));
  EXPECT_EQ(frame_.left_time, start_ + kPeriod - 3 * kMillisecond);
  EXPECT_EQ(frame_.right_time, frame_.left_time);
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_EQ(frame_.sequence, 2U);
}

TEST_F(BumblebeeCameraTest, TheSettingOfTheOrderIsCheckedByTheImages) {
  add(3);
  BumblebeeSettings s = settings();
  s.first_is_left = true;  // wrong
  open(s);
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_TRUE(left_is(scene_.right()));
  s.check_eyes = true;
  open(s);
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_TRUE(left_is(scene_.left()));
  EXPECT_EQ(count("eyes_corrected"), 1U);
  EXPECT_NE(std::string(camera_->problem()).find("swapped"), std::string::npos) << camera_->problem();
}

TEST_F(BumblebeeCameraTest, AColourHeadGivesGrey) {
  for (std::uint8_t& byte : bytes_)
    byte = 77;
  add(1);
  BumblebeeSettings s = settings();
  s.pattern = BayerPattern::gbrg;
  open(s);
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_EQ(frame_.left.at(0, 0), 77);
  EXPECT_EQ(frame_.right.at(159, 119), 77);
}

TEST_F(BumblebeeCameraTest, TheNewestIsTaken) {
  add(4);
  open(settings());
  clock_.advance(3 * kPeriod + kMillisecond);
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_EQ(frame_.sequence, 3U);
  EXPECT_EQ(count("dropped_frames"), 2U);
}

// A frame's age holds when it is fetched; what is done with it afterwards takes time.
TEST_F(BumblebeeCameraTest, TheTimeIsNotLaterByWhatComesAfterTheFetch) {
  add(1);
  bus_.fetch_takes = 7 * kMillisecond;
  open(settings());
  ASSERT_EQ(capture(), Status::ok) << camera_->problem();
  EXPECT_EQ(frame_.left_time, start_ + kPeriod + 7 * kMillisecond - 3 * kMillisecond);
  EXPECT_GT(clock_.now(), start_ + kPeriod + 7 * kMillisecond) << "nothing took time afterwards";
}

TEST_F(BumblebeeCameraTest, DamagedFrames) {
  add(5);
  bus_.frames[0].frame.torn = true;
  bus_.frames[1].frame.bytes = std::span(bytes_).first(bytes_.size() - 1);
  bus_.frames[2].frame.width = 80;
  bus_.frames[3].frame.age = -1;
  open(settings());
  EXPECT_EQ(capture(), Status::bad_data);
  EXPECT_NE(std::string(camera_->problem()).find("torn"), std::string::npos);
  EXPECT_EQ(capture(), Status::bad_data);
  EXPECT_EQ(capture(), Status::bad_data);
  EXPECT_NE(std::string(camera_->problem()).find("80 x 120"), std::string::npos) << camera_->problem();
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_EQ(frame_.left_time, clock_.now());
  ASSERT_EQ(capture(), Status::ok);
  EXPECT_EQ(count("torn_frames"), 1U);
  EXPECT_EQ(count("short_frames"), 2U);
  EXPECT_EQ(count("unstamped_frames"), 1U);
}

TEST_F(BumblebeeCameraTest, ACaptureEndsAtItsDeadlineAndDoesNotSpin) {
  open(settings());
  EXPECT_EQ(capture(70), Status::timeout);
  EXPECT_EQ(clock_.now(), start_ + 70 * kMillisecond);
  bus_.always_ready = true;
  EXPECT_EQ(capture(30), Status::timeout);
  EXPECT_EQ(clock_.now(), start_ + 100 * kMillisecond);
}

TEST_F(BumblebeeCameraTest, APulledPlugIsNoticedAndTheCameraIsUsedAgainWhenItIsBack) {
  add(40);
  open(settings());
  ASSERT_EQ(capture(), Status::ok);
  bus_.unplugged_at = clock_.now() + kMillisecond;
  bus_.plugged_at = clock_.now() + 500 * kMillisecond;
  clock_.advance(2 * kMillisecond);
  EXPECT_EQ(capture(), Status::disconnected);
  EXPECT_FALSE(bus_.running);
  int calls = 0;
  Status status = Status::disconnected;
  while (status != Status::ok && ++calls < 50) {
    const Nanoseconds deadline = clock_.now() + 60 * kMillisecond;
    status = capture(60);
    EXPECT_LE(clock_.now(), deadline);
  }
  EXPECT_EQ(status, Status::ok);
  EXPECT_GE(calls, 8);
  EXPECT_EQ(bus_.started, 2);
  EXPECT_EQ(count("disconnections"), 1U);
  EXPECT_LE(clock_.now(), bus_.plugged_at + 200 * kMillisecond + kPeriod);
}

TEST_F(BumblebeeCameraTest, SettingsAndCamerasThatAreRefused) {
  for (const BumblebeeSettings& s :
       {BumblebeeSettings{.width = 15}, BumblebeeSettings{.width = 641}, BumblebeeSettings{.height = 5000},
        BumblebeeSettings{.height = 481}, BumblebeeSettings{.packet_bytes = -1}, BumblebeeSettings{.buffers = 1},
        BumblebeeSettings{.buffers = 33}}) {
    BumblebeeCamera camera(s, bus_, clock_);
    EXPECT_EQ(camera.open(), Status::bad_argument);
    EXPECT_EQ(bus_.started, 0);
  }
  bus_.answer = Status::unsupported;
  BumblebeeCamera camera(settings(), bus_, clock_);
  EXPECT_EQ(camera.open(), Status::unsupported);
  EXPECT_STREQ(camera.problem(), "fake: unsupported");
  EXPECT_EQ(camera.capture(clock_.now() + kSecond, frame_), Status::disconnected);
  bus_.answer = Status::ok;
  EXPECT_EQ(camera.open(), Status::ok);
  camera.close();
  camera.close();
  EXPECT_EQ(bus_.stopped, 1);
}

TEST_F(BumblebeeCameraTest, NothingIsAllocatedAfterOpen) {
  add(10);
  BumblebeeSettings s = settings();
  s.check_eyes = true;
  s.pattern = BayerPattern::rggb;
  open(s);
  const int before = test::allocations;
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(capture(), Status::ok);
  EXPECT_EQ(test::allocations, before);
}

// No machine that tests has such a camera: it says so, in either way of building.
TEST(Dc1394Camera, WithoutABusThereIsNoCamera) {
  ManualClock clock;
  const auto bus = make_dc1394_camera();
  BumblebeeCamera camera({.guid = 1}, *bus, clock);
  const Status status = camera.open();
  EXPECT_TRUE(status == Status::disconnected || status == Status::unsupported) << to_string(status);
  EXPECT_NE(std::string(camera.problem()).find("IEEE 1394: "), std::string::npos) << camera.problem();
  EXPECT_EQ(bus->fd(), -1);
  IidcFrame frame;
  EXPECT_EQ(bus->fetch(frame), Status::disconnected);
}

TEST(Dc1394Camera, TheLibraryPrintsNothing) {
  using Log = void (*)(const char* format, ...);
  const auto bus = make_dc1394_camera();
  for (const char* name : {"dc1394_log_error", "dc1394_log_warning"}) {
    const auto log = reinterpret_cast<Log>(dlsym(RTLD_DEFAULT, name));
    if (log == nullptr) GTEST_SKIP() << "built without libdc1394";
    testing::internal::CaptureStderr();
    log("printed by %s\n", name);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  }
}

}  // namespace
}  // namespace lakshya

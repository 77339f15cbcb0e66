#include "hal/camera/v4l2_list.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <cstring>

#include "hal/camera/v4l2_modes.h"
#include "tests/support/fake_v4l2.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

class V4l2ListTest : public testing::Test {
 protected:
  ManualClock clock_;
  test::FakeV4l2 kernel_{clock_};
};

TEST_F(V4l2ListTest, CamerasWithWhatTheyOffer) {
  test::FakeV4l2Node& node = kernel_.node("/dev/video3");
  node.card = "Two Eyes: a name that is longer than the thirty-one";
  node.modes = {{.fourcc = V4L2_PIX_FMT_YUYV, .width = 1280, .height = 480, .rates = {30, 15}},
                {.fourcc = V4L2_PIX_FMT_YUYV, .width = 640, .height = 240, .rates = {60}},
                {.fourcc = V4L2_PIX_FMT_MJPEG, .width = 2560, .height = 720, .rates = {}}};
  const auto found = list_v4l2(kernel_);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].path, "/dev/video3");
  EXPECT_EQ(found[0].card, "Two Eyes: a name that is longer");
  EXPECT_EQ(found[0].problem, "");
  ASSERT_EQ(found[0].offers.size(), 3U);
  EXPECT_EQ(found[0].offers[0].format, "YUYV");
  EXPECT_EQ(found[0].offers[0].width, 1280);
  EXPECT_EQ(found[0].offers[0].height, 480);
  EXPECT_FALSE(found[0].offers[0].up_to);
  EXPECT_EQ(found[0].offers[0].fps, (std::vector<double>{30, 15}));
  EXPECT_EQ(found[0].offers[1].fps, (std::vector<double>{60}));
  EXPECT_EQ(found[0].offers[2].format, "MJPG");
  EXPECT_TRUE(found[0].offers[2].fps.empty());
  EXPECT_EQ(node.opened, node.closed);
}

TEST_F(V4l2ListTest, WhatIsNoCameraIsLeftOutAndWhatMayNotBeAskedIsNamed) {
  kernel_.node("/dev/video0").capabilities = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING;
  kernel_.node("/dev/video1").open_error = EACCES;
  kernel_.node("/dev/video2").errors[VIDIOC_QUERYCAP] = ENOTTY;
  kernel_.node("/dev/video64");
  const auto found = list_v4l2(kernel_);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].path, "/dev/video1");
  EXPECT_EQ(found[0].problem, "Permission denied");
  EXPECT_EQ(list_v4l2(kernel_, "/dev/video", 65).size(), 2U);
  EXPECT_EQ(list_v4l2(kernel_, "/dev/camera").size(), 0U);
}

TEST_F(V4l2ListTest, AnyFileOfTheSystemMayBeAsked) {
  const TempFolder folder;
  folder.write("file0", std::string("no camera"));
  EXPECT_EQ(list_v4l2(linux_system_calls(), folder.path("file"), 2).size(), 0U);
}

// A driver that states ranges, and one that never ends.
class Ranges final : public SystemCalls {
 public:
  int open(const char*, int) override { return 3; }
  int close(int) override { return 0; }
  void* mmap(int, std::size_t, std::int64_t) override { return nullptr; }
  void munmap(void*, std::size_t) override {}
  long read_at_start(int, std::span<char>) override { return -EINVAL; }
  long write_at_start(int, std::span<const char>) override { return -EINVAL; }
  int ioctl(int, unsigned long request, void* argument) override {
    if (request == VIDIOC_ENUM_FMT) static_cast<v4l2_fmtdesc*>(argument)->pixelformat = 0x01594559;
    if (request == VIDIOC_ENUM_FRAMESIZES) {
      auto& size = *static_cast<v4l2_frmsizeenum*>(argument);
      size.type = V4L2_FRMSIZE_TYPE_STEPWISE;
      size.stepwise = {16, 4096, 16, 16, 2160, 8};
    }
    if (request == VIDIOC_ENUM_FRAMEINTERVALS) {
      auto& interval = *static_cast<v4l2_frmivalenum*>(argument);
      interval.type = V4L2_FRMIVAL_TYPE_CONTINUOUS;
      interval.stepwise = {{1, 120}, {1, 5}, {1, 1}};
    }
    if (request == VIDIOC_QUERYCAP) {
      auto& has = *static_cast<v4l2_capability*>(argument);
      has.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;  // an old driver: no device_caps
      std::memset(has.card, 'x', sizeof has.card);
    }
    return 0;
  }
};

TEST_F(V4l2ListTest, RangesAndDriversWithoutAnEnd) {
  Ranges calls;
  const auto found = list_v4l2(calls, "any", 1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].card, std::string(32, 'x'));
  ASSERT_EQ(found[0].offers.size(), static_cast<std::size_t>(kMostV4l2Answers));
  EXPECT_EQ(found[0].offers[0].format, "YEY?");
  EXPECT_TRUE(found[0].offers[0].up_to);
  EXPECT_EQ(found[0].offers[0].width, 4096);
  EXPECT_EQ(found[0].offers[0].height, 2160);
  EXPECT_EQ(found[0].offers[0].fps, (std::vector<double>{120, 5}));
}

}  // namespace
}  // namespace lakshya

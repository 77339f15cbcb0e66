// V4l2Camera: settings, formats, controls, and what a node may refuse.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "tests/support/v4l2_rig.h"

namespace lakshya {
namespace {

class V4l2OpenTest : public test::V4l2Rig {
 protected:
  // The status of open(); problem_ is what it said.
  Status open(const V4l2Settings& s) {
    V4l2Camera camera(s, clock_, kernel_);
    const Status status = camera.open();
    problem_ = camera.problem();
    not_taken_ = test::count_of(camera, "settings_not_taken");
    EXPECT_TRUE(status == Status::ok || !problem_.empty());
    camera.close();
    EXPECT_EQ(left().mapped, 0);
    EXPECT_EQ(left().opened, left().closed);
    return status;
  }
  Status open_with(const std::function<void(V4l2Settings&)>& change) {
    V4l2Settings s = settings();
    change(s);
    return open(s);
  }
  bool says(const std::string& text) const { return problem_.find(text) != std::string::npos; }

  std::string problem_;
  std::uint64_t not_taken_ = 0;
};

TEST_F(V4l2OpenTest, ImpossibleSettingsAreBadArguments) {
  using S = V4l2Settings;
  for (const std::function<void(S&)>& change : std::vector<std::function<void(S&)>>{
           [](S& s) { s.device.clear(); },
           [](S& s) { s.right_device = s.device; },
           [](S& s) { s.width = 15; },
           [](S& s) { s.width = 8193; },
           [](S& s) { s.width = 2'000'000'000; },
           [](S& s) { s.width = -5; },
           [](S& s) { s.height = 0; },
           [](S& s) { s.height = 20000; },
           [](S& s) { s.width = 33, s.format = V4l2Format::yuyv; },
           [](S& s) { s.fps = 0.5; },
           [](S& s) { s.fps = -1; },
           [](S& s) { s.fps = std::nan(""); },
           [](S& s) { s.skew_ms = -1; },
           [](S& s) { s.skew_ms = 1001; },
           [](S& s) { s.buffers = 3; },
           [](S& s) { s.buffers = 17; },
       }) {
    EXPECT_EQ(open_with(change), Status::bad_argument) << problem_;
    EXPECT_EQ(left().opened, 0);
  }
  EXPECT_EQ(open(settings()), Status::ok) << problem_;
}

TEST_F(V4l2OpenTest, AnotherFormatOrSizeIsUnsupportedAndSaysWhatThereIs) {
  left().modes = {{.width = 640, .height = 480}, {.width = 1280, .height = 720}, {.fourcc = V4L2_PIX_FMT_YUYV}};
  EXPECT_EQ(open(settings()), Status::unsupported);
  EXPECT_TRUE(says("/dev/video0: no GREY of 64x32, but 640x480 1280x720")) << problem_;
  EXPECT_EQ(open_with([](V4l2Settings& s) { s.format = V4l2Format::mjpg; }), Status::unsupported);
  EXPECT_TRUE(says("no MJPG of 64x32, but GREY YUYV")) << problem_;
  EXPECT_EQ(open_with([](V4l2Settings& s) { s.format = V4l2Format::yuyv; }), Status::ok) << problem_;
  left().modes.clear();
  EXPECT_EQ(open(settings()), Status::unsupported);
  EXPECT_TRUE(says("does not say")) << problem_;
}

TEST_F(V4l2OpenTest, NodesThatAreNoCamera) {
  left().capabilities = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING;  // a webcam's second node
  EXPECT_EQ(open(settings()), Status::unsupported);
  EXPECT_TRUE(says("captures no pictures")) << problem_;
  left().capabilities = V4L2_CAP_VIDEO_CAPTURE;
  EXPECT_EQ(open(settings()), Status::unsupported);
  EXPECT_TRUE(says("does not stream")) << problem_;
  left().errors[VIDIOC_QUERYCAP] = ENOTTY;
  EXPECT_EQ(open(settings()), Status::unsupported);
  EXPECT_TRUE(says("is no camera")) << problem_;
}

TEST_F(V4l2OpenTest, NodesThatAreNotThereOrTaken) {
  EXPECT_EQ(open_with([](V4l2Settings& s) { s.device = "/dev/video9"; }), Status::disconnected);
  EXPECT_TRUE(says("/dev/video9: cannot be opened: No such file")) << problem_;
  left().open_error = EACCES;
  EXPECT_EQ(open(settings()), Status::disconnected);
  EXPECT_TRUE(says("Permission denied")) << problem_;
  left().open_error = 0;
  for (const auto& [request, error, status] :
       std::vector<std::tuple<unsigned long, int, Status>>{{VIDIOC_S_FMT, EBUSY, Status::refused},
                                                           {VIDIOC_REQBUFS, EBUSY, Status::refused},
                                                           {VIDIOC_REQBUFS, EINVAL, Status::unsupported},
                                                           {VIDIOC_QUERYBUF, EINVAL, Status::unsupported},
                                                           {VIDIOC_QBUF, EIO, Status::disconnected},
                                                           {VIDIOC_STREAMON, ENOSPC, Status::refused},
                                                           {VIDIOC_STREAMON, EPIPE, Status::disconnected}}) {
    left().errors = {{request, error}};
    EXPECT_EQ(open(settings()), status) << problem_;
  }
}

TEST_F(V4l2OpenTest, BuffersThatWillNotDo) {
  left().most_buffers = 3;
  EXPECT_EQ(open(settings()), Status::unsupported);
  EXPECT_TRUE(says("too few buffers")) << problem_;
  left().most_buffers = 6;
  EXPECT_EQ(open_with([](V4l2Settings& s) { s.buffers = 12; }), Status::ok);
  EXPECT_EQ(left().requested_buffers, 12U);
  left().small_buffers = 1;
  EXPECT_EQ(open(settings()), Status::bad_data);
  EXPECT_TRUE(says("too small")) << problem_;
  left().small_buffers = 0;
  left().field = V4L2_FIELD_INTERLACED;
  EXPECT_EQ(open(settings()), Status::unsupported);
  EXPECT_TRUE(says("interlaced")) << problem_;
}

TEST_F(V4l2OpenTest, ExposureAndGainAreSetOnBothEyes) {
  V4l2Settings s = two_devices();
  for (test::FakeV4l2Node* node : {&left(), &right()}) {
    node->controls = {{V4L2_CID_EXPOSURE_AUTO, {0, 3, 3}},
                      {V4L2_CID_EXPOSURE_ABSOLUTE, {1, 1000, 5}},
                      {V4L2_CID_AUTOGAIN, {0, 1, 1}},
                      {V4L2_CID_GAIN, {0, 64, 3}}};
  }
  right().extended_controls = false;  // an old driver
  s.exposure_us = 8040;
  s.gain = 17;
  ASSERT_EQ(open(s), Status::ok) << problem_;
  EXPECT_EQ(not_taken_, 0U) << problem_;
  for (test::FakeV4l2Node* node : {&left(), &right()}) {
    EXPECT_EQ(node->controls[V4L2_CID_EXPOSURE_AUTO].value, V4L2_EXPOSURE_MANUAL);
    EXPECT_EQ(node->controls[V4L2_CID_EXPOSURE_ABSOLUTE].value, 80);
    EXPECT_EQ(node->controls[V4L2_CID_AUTOGAIN].value, 0);
    EXPECT_EQ(node->controls[V4L2_CID_GAIN].value, 17);
  }
  s.exposure_us = -1;
  s.gain = -1;
  ASSERT_EQ(open(s), Status::ok);
  for (test::FakeV4l2Node* node : {&left(), &right()}) {
    EXPECT_EQ(node->controls[V4L2_CID_EXPOSURE_AUTO].value, V4L2_EXPOSURE_APERTURE_PRIORITY);
    EXPECT_EQ(node->controls[V4L2_CID_AUTOGAIN].value, 1);
    EXPECT_EQ(node->controls[V4L2_CID_GAIN].value, 17);
  }
}

TEST_F(V4l2OpenTest, TwoDevicesWithLightOfTheirOwnAreCountedAndNamed) {
  V4l2Settings s = two_devices();
  ASSERT_EQ(open(s), Status::ok);
  EXPECT_EQ(not_taken_, 0U) << "nothing automatic there: " << problem_;
  for (test::FakeV4l2Node* node : {&left(), &right()}) {
    node->controls = {{V4L2_CID_EXPOSURE_AUTO, {0, 3, 1}},
                      {V4L2_CID_EXPOSURE_ABSOLUTE, {1, 1000, 5}},
                      {V4L2_CID_AUTOGAIN, {0, 1, 0}},
                      {V4L2_CID_GAIN, {0, 64, 3}}};
  }
  ASSERT_EQ(open(s), Status::ok);
  EXPECT_EQ(not_taken_, 2U);
  EXPECT_TRUE(says("/dev/video0, /dev/video2: automatic gain is each camera's own")) << problem_;
  s.gain = 17;
  ASSERT_EQ(open(s), Status::ok);
  EXPECT_EQ(not_taken_, 1U);
  EXPECT_TRUE(says("automatic exposure")) << problem_;
  s.exposure_us = 5000;
  ASSERT_EQ(open(s), Status::ok);
  EXPECT_EQ(not_taken_, 0U) << problem_;

  // One camera is not asked: its automatics see both eyes.
  left().modes = {{}};
  ASSERT_EQ(open(settings()), Status::ok);
  EXPECT_EQ(not_taken_, 0U) << problem_;
}

TEST_F(V4l2OpenTest, TwoDevicesWithFixedGainsThatDiffer) {
  V4l2Settings s = two_devices();
  left().controls = {{V4L2_CID_GAIN, {0, 64, 3}}};  // no automatic to be switched on
  right().controls = {{V4L2_CID_GAIN, {0, 64, 20}}};
  ASSERT_EQ(open(s), Status::ok);
  EXPECT_EQ(not_taken_, 1U);
  EXPECT_TRUE(says("/dev/video0, /dev/video2: gain is 3 and 20")) << problem_;
  right().controls = {};
  ASSERT_EQ(open(s), Status::ok);
  EXPECT_EQ(not_taken_, 0U) << "nobody knows: " << problem_;
}

TEST_F(V4l2OpenTest, ControlsThatAreNotTakenAreCountedAndNamed) {
  EXPECT_EQ(open_with([](V4l2Settings& s) { s.exposure_us = 5000; }), Status::ok);
  EXPECT_EQ(not_taken_, 1U);
  EXPECT_TRUE(says("/dev/video0: exposure in 100 us cannot be set to 50: Invalid argument")) << problem_;
  left().controls = {{V4L2_CID_GAIN, {0, 10, 3}}};
  EXPECT_EQ(open_with([](V4l2Settings& s) { s.gain = 50; }), Status::ok);
  EXPECT_EQ(not_taken_, 1U);
  EXPECT_TRUE(says("gain became 10 instead of 50")) << problem_;
  EXPECT_EQ(open(settings()), Status::ok);  // automatic, and the camera has no such thing
  EXPECT_EQ(not_taken_, 0U);
}

TEST_F(V4l2OpenTest, FrameRates) {
  left().modes = {{.rates = {15, 60}}};
  EXPECT_EQ(open_with([](V4l2Settings& s) { s.fps = 60; }), Status::ok);
  EXPECT_EQ(not_taken_, 0U);
  EXPECT_EQ(open(settings()), Status::ok);
  EXPECT_EQ(not_taken_, 1U);
  EXPECT_TRUE(says("15 frames a second instead of 30")) << problem_;
  left().sets_rate = false;
  EXPECT_EQ(open(settings()), Status::ok);
  EXPECT_EQ(not_taken_, 1U);
  EXPECT_TRUE(says("frame rate cannot be set")) << problem_;
  EXPECT_EQ(open_with([](V4l2Settings& s) { s.fps = 0; }), Status::ok);
  EXPECT_EQ(not_taken_, 0U);
}

TEST_F(V4l2OpenTest, WhereTheSecondNodeFailsTheFirstIsClosed) {
  const V4l2Settings s = two_devices();
  right().errors[VIDIOC_STREAMON] = ENOSPC;
  EXPECT_EQ(open(s), Status::refused);
  EXPECT_TRUE(says("/dev/video2: does not start: No space left")) << problem_;
  EXPECT_FALSE(left().streaming);
}

}  // namespace
}  // namespace lakshya

// A stereo camera of the kernel's (Video4Linux2): one USB camera whose pictures have both eyes side by side, or two cameras
// whose pictures are paired by their times. Source: Linux kernel, "Video for Linux API".
//
// GREY is not copied: the views point into the driver's buffer, which it gets back with the next capture(). Of YUYV the luma is
// copied out; MJPG is decoded, which allocates (jpeg_grey.h).
//
// Times are the driver's where it stamps with CLOCK_MONOTONIC, the clock that this driver is then to be given; else, and where
// a stamp lies in the future or more than 10 s back, the time at which the frame was fetched.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "hal/camera.h"
#include "hal/camera/eye_check.h"
#include "hal/camera/v4l2_node.h"
#include "hal/retry.h"

namespace lakshya {

struct V4l2Settings {
  std::string device = "/dev/video0";  // better a name that stays: /dev/v4l/by-id/...
  std::string right_device;            // empty: `device` gives both eyes side by side, left half and right half
  V4l2Format format = V4l2Format::yuyv;
  int width = 640;         // px of one eye, 16..8192; side by side and yuyv: even
  int height = 480;        // px, 16..16384
  double fps = 30;         // frames a second, 0 (as the camera is) or 1..1000
  bool swap = false;       // the left half, or `device`, is the right eye
  bool check_eyes = true;  // the first good pairs are looked at, and a wrong order is corrected (eye_check.h)
  double skew_ms = 5;      // two devices: times of a pair differ by at most this, milliseconds, 0..1000
  // The same for both eyes; negative: automatic. Two devices want both fixed: two automatics do not know of each other.
  int exposure_us = -1;  // microseconds, in steps of 100
  int gain = -1;         // the driver's unit
  int buffers = 4;       // 4..16, of each device
};

class V4l2Camera final : public StereoCamera {
 public:
  // `clock` and `calls` outlive the camera.
  V4l2Camera(V4l2Settings settings, Clock& clock, SystemCalls& calls = linux_system_calls());
  ~V4l2Camera() override;
  V4l2Camera(const V4l2Camera&) = delete;
  V4l2Camera& operator=(const V4l2Camera&) = delete;

  // As Device::open(). unsupported: not exactly that format and size (problem() says what there is), or no camera at all;
  // refused: another program has it, or the bus has no room. Frame rate, exposure or gain that are not taken are counted
  // (settings_not_taken) and named by problem(), and the camera is open all the same; so are exposure and gain that two devices
  // do not have in common: automatic in one of them, or not of one value.
  Status open() override;
  void close() override;
  std::span<const Counter> counters() const override;

  int width() const override { return settings_.width; }
  int height() const override { return settings_.height; }

  // As StereoCamera::capture(). A camera that has gone is looked for every 200 ms, by calls of this; they wait until it is time
  // to look. Calls into the kernel's driver while it is set up again may take longer than the deadline, and so may the first
  // pairs, by a look at the eyes each. Two devices that come back may have changed names: their eyes are looked at again.
  Status capture(Nanoseconds deadline, StereoFrame& frame) override;

 private:
  bool two() const { return !settings_.right_device.empty(); }
  int nodes() const { return two() ? 2 : 1; }
  Status check_settings();
  Status open_nodes();
  void close_nodes();
  Status look_again(Nanoseconds deadline);
  Status pair(Nanoseconds deadline);
  Status make_views(StereoFrame& frame);

  const V4l2Settings settings_;
  Clock* clock_;
  V4l2NodeCounters node_counters_;
  Counter unpaired_{"unpaired_frames"};
  Counter damaged_{"damaged_jpegs"};
  Counter decoded_{"decoded_jpegs"};  // each of them may have allocated
  EyeCheck eyes_;
  std::array<V4l2Node, 2> nodes_;
  std::array<V4l2Node::Filled, 2> filled_;
  std::array<std::vector<std::uint8_t>, 2> memory_;  // grey pictures of the formats that are not grey
  bool wanted_ = false;                              // opened, and not closed
  Retry retry_;
  mutable std::array<Counter, 13> shown_{};
};

}  // namespace lakshya

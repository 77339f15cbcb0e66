// What the tests of V4l2Camera share: a fake kernel with two nodes, and frames whose pixels tell which they are.
#pragma once

#include <gtest/gtest.h>

#include <deque>
#include <string>
#include <vector>

#include "hal/camera/v4l2_camera.h"
#include "tests/support/fake_v4l2.h"

namespace lakshya::test {

inline std::uint64_t count_of(const Device& device, const std::string& name) {
  for (const Counter& counter : device.counters()) {
    if (name == counter.name) return counter.value;
  }
  ADD_FAILURE() << "no counter " << name;
  return 0;
}

class V4l2Rig : public testing::Test {
 protected:
  static constexpr int kWidth = 32;  // of one eye
  static constexpr int kHeight = 32;
  static constexpr Nanoseconds kPeriod = 33 * kMillisecond;

  V4l2Rig() { left(); }  // is there; right() where a test asks for it

  FakeV4l2Node& left() { return kernel_.node("/dev/video0"); }
  FakeV4l2Node& right() { return kernel_.node("/dev/video2"); }

  // Side by side unless `right_device` is set.
  V4l2Settings settings() const {
    V4l2Settings s;
    s.format = V4l2Format::grey;
    s.width = kWidth;
    s.height = kHeight;
    s.check_eyes = false;
    return s;
  }
  V4l2Settings two_devices() {
    V4l2Settings s = settings();
    s.right_device = "/dev/video2";
    left().modes = right().modes = {{.width = kWidth, .height = kHeight}};
    return s;
  }

  // A picture of bytes `value` (its left half) and `value` + 100.
  const std::vector<std::uint8_t>* picture(int value, std::size_t line = std::size_t{2} * kWidth) {
    std::vector<std::uint8_t>& bytes = pictures_.emplace_back(line * kHeight);
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = static_cast<std::uint8_t>(i % line < line / 2 ? value : value + 100);
    return &bytes;
  }

  // Frame n of `node` with value n, taken 2 ms before it is there.
  FakeV4l2Frame& add(FakeV4l2Node& node, Nanoseconds after, int value) {
    node.frames.push_back({.time = start_ + after, .bytes = picture(value), .stamped_before = 2 * kMillisecond});
    return node.frames.back();
  }
  void add_many(FakeV4l2Node& node, int count, Nanoseconds first = kPeriod, int value = 1) {
    for (int i = 0; i < count; ++i)
      add(node, first + i * kPeriod, value + i);
  }

  Nanoseconds in_ms(int ms) const { return clock_.now() + ms * kMillisecond; }

  ManualClock time_;
  FakeV4l2 kernel_{time_};
  FakeV4l2Clock clock_{time_, kernel_};
  const Nanoseconds start_ = time_.now();
  StereoFrame frame_;
  std::deque<std::vector<std::uint8_t>> pictures_;
};

}  // namespace lakshya::test

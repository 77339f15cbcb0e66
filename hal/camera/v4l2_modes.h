// What a Video4Linux2 node says that it can do, one question at a time; nothing is allocated. Source: Linux kernel, "Video for
// Linux API", VIDIOC_ENUM_FMT, VIDIOC_ENUM_FRAMESIZES, VIDIOC_ENUM_FRAMEINTERVALS.
#pragma once

#include <array>
#include <cstdint>

#include "hal/linux/system_calls.h"

namespace lakshya {

inline constexpr int kMostV4l2Answers = 128;  // of one kind: nobody asks further

// "YUYV"; what cannot be printed becomes '?'.
std::array<char, 5> fourcc_text(std::uint32_t fourcc);

// Zeroed, asked, and true where the driver answered.
template <class Question>
bool answers(SystemCalls& calls, int fd, unsigned long request, Question& question) {
  return calls.ioctl(fd, request, &question) >= 0;
}

// Capture formats, from n = 0; false when there are no more.
bool nth_format(SystemCalls& calls, int fd, int n, std::uint32_t& fourcc);

struct V4l2Sizes {
  int least_width = 0;  // one size: least = most
  int least_height = 0;
  int most_width = 0;
  int most_height = 0;
};
bool nth_sizes(SystemCalls& calls, int fd, std::uint32_t fourcc, int n, V4l2Sizes& sizes);

// Frames per second; a range has two answers, its fastest and its slowest.
bool nth_rate(SystemCalls& calls, int fd, std::uint32_t fourcc, int width, int height, int n, double& fps);

}  // namespace lakshya

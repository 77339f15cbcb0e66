#include "hal/camera/v4l2_modes.h"

#include <linux/videodev2.h>

namespace lakshya {
namespace {

double rate_of(const v4l2_fract& interval) {
  return interval.numerator == 0 ? 0 : static_cast<double>(interval.denominator) / interval.numerator;
}

}  // namespace

std::array<char, 5> fourcc_text(std::uint32_t fourcc) {
  std::array<char, 5> text{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto c = static_cast<char>(fourcc >> (8 * i) & 0x7F);
    text[i] = c >= ' ' && c <= '~' ? c : '?';
  }
  return text;
}

bool nth_format(SystemCalls& calls, int fd, int n, std::uint32_t& fourcc) {
  v4l2_fmtdesc format{};
  format.index = static_cast<std::uint32_t>(n);
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (n >= kMostV4l2Answers || !answers(calls, fd, VIDIOC_ENUM_FMT, format)) return false;
  fourcc = format.pixelformat;
  return true;
}

bool nth_sizes(SystemCalls& calls, int fd, std::uint32_t fourcc, int n, V4l2Sizes& sizes) {
  v4l2_frmsizeenum size{};
  size.index = static_cast<std::uint32_t>(n);
  size.pixel_format = fourcc;
  if (n >= kMostV4l2Answers || !answers(calls, fd, VIDIOC_ENUM_FRAMESIZES, size)) return false;
  if (size.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
    const auto width = static_cast<int>(size.discrete.width);
    const auto height = static_cast<int>(size.discrete.height);
    sizes = {width, height, width, height};
    return true;
  }
  if (n > 0) return false;  // a range has one answer
  sizes = {static_cast<int>(size.stepwise.min_width), static_cast<int>(size.stepwise.min_height),
           static_cast<int>(size.stepwise.max_width), static_cast<int>(size.stepwise.max_height)};
  return true;
}

bool nth_rate(SystemCalls& calls, int fd, std::uint32_t fourcc, int width, int height, int n, double& fps) {
  v4l2_frmivalenum interval{};
  interval.index = static_cast<std::uint32_t>(n);
  interval.pixel_format = fourcc;
  interval.width = static_cast<std::uint32_t>(width);
  interval.height = static_cast<std::uint32_t>(height);
  if (n >= kMostV4l2Answers) return false;
  if (answers(calls, fd, VIDIOC_ENUM_FRAMEINTERVALS, interval) && interval.type == V4L2_FRMIVAL_TYPE_DISCRETE) {
    fps = rate_of(interval.discrete);
    return true;
  }
  interval.index = 0;
  if (n > 1 || !answers(calls, fd, VIDIOC_ENUM_FRAMEINTERVALS, interval)) return false;
  if (interval.type == V4L2_FRMIVAL_TYPE_DISCRETE) return false;
  fps = rate_of(n == 0 ? interval.stepwise.min : interval.stepwise.max);
  return true;
}

}  // namespace lakshya

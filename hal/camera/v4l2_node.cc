#include "hal/camera/v4l2_node.h"

#include <fcntl.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "hal/camera/v4l2_modes.h"

namespace lakshya {
namespace {

constexpr int kMostFailures = 8;
constexpr int kMostFalseAlarms = 3;
constexpr Nanoseconds kOldest = 10 * kSecond;               // a stamp before that is of another clock
constexpr Nanoseconds kUnknownPeriod = 100 * kMillisecond;  // where the driver does not say its frame rate

std::uint32_t fourcc_of(V4l2Format format) {
  if (format == V4l2Format::yuyv) return V4L2_PIX_FMT_YUYV;
  return format == V4l2Format::mjpg ? V4L2_PIX_FMT_MJPEG : V4L2_PIX_FMT_GREY;
}

v4l2_buffer buffer_of(int index) {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = static_cast<std::uint32_t>(index);
  return buffer;
}

Status status_of(int error) {
  switch (error) {
    case EBUSY:
    case ENOMEM:
    case ENOSPC:  // no bandwidth on the bus
      return Status::refused;
    case ENOTTY:
    case EINVAL:
      return Status::unsupported;
    default:
      return Status::disconnected;
  }
}

}  // namespace

V4l2Node::V4l2Node(V4l2NodeSettings settings, SystemCalls& calls, Clock& clock, V4l2NodeCounters& counters,
                   Problem& problem)
    : settings_(std::move(settings)), calls_(&calls), clock_(&clock), counters_(&counters), problem_(&problem) {}

// ---- open and close

Status V4l2Node::fail(Status status, int error, const char* doing) {
  problem_->set("%s: %s%s%s", path(), doing, error != 0 ? ": " : "", error != 0 ? strerrordesc_np(error) : "");
  close();
  return status;
}

Status V4l2Node::fail(int error, const char* doing) {
  return fail(status_of(error), error, doing);
}

Status V4l2Node::open() {
  close();
  fd_ = calls_->open(path(), O_RDWR);
  if (fd_ < 0) return fail(-fd_, "cannot be opened");
  v4l2_capability has{};
  const int asked = calls_->ioctl(fd_, VIDIOC_QUERYCAP, &has);
  if (asked < 0) return fail(-asked, "is no camera");
  const std::uint32_t can = (has.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? has.device_caps : has.capabilities;
  if ((can & V4L2_CAP_VIDEO_CAPTURE) == 0) return fail(Status::unsupported, 0, "captures no pictures");
  if ((can & V4L2_CAP_STREAMING) == 0) return fail(Status::unsupported, 0, "does not stream");

  Status status = set_format();
  if (status != Status::ok) return status;
  const int not_taken = set_controls(*calls_, fd_, path(), settings_.controls, fps_, *problem_);
  counters_->not_taken.value += static_cast<std::uint64_t>(not_taken);
  status = map_buffers();
  if (status != Status::ok) return status;
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  const int started = calls_->ioctl(fd_, VIDIOC_STREAMON, &type);
  if (started < 0) return fail(-started, "does not start");
  streaming_ = true;
  numbered_ = false;
  failures_ = 0;
  false_alarms_ = 0;
  return Status::ok;
}

Status V4l2Node::set_format() {
  const std::uint32_t wanted = fourcc_of(settings_.format);
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  v4l2_pix_format& pixels = format.fmt.pix;
  pixels.width = static_cast<std::uint32_t>(settings_.width);
  pixels.height = static_cast<std::uint32_t>(settings_.height);
  pixels.pixelformat = wanted;
  pixels.field = V4L2_FIELD_NONE;
  const int set = calls_->ioctl(fd_, VIDIOC_S_FMT, &format);
  if (set == -EINVAL) return refuse_format(wanted);
  if (set < 0) return fail(-set, "takes no format");
  if (pixels.pixelformat != wanted || pixels.width != static_cast<std::uint32_t>(settings_.width) ||
      pixels.height != static_cast<std::uint32_t>(settings_.height)) {
    return refuse_format(wanted);
  }
  if (pixels.field != V4L2_FIELD_NONE) return fail(Status::unsupported, 0, "gives interlaced pictures");
  picture_ = {settings_.format, settings_.width, settings_.height, pixels.bytesperline};
  const auto least = static_cast<std::size_t>(settings_.width) * (settings_.format == V4l2Format::yuyv ? 2 : 1);
  if (picture_.bytes_per_line == 0) picture_.bytes_per_line = least;  // some drivers leave it open
  if (!is_possible(picture_)) return fail(Status::bad_data, 0, "states impossible bytes per line");
  return Status::ok;
}

// Names what there is: the sizes of this format, or else the formats.
Status V4l2Node::refuse_format(std::uint32_t wanted) {
  std::array<char, 96> offers{};
  std::size_t length = 0;
  const auto add = [&](int printed) {
    length = std::min(length + static_cast<std::size_t>(std::max(printed, 0)), offers.size() - 1);
  };
  V4l2Sizes sizes;
  for (int n = 0; nth_sizes(*calls_, fd_, wanted, n, sizes); ++n) {
    const char* const form = sizes.least_width == sizes.most_width ? " %dx%d" : " up to %dx%d";
    add(std::snprintf(offers.data() + length, offers.size() - length, form, sizes.most_width, sizes.most_height));
  }
  std::uint32_t fourcc = 0;
  for (int n = 0; sizes.most_width == 0 && nth_format(*calls_, fd_, n, fourcc); ++n)
    add(std::snprintf(offers.data() + length, offers.size() - length, " %s", fourcc_text(fourcc).data()));
  problem_->set("%s: no %s of %dx%d, but%s", path(), fourcc_text(wanted).data(), settings_.width, settings_.height,
                length > 0 ? offers.data() : " does not say what");
  close();
  return Status::unsupported;
}

Status V4l2Node::map_buffers() {
  v4l2_requestbuffers request{};
  request.count = static_cast<std::uint32_t>(settings_.buffers);
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  const int given = calls_->ioctl(fd_, VIDIOC_REQBUFS, &request);
  if (given < 0) return fail(-given, "gives no buffers");
  if (request.count < kLeastV4l2Buffers) return fail(Status::unsupported, 0, "gives too few buffers");
  const int count = static_cast<int>(std::min<std::uint32_t>(request.count, kMostV4l2Buffers));
  for (int i = 0; i < count; ++i) {
    v4l2_buffer buffer = buffer_of(i);
    const int found = calls_->ioctl(fd_, VIDIOC_QUERYBUF, &buffer);
    if (found < 0) return fail(-found, "does not say where a buffer lies");
    if (buffer.length < std::max<std::size_t>(picture_bytes(picture_), 1)) {
      return fail(Status::bad_data, 0, "has buffers too small for a picture");
    }
    void* const memory = calls_->mmap(fd_, buffer.length, buffer.m.offset);
    if (memory == nullptr) return fail(Status::refused, 0, "does not let a buffer be mapped");
    mapped_[static_cast<std::size_t>(i)] = {static_cast<std::uint8_t*>(memory), buffer.length};
    buffers_ = i + 1;
    if (!give_back(i)) return fail(EIO, "does not take a buffer");
  }
  return Status::ok;
}

void V4l2Node::close() {
  if (fd_ < 0) return;
  // Errors here change nothing that anybody could do.
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (streaming_) (void)calls_->ioctl(fd_, VIDIOC_STREAMOFF, &type);
  for (Mapped& buffer : mapped_) {
    if (buffer.memory != nullptr) calls_->munmap(buffer.memory, buffer.size);
    buffer = {};
  }
  (void)calls_->close(fd_);
  fd_ = -1;
  buffers_ = 0;
  held_ = -1;
  streaming_ = false;
}

// ---- frames

Status V4l2Node::gone(int error) {
  ++counters_->disconnections.value;
  return fail(Status::disconnected, error, "gone");
}

bool V4l2Node::give_back(int index) {
  v4l2_buffer buffer = buffer_of(index);
  return calls_->ioctl(fd_, VIDIOC_QBUF, &buffer) >= 0;
}

// Takes everything that waits; held_ is the newest good one, or stays what it was. bad_data: something bad was there, and
// nothing good. Ends: what is given back here lies behind all that waits, and no more is asked for than there are buffers.
Status V4l2Node::drain(int& taken) {
  Status status = Status::ok;
  taken = 0;
  for (int i = 0; i < buffers_; ++i) {
    v4l2_buffer buffer = buffer_of(0);
    const int error = -calls_->ioctl(fd_, VIDIOC_DQBUF, &buffer);
    if (error == EAGAIN) break;
    if (error == EIO && ++failures_ < kMostFailures) {
      ++counters_->io_errors.value;
      problem_->set("%s: %s", path(), strerrordesc_np(EIO));
      return held_ >= 0 ? Status::ok : Status::bad_data;
    }
    if (error > 0) return gone(error);
    failures_ = 0;
    false_alarms_ = 0;
    ++taken;
    const Status took = take(buffer);
    if (took == Status::disconnected) return took;
    if (took != Status::ok) status = took;
  }
  return held_ >= 0 ? Status::ok : status;
}

Status V4l2Node::take(const v4l2_buffer& buffer) {
  if (buffer.index >= static_cast<std::uint32_t>(buffers_)) return gone(EPROTO);
  const auto index = static_cast<int>(buffer.index);
  const Mapped& mapped = mapped_[buffer.index];
  const std::uint32_t step = numbered_ ? buffer.sequence - last_number_ : 1;
  // A number that steps back is a driver's, not a gap of four thousand million.
  const bool forward = step >= 1 && step < (1U << 31);
  if (forward) counters_->lost.value += step - 1;
  frame_.sequence += forward ? step : 1;
  last_number_ = buffer.sequence;
  numbered_ = true;

  const bool torn = (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0;
  const std::size_t used = std::min<std::size_t>(buffer.bytesused, mapped.size);
  if (torn || used < std::max<std::size_t>(picture_bytes(picture_), 1)) {
    ++(torn ? counters_->torn : counters_->small).value;
    problem_->set("%s: a %s frame: %u bytes", path(), torn ? "torn" : "short", buffer.bytesused);
    return give_back(index) ? Status::bad_data : gone(ENODEV);
  }
  if (held_ >= 0) {
    ++counters_->dropped.value;
    if (!give_back(held_)) return gone(ENODEV);
  }
  held_ = index;
  frame_.used = {mapped.memory, used};

  const Nanoseconds now = clock_->now();
  const Nanoseconds stamp =
      Nanoseconds{buffer.timestamp.tv_sec} * kSecond + Nanoseconds{buffer.timestamp.tv_usec} * 1000;
  const bool usable = (buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC &&
                      stamp <= now && stamp >= now - kOldest;
  if (!usable) ++counters_->unstamped.value;
  frame_.time = usable ? stamp : now;
  return Status::ok;
}

// A descriptor that is always ready must not keep the processor busy until the deadline.
Status V4l2Node::wait(Nanoseconds deadline) {
  if (false_alarms_ > kMostFalseAlarms) {
    clock_->sleep_until(std::min(deadline, clock_->now() + kMillisecond));
    if (clock_->now() >= deadline) return Status::timeout;
  }
  const Status status = clock_->wait_for(fd_, Ready::to_read, deadline);
  if (status == Status::ok) ++false_alarms_;
  return status;
}

Status V4l2Node::newest(Nanoseconds deadline, Filled& frame) {
  if (fd_ < 0) return Status::disconnected;
  const int last = std::exchange(held_, -1);
  if (last >= 0 && !give_back(last)) return gone(ENODEV);
  // One buffer was the caller's until now.
  const int all = buffers_ - (last >= 0 ? 1 : 0);
  int taken = 0;
  Status status = drain(taken);
  if (status == Status::ok && taken >= all) {
    const auto period = fps_ > 0 ? static_cast<Nanoseconds>(static_cast<double>(kSecond) / fps_) : kUnknownPeriod;
    if (wait(std::min(deadline, clock_->now() + 2 * period)) == Status::ok) status = drain(taken);
  }
  while (status == Status::ok && held_ < 0) {
    status = wait(deadline);
    if (status == Status::ok) status = drain(taken);
    if (status == Status::ok && held_ < 0 && clock_->now() >= deadline) status = Status::timeout;
  }
  if (status == Status::ok) frame = frame_;
  return status;
}

}  // namespace lakshya

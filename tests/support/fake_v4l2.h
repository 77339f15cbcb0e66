// Video4Linux2 without a kernel: nodes with formats, controls and buffers that fill at times of a ManualClock, and what can go
// wrong with them. Nothing is allocated while a node streams.
#pragma once

#include <linux/videodev2.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "hal/linux/system_calls.h"
#include "tests/support/manual_clock.h"

namespace lakshya::test {

struct FakeV4l2Mode {
  std::uint32_t fourcc = V4L2_PIX_FMT_GREY;
  int width = 64;
  int height = 32;
  std::vector<int> rates = {30};
};

struct FakeV4l2Frame {
  Nanoseconds time = 0;  // when it is there
  const std::vector<std::uint8_t>* bytes = nullptr;
  std::uint32_t flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  Nanoseconds stamped_before = 0;  // its stamp is so much earlier than `time`
  std::size_t used = SIZE_MAX;     // at most; the rest is missing
  std::uint32_t gap = 0;           // so many frames before it are lost
};

struct FakeV4l2Control {
  int least = 0;
  int most = 0;
  int value = 0;
};

struct FakeV4l2Node {
  // What it is.
  std::string card = "Fake Camera";
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::vector<FakeV4l2Mode> modes = {{}};
  std::map<std::uint32_t, FakeV4l2Control> controls;
  bool extended_controls = true;
  bool sets_rate = true;
  std::uint32_t line_padding = 0;
  std::uint32_t most_buffers = 32;
  std::uint32_t field = V4L2_FIELD_NONE;
  std::vector<FakeV4l2Frame> frames;  // in order of time

  // What is wrong with it.
  Nanoseconds unplugged_at = INT64_MAX;
  Nanoseconds plugged_at = INT64_MAX;  // again
  int open_error = 0;
  std::map<unsigned long, int> errors;  // request -> errno, for good
  int io_errors = 0;                    // so many VIDIOC_DQBUF fail with EIO
  bool false_alarm = false;             // always ready
  std::uint32_t wrong_index = 0;        // added to a buffer's index
  std::uint32_t small_buffers = 0;      // bytes less than the picture

  // What happened to it.
  int opened = 0;
  int closed = 0;
  int mapped = 0;
  bool streaming = false;
  std::uint32_t requested_buffers = 0;
};

class FakeV4l2 final : public SystemCalls {
 public:
  explicit FakeV4l2(ManualClock& clock) : clock_(&clock) {}

  // The same node as long as this lives.
  FakeV4l2Node& node(const std::string& path) { return nodes_[path].node; }

  int open(const char* path, int /*flags*/) override {
    const auto found = nodes_.find(std::string_view(path));
    if (found == nodes_.end() || !plugged(found->second.node)) return -ENOENT;
    if (found->second.node.open_error != 0) return -found->second.node.open_error;
    State& state = found->second;
    if (state.fd >= 0) return -EBUSY;
    state.fd = next_fd_++;
    ++state.node.opened;
    return state.fd;
  }

  int close(int fd) override {
    State* const state = of(fd);
    if (state == nullptr) return -EBADF;
    ++state->node.closed;
    state->fd = -1;
    state->node.streaming = false;
    return 0;
  }

  void* mmap(int fd, std::size_t bytes, std::int64_t offset) override {
    State* const state = of(fd);
    const auto index = static_cast<std::size_t>(offset / kOffsetStep);
    if (state == nullptr || index >= state->buffers || bytes != state->memory[index].size()) return nullptr;
    ++state->node.mapped;
    return state->memory[index].data();
  }

  void munmap(void* memory, std::size_t /*bytes*/) override {
    for (auto& [path, state] : nodes_) {
      for (const auto& buffer : state.memory) {
        if (buffer.data() == memory) --state.node.mapped;
      }
    }
  }

  long read_at_start(int, std::span<char>) override { return -EINVAL; }
  long write_at_start(int, std::span<const char>) override { return -EINVAL; }

  int ioctl(int fd, unsigned long request, void* argument) override;

  // For a clock: is there something to take (or an error to see) now, and else when.
  bool ready(int fd) {
    State* const state = of(fd);
    if (state == nullptr) return true;
    deliver(*state);
    return state->done > 0 || state->node.false_alarm || state->node.io_errors > 0 || !plugged(state->node);
  }
  Nanoseconds next_event(int fd) {
    const State* const state = of(fd);
    if (state == nullptr) return clock_->now();
    Nanoseconds next = INT64_MAX;
    if (state->next_frame < state->node.frames.size()) next = state->node.frames[state->next_frame].time;
    if (state->node.unplugged_at > clock_->now()) next = std::min(next, state->node.unplugged_at);
    return next;
  }

 private:
  static constexpr std::int64_t kOffsetStep = 1 << 24;
  static constexpr std::size_t kMost = 32;

  struct Slot {
    std::size_t index = 0;
    std::uint32_t used = 0;
    std::uint32_t flags = 0;
    std::uint32_t sequence = 0;
    Nanoseconds stamp = 0;
  };
  struct State {
    FakeV4l2Node node;
    int fd = -1;
    v4l2_pix_format format{};
    std::size_t buffers = 0;
    std::array<std::vector<std::uint8_t>, kMost> memory;
    std::array<std::size_t, kMost> queue{};  // of empty ones, in order
    std::size_t queued = 0;
    std::array<Slot, kMost> filled{};  // in order
    std::size_t done = 0;
    std::size_t next_frame = 0;
    std::uint32_t sequence = 0;
  };

  bool plugged(const FakeV4l2Node& node) const {
    return clock_->now() < node.unplugged_at || clock_->now() >= node.plugged_at;
  }

  State* of(int fd) {
    for (auto& [path, state] : nodes_) {
      if (fd >= 0 && state.fd == fd) return &state;
    }
    return nullptr;
  }

  void deliver(State& state) {
    for (; state.next_frame < state.node.frames.size(); ++state.next_frame) {
      const FakeV4l2Frame& frame = state.node.frames[state.next_frame];
      if (frame.time > clock_->now()) return;
      if (!state.node.streaming) continue;
      state.sequence += frame.gap;
      const std::uint32_t sequence = state.sequence++;
      if (state.queued == 0) continue;  // nowhere to put it
      Slot& slot = state.filled[state.done++];
      slot.index = state.queue[0];
      std::copy(state.queue.begin() + 1, state.queue.end(), state.queue.begin());
      --state.queued;
      std::vector<std::uint8_t>& memory = state.memory[slot.index];
      const std::size_t used = std::min({frame.used, frame.bytes->size(), memory.size()});
      std::copy_n(frame.bytes->begin(), used, memory.begin());
      slot.used = static_cast<std::uint32_t>(used);
      slot.flags = frame.flags;
      slot.sequence = sequence;
      slot.stamp = frame.time - frame.stamped_before;
    }
  }

  int capability(const State& state, v4l2_capability& answer) const;
  int set_format(State& state, v4l2_format& format) const;
  int set_rate(State& state, v4l2_streamparm& parameters) const;
  int set_control(State& state, std::uint32_t id, int& value) const;
  int request_buffers(State& state, v4l2_requestbuffers& request) const;
  int take(State& state, v4l2_buffer& buffer);
  static int enumerate(const FakeV4l2Node& node, unsigned long request, void* argument);

  ManualClock* clock_;
  std::map<std::string, State, std::less<>> nodes_;
  int next_fd_ = 100;
};

inline int FakeV4l2::capability(const State& state, v4l2_capability& answer) const {
  answer.capabilities =
      V4L2_CAP_DEVICE_CAPS | V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;  // of all its nodes together
  answer.device_caps = state.node.capabilities;
  const std::size_t length = std::min(state.node.card.size(), sizeof answer.card - 1);
  std::copy_n(state.node.card.begin(), length, answer.card);
  return 0;
}

// As drivers do it: the asked format if there is one of it, the first else; the size that is nearest in width.
inline int FakeV4l2::set_format(State& state, v4l2_format& format) const {
  const FakeV4l2Mode* best = nullptr;
  const auto worse = [&](const FakeV4l2Mode& mode) {
    const bool other = mode.fourcc != format.fmt.pix.pixelformat;
    return (other ? 1 << 20 : 0) + std::abs(mode.width - static_cast<int>(format.fmt.pix.width)) +
           std::abs(mode.height - static_cast<int>(format.fmt.pix.height));
  };
  for (const FakeV4l2Mode& mode : state.node.modes) {
    if (best == nullptr || worse(mode) < worse(*best)) best = &mode;
  }
  if (best == nullptr) return -EINVAL;
  v4l2_pix_format& pixels = format.fmt.pix;
  pixels.width = static_cast<std::uint32_t>(best->width);
  pixels.height = static_cast<std::uint32_t>(best->height);
  pixels.pixelformat = best->fourcc;
  pixels.field = state.node.field;
  const std::uint32_t line = pixels.width * (best->fourcc == V4L2_PIX_FMT_YUYV ? 2 : 1) + state.node.line_padding;
  pixels.bytesperline = best->fourcc == V4L2_PIX_FMT_MJPEG ? 0 : line;
  pixels.sizeimage = line * pixels.height * (best->fourcc == V4L2_PIX_FMT_MJPEG ? 2 : 1) + 4096;
  if (state.node.small_buffers > 0) pixels.sizeimage = line * pixels.height - state.node.small_buffers;
  state.format = pixels;
  return 0;
}

inline int FakeV4l2::set_rate(State& state, v4l2_streamparm& parameters) const {
  if (!state.node.sets_rate) return -ENOTTY;
  v4l2_fract& interval = parameters.parm.capture.timeperframe;
  const int rate = state.node.modes.front().rates.front();
  for (const int each : state.node.modes.front().rates) {
    if (interval.numerator != 0 && static_cast<double>(interval.denominator) / interval.numerator == each) return 0;
  }
  interval = {1, static_cast<std::uint32_t>(rate)};
  return 0;
}

inline int FakeV4l2::set_control(State& state, std::uint32_t id, int& value) const {
  const auto found = state.node.controls.find(id);
  if (found == state.node.controls.end()) return -EINVAL;
  FakeV4l2Control& control = found->second;
  value = std::clamp(value, control.least, control.most);
  control.value = value;
  return 0;
}

inline int FakeV4l2::request_buffers(State& state, v4l2_requestbuffers& request) const {
  state.node.requested_buffers = request.count;
  request.count = std::min(request.count, state.node.most_buffers);
  state.buffers = request.count;
  state.queued = 0;
  state.done = 0;
  for (std::size_t i = 0; i < state.buffers; ++i)
    state.memory[i].resize(state.format.sizeimage);
  return 0;
}

inline int FakeV4l2::take(State& state, v4l2_buffer& buffer) {
  if (state.node.io_errors > 0) {
    --state.node.io_errors;
    return -EIO;
  }
  deliver(state);
  if (state.done == 0) return -EAGAIN;
  const Slot slot = state.filled[0];
  std::copy(state.filled.begin() + 1, state.filled.end(), state.filled.begin());
  --state.done;
  buffer.index = static_cast<std::uint32_t>(slot.index) + state.node.wrong_index;
  buffer.bytesused = slot.used;
  buffer.flags = slot.flags;
  buffer.sequence = slot.sequence;
  buffer.timestamp.tv_sec = slot.stamp / kSecond;
  buffer.timestamp.tv_usec = slot.stamp % kSecond / 1000;
  return 0;
}

inline int FakeV4l2::enumerate(const FakeV4l2Node& node, unsigned long request, void* argument) {
  // Each format once, and each of its sizes.
  std::uint32_t index = 0;
  for (std::size_t i = 0; i < node.modes.size(); ++i) {
    const FakeV4l2Mode& mode = node.modes[i];
    if (request == VIDIOC_ENUM_FMT) {
      bool seen = false;
      for (std::size_t j = 0; j < i; ++j)
        seen = seen || node.modes[j].fourcc == mode.fourcc;
      auto& answer = *static_cast<v4l2_fmtdesc*>(argument);
      if (seen || index++ != answer.index) continue;
      answer.pixelformat = mode.fourcc;
      return 0;
    }
    if (request == VIDIOC_ENUM_FRAMESIZES) {
      auto& answer = *static_cast<v4l2_frmsizeenum*>(argument);
      if (mode.fourcc != answer.pixel_format || index++ != answer.index) continue;
      answer.type = V4L2_FRMSIZE_TYPE_DISCRETE;
      answer.discrete = {static_cast<std::uint32_t>(mode.width), static_cast<std::uint32_t>(mode.height)};
      return 0;
    }
    auto& answer = *static_cast<v4l2_frmivalenum*>(argument);
    if (mode.fourcc != answer.pixel_format || static_cast<std::uint32_t>(mode.width) != answer.width ||
        static_cast<std::uint32_t>(mode.height) != answer.height || answer.index >= mode.rates.size()) {
      continue;
    }
    answer.type = V4L2_FRMIVAL_TYPE_DISCRETE;
    answer.discrete = {1, static_cast<std::uint32_t>(mode.rates[answer.index])};
    return 0;
  }
  return -EINVAL;
}

inline int FakeV4l2::ioctl(int fd, unsigned long request, void* argument) {
  State* const state = of(fd);
  if (state == nullptr) return -EBADF;
  if (!plugged(state->node)) return -ENODEV;
  if (const auto error = state->node.errors.find(request); error != state->node.errors.end()) return -error->second;
  switch (request) {
    case VIDIOC_QUERYCAP:
      return capability(*state, *static_cast<v4l2_capability*>(argument));
    case VIDIOC_S_FMT:
      return set_format(*state, *static_cast<v4l2_format*>(argument));
    case VIDIOC_G_PARM:
      return state->node.sets_rate ? 0 : -ENOTTY;
    case VIDIOC_S_PARM:
      return set_rate(*state, *static_cast<v4l2_streamparm*>(argument));
    case VIDIOC_G_CTRL: {
      auto& control = *static_cast<v4l2_control*>(argument);
      const auto found = state->node.controls.find(control.id);
      if (found == state->node.controls.end()) return -EINVAL;
      control.value = found->second.value;
      return 0;
    }
    case VIDIOC_S_CTRL: {
      auto& control = *static_cast<v4l2_control*>(argument);
      int value = control.value;
      const int error = set_control(*state, control.id, value);
      control.value = value;
      return error;
    }
    case VIDIOC_S_EXT_CTRLS: {
      if (!state->node.extended_controls) return -ENOTTY;
      v4l2_ext_control& control = *static_cast<v4l2_ext_controls*>(argument)->controls;
      int value = control.value;
      const int error = set_control(*state, control.id, value);
      control.value = value;
      return error;
    }
    case VIDIOC_REQBUFS:
      return request_buffers(*state, *static_cast<v4l2_requestbuffers*>(argument));
    case VIDIOC_QUERYBUF: {
      auto& buffer = *static_cast<v4l2_buffer*>(argument);
      if (buffer.index >= state->buffers) return -EINVAL;
      buffer.length = static_cast<std::uint32_t>(state->memory[buffer.index].size());
      buffer.m.offset = static_cast<std::uint32_t>(buffer.index * kOffsetStep);
      return 0;
    }
    case VIDIOC_QBUF: {
      const auto index = static_cast<std::size_t>(static_cast<v4l2_buffer*>(argument)->index);
      const auto begin = state->queue.begin();
      if (index >= state->buffers ||
          std::count(begin, begin + static_cast<std::ptrdiff_t>(state->queued), index) > 0) {
        return -EINVAL;
      }
      deliver(*state);  // what came before had no room here
      state->queue[state->queued++] = index;
      return 0;
    }
    case VIDIOC_DQBUF:
      return take(*state, *static_cast<v4l2_buffer*>(argument));
    case VIDIOC_STREAMON:
      state->node.streaming = true;
      state->sequence = 0;
      while (state->next_frame < state->node.frames.size() &&
             state->node.frames[state->next_frame].time <= clock_->now())
        ++state->next_frame;
      return 0;
    case VIDIOC_STREAMOFF:
      state->node.streaming = false;
      return 0;
    default:
      return enumerate(state->node, request, argument);
  }
}

// A clock that stands still until somebody waits, and then goes to the next frame or the deadline.
class FakeV4l2Clock final : public Clock {
 public:
  FakeV4l2Clock(ManualClock& clock, FakeV4l2& kernel) : clock_(&clock), kernel_(&kernel) {}
  Nanoseconds now() const override { return clock_->now(); }
  void sleep_until(Nanoseconds deadline) override { clock_->sleep_until(deadline); }
  Status wait_for(int fd, Ready /*what*/, Nanoseconds deadline) override {
    ++waits;
    while (!kernel_->ready(fd)) {
      const Nanoseconds next = kernel_->next_event(fd);
      if (next > deadline) {
        clock_->sleep_until(deadline);
        return Status::timeout;
      }
      clock_->sleep_until(next);
    }
    return Status::ok;
  }
  int waits = 0;

 private:
  ManualClock* clock_;
  FakeV4l2* kernel_;
};

}  // namespace lakshya::test

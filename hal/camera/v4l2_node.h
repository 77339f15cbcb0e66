// One capture node of Video4Linux2, streaming into mapped buffers. Part of V4l2Camera, which has the counters and the problem.
// Source: Linux kernel, "Video for Linux API", Streaming I/O (Memory Mapping), VIDIOC_QBUF and VIDIOC_DQBUF.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "hal/camera/v4l2_controls.h"
#include "hal/camera/v4l2_frame.h"
#include "hal/clock.h"
#include "hal/device.h"
#include "hal/linux/system_calls.h"

struct v4l2_buffer;

namespace lakshya {

inline constexpr int kLeastV4l2Buffers = 4;
inline constexpr int kMostV4l2Buffers = 16;

struct V4l2NodeSettings {
  std::string path;
  V4l2Format format = V4l2Format::grey;
  int width = 0;  // px, of the whole picture
  int height = 0;
  V4l2Controls controls;
  int buffers = kLeastV4l2Buffers;
};

struct V4l2NodeCounters {
  Counter disconnections{"disconnections"};
  Counter dropped{"dropped_frames"};  // older than the newest, or without a partner
  Counter lost{"lost_frames"};        // gaps in the driver's numbers
  Counter torn{"torn_frames"};        // the driver says that data is missing
  Counter small{"short_frames"};      // fewer bytes than the picture has
  Counter io_errors{"io_errors"};
  Counter unstamped{"unstamped_frames"};  // the driver's time cannot be used: that of its arrival instead
  Counter not_taken{"settings_not_taken"};
};

class V4l2Node {
 public:
  struct Filled {
    std::span<const std::uint8_t> used;
    Nanoseconds time = 0;
    std::uint64_t sequence = 0;  // counts on over a disconnection
  };

  // All references outlive the node.
  V4l2Node(V4l2NodeSettings settings, SystemCalls& calls, Clock& clock, V4l2NodeCounters& counters,
           Problem& problem);
  ~V4l2Node() { close(); }
  V4l2Node(const V4l2Node&) = delete;
  V4l2Node& operator=(const V4l2Node&) = delete;

  // Statuses as Device::open(). Nothing is allocated.
  Status open();
  void close();
  bool is_open() const { return fd_ >= 0; }
  const V4l2Picture& picture() const { return picture_; }
  const char* path() const { return settings_.path.c_str(); }
  V4l2Light light() const { return read_light(*calls_, fd_); }

  // Gives back the last frame, then the newest good one that waits, or the first to come until `deadline`. Where all buffers
  // were full, the camera had none to fill for a while and what waits is old: then a fresh one is waited for, two frame
  // times at most. timeout, bad_data (only torn or short ones came, or the driver failed once), disconnected (and closed).
  Status newest(Nanoseconds deadline, Filled& frame);

 private:
  struct Mapped {
    std::uint8_t* memory = nullptr;
    std::size_t size = 0;
  };

  Status fail(Status status, int error, const char* doing);
  Status fail(int error, const char* doing);
  Status gone(int error);
  Status set_format();
  Status refuse_format(std::uint32_t wanted);
  Status map_buffers();
  bool give_back(int index);
  Status drain(int& taken);
  Status take(const v4l2_buffer& buffer);
  Status wait(Nanoseconds deadline);

  const V4l2NodeSettings settings_;
  SystemCalls* calls_;
  Clock* clock_;
  V4l2NodeCounters* counters_;
  Problem* problem_;

  int fd_ = -1;
  V4l2Picture picture_;
  double fps_ = 0;
  std::array<Mapped, kMostV4l2Buffers> mapped_{};
  int buffers_ = 0;
  bool streaming_ = false;
  int held_ = -1;  // index of the buffer whose pixels are in use
  Filled frame_;
  bool numbered_ = false;  // last_number_ is of this stream
  std::uint32_t last_number_ = 0;
  int failures_ = 0;      // EIO in a row
  int false_alarms_ = 0;  // ready, and yet nothing there, in a row
};

}  // namespace lakshya

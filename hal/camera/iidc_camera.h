// A camera on IEEE 1394 (IIDC), as a seam: libdc1394's (dc1394_camera.h), or a test's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/clock.h"
#include "hal/problem.h"
#include "kernels/base/status.h"

namespace lakshya {

struct IidcFrame {
  std::span<const std::uint8_t> bytes;
  int width = 0;  // px, as the camera says of this frame
  int height = 0;
  std::size_t bytes_per_line = 0;
  Nanoseconds age = -1;  // since it was taken; negative: not known
  bool torn = false;     // the driver says that data is missing
};

// Format7 mode 3, 16 bits per pixel.
struct IidcRequest {
  std::uint64_t guid = 0;  // 0: the first camera found
  int width = 640;         // px
  int height = 480;
  int packet_bytes = 0;  // per bus cycle of 125 us, which sets the frame rate; 0: the camera's recommendation
  int buffers = 4;
};

class IidcCamera {
 public:
  virtual ~IidcCamera() = default;

  // Finds it, sets the mode and starts. Statuses as Device::open(); `problem` says why. Starting again stops first.
  virtual Status start(const IidcRequest& request, Problem& problem) = 0;
  virtual void stop() = 0;

  // To wait on, while started.
  virtual int fd() const = 0;

  // The oldest frame that waits; it stays until fetch() gives another one or stop(). timeout: none waits; disconnected: the camera
  // has gone. Never blocks.
  virtual Status fetch(IidcFrame& frame) = 0;
};

}  // namespace lakshya

// Two cameras that see at the same time.
#pragma once

#include <cstdint>

#include "hal/clock.h"
#include "hal/device.h"
#include "kernels/base/image_view.h"

namespace lakshya {

// Raw images as the lenses give them, grey, both of the camera's size. What "left" means is the view, not the plug.
struct StereoFrame {
  ImageView<const std::uint8_t> left;
  ImageView<const std::uint8_t> right;
  Nanoseconds left_time = 0;   // when it was taken, on the clock that the driver was given
  Nanoseconds right_time = 0;  // the same unless the camera is two devices
  std::uint64_t sequence = 0;  // counted by the device: a gap is that many lost pairs
};

class StereoCamera : public Device {
 public:
  // Of one image in pixels, known after open().
  virtual int width() const = 0;
  virtual int height() const = 0;

  // The pair does not change although the vehicle moves (a single recorded pair): that is no frozen camera.
  virtual bool is_static() const { return false; }

  // The newest pair that was not given yet; waits for one until `deadline`. The views hold until the next capture() or
  // close(). timeout: none came; bad_data: one came torn, short, undecodable or with its halves too far apart in time, and the
  // next call may do better; disconnected: the device has gone, the next call looks for it again; end_of_data: a recording is
  // over.
  virtual Status capture(Nanoseconds deadline, StereoFrame& frame) = 0;
};

}  // namespace lakshya

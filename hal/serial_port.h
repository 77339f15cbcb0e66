// A line of bytes to a device. Drivers talk through this, tests bring their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/clock.h"
#include "hal/device.h"

namespace lakshya {

// open() after disconnected tries again.
class SerialPort : public Device {
 public:
  virtual bool is_open() const = 0;

  // ok: `count` > 0 bytes, those that are there, at most buffer.size(); waits for the first until `deadline`. timeout: none
  // came. disconnected: the port has gone, and is closed.
  virtual Status read(std::span<std::uint8_t> buffer, Nanoseconds deadline, std::size_t& count) = 0;

  // Hands over all bytes. timeout: only some of them were taken by `deadline`.
  virtual Status write(std::span<const std::uint8_t> bytes, Nanoseconds deadline) = 0;

  // Forgets what came and was not read.
  virtual void discard_input() = 0;
};

}  // namespace lakshya

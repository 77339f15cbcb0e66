// What all devices have in common. A driver belongs to one thread at a time. After open() it neither allocates nor throws nor
// prints, and waits only through Clock and never past the deadline that it was given.
#pragma once

#include <cstdint>
#include <span>

#include "hal/problem.h"
#include "kernels/base/status.h"

namespace lakshya {

// How often something went wrong since the driver was made; a driver's names never change.
struct Counter {
  const char* name;
  std::uint64_t value = 0;
};

class Device {
 public:
  virtual ~Device() = default;

  // Finds the device, sets it up and takes all memory that will be needed. Opening an open device closes it first.
  // disconnected: not there, or no permission; bad_argument: the driver's settings are impossible; unsupported: the device cannot
  // do what they ask for; timeout, bad_data, refused: it did not answer as it should. problem() says more.
  virtual Status open() = 0;

  // Leaves the device safe (wheels stopped). Closing twice does nothing.
  virtual void close() = 0;

  virtual std::span<const Counter> counters() const = 0;

  // The last failure in words, with its place: "/dev/ttyUSB0: No such file or directory"; empty when there was none.
  const char* problem() const { return problem_.text(); }

 protected:
  Problem problem_;
};

}  // namespace lakshya

// Something outside of this program that acts when the program no longer does.
#pragma once

#include "hal/device.h"

namespace lakshya {

// open() arms it. close() disarms it, where that is possible: a program that ends on purpose is no failure.
class Watchdog : public Device {
 public:
  // To be called more often than every timeout_s(), or it acts. Does not wait.
  virtual Status kick() = 0;

  // The timeout in force, which may be a rounded one.
  virtual double timeout_s() const = 0;
};

}  // namespace lakshya

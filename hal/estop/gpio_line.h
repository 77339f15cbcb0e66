// One line of a GPIO chip as an input, as a seam: libgpiod's (gpiod_line.h), or a test's.
#pragma once

#include <string>

#include "hal/problem.h"
#include "kernels/base/status.h"

namespace lakshya {

struct GpioLineRequest {
  std::string chip;  // "gpiochip0", its label ("pinctrl-bcm2711"), or a path
  int line = -1;     // offset on that chip
  bool active_low = false;
  // The chip's own resistor to its supply. Linux says nothing where a chip has none.
  bool pull_up = true;
};

class GpioLine {
 public:
  virtual ~GpioLine() = default;

  // Takes the line; taking it again releases it first. disconnected: no such chip, or no permission; bad_argument:
  // the chip has no such line; refused: somebody else has it, or the chip cannot do that. `problem` says why.
  virtual Status request(const GpioLineRequest& request, Problem& problem) = 0;
  virtual void release() = 0;

  // 1 active, 0 inactive, else -errno. Does not allocate; a chip behind I2C or USB takes as long as its bus.
  virtual int value() = 0;
};

}  // namespace lakshya

// Lines of the kernel's GPIO chips through libgpiod 1, where it was there when this was built.
#pragma once

#include <memory>

#include "hal/estop/gpio_line.h"

namespace lakshya {

// Built without libgpiod, its request() is unsupported. libgpiod allocates in request().
std::unique_ptr<GpioLine> make_gpiod_line();

}  // namespace lakshya

#include "hal/estop/gpio_estop.h"

#include <cstring>
#include <utility>

namespace lakshya {

GpioEstop::GpioEstop(GpioEstopSettings settings, GpioLine& line) : settings_(std::move(settings)), line_(&line) {}

GpioEstop::~GpioEstop() {
  GpioEstop::close();
}

Status GpioEstop::open() {
  close();
  if (settings_.chip.empty() || settings_.line < 0) {
    problem_.set("GPIO: chip \"%s\", line %d: no line of a chip", settings_.chip.c_str(), settings_.line);
    return Status::bad_argument;
  }
  Status status = line_->request({.chip = settings_.chip,
                                  .line = settings_.line,
                                  .active_low = settings_.active_low,
                                  .pull_up = settings_.pull_up},
                                 problem_);
  if (status != Status::ok) return status;
  is_open_ = true;
  bool pressed = true;
  status = read(pressed);
  if (status != Status::ok) close();
  return status;
}

void GpioEstop::close() {
  if (!is_open_) return;
  line_->release();
  is_open_ = false;
}

Status GpioEstop::read(bool& pressed) {
  pressed = true;
  if (!is_open_) return Status::disconnected;
  const int value = line_->value();
  if (value < 0) {
    ++counters_[0].value;
    problem_.set("GPIO: %s, line %d: %s", settings_.chip.c_str(), settings_.line, strerrordesc_np(-value));
    return Status::disconnected;
  }
  pressed = value != 0;
  return Status::ok;
}

}  // namespace lakshya

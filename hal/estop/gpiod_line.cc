#include "hal/estop/gpiod_line.h"

#ifdef LAKSHYA_HAVE_GPIOD

#include <gpiod.h>

#include <cerrno>
#include <cstring>

namespace lakshya {
namespace {

constexpr const char* kConsumer = "lakshya";  // what gpioinfo shows beside the line

class GpiodLine final : public GpioLine {
 public:
  GpiodLine() = default;
  ~GpiodLine() override { release_all(); }
  GpiodLine(const GpiodLine&) = delete;
  GpiodLine& operator=(const GpiodLine&) = delete;

  Status request(const GpioLineRequest& request, Problem& problem) override;
  void release() override { release_all(); }
  int value() override;

 private:
  void release_all();

  gpiod_chip* chip_ = nullptr;
  gpiod_line* line_ = nullptr;  // the chip's, requested
};

Status GpiodLine::request(const GpioLineRequest& request, Problem& problem) {
  release_all();
  const char* const name = request.chip.c_str();
  // The lookup knows names, labels and numbers, and only those paths that begin with /dev/.
  chip_ = request.chip.starts_with('/') ? gpiod_chip_open(name) : gpiod_chip_open_lookup(name);
  if (chip_ == nullptr) {
    problem.set("GPIO: %s: %s", name, strerrordesc_np(errno));
    return Status::disconnected;
  }
  const unsigned int lines = gpiod_chip_num_lines(chip_);
  if (request.line < 0 || static_cast<unsigned int>(request.line) >= lines) {
    problem.set("GPIO: %s: no line %d, it has %u", name, request.line, lines);
    release_all();
    return Status::bad_argument;
  }
  int flags = 0;
  if (request.active_low) flags |= GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW;
  if (request.pull_up) flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
  gpiod_line* const line = gpiod_chip_get_line(chip_, static_cast<unsigned int>(request.line));
  if (line == nullptr || gpiod_line_request_input_flags(line, kConsumer, flags) < 0) {
    problem.set("GPIO: %s, line %d: %s", name, request.line, strerrordesc_np(errno));
    release_all();
    return Status::refused;
  }
  line_ = line;
  return Status::ok;
}

void GpiodLine::release_all() {
  line_ = nullptr;  // closing the chip releases its lines
  if (chip_ != nullptr) gpiod_chip_close(chip_);
  chip_ = nullptr;
}

int GpiodLine::value() {
  if (line_ == nullptr) return -ENODEV;
  const int value = gpiod_line_get_value(line_);
  return value < 0 ? -errno : value;
}

}  // namespace

std::unique_ptr<GpioLine> make_gpiod_line() {
  return std::make_unique<GpiodLine>();
}

}  // namespace lakshya

#else

#include <cerrno>

namespace lakshya {
namespace {

class NoGpiod final : public GpioLine {
 public:
  Status request(const GpioLineRequest& /*request*/, Problem& problem) override {
    problem.set("GPIO: built without libgpiod");
    return Status::unsupported;
  }
  void release() override {}
  int value() override { return -ENODEV; }
};

}  // namespace

std::unique_ptr<GpioLine> make_gpiod_line() {
  return std::make_unique<NoGpiod>();
}

}  // namespace lakshya

#endif

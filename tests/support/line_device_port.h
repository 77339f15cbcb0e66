// A serial port with an emulated device at its other end, on a clock that only moves when somebody waits: hours of driving in
// no time.
#pragma once

#include <algorithm>
#include <string>

#include "tests/emulators/line.h"
#include "tests/support/manual_clock.h"
#include "tests/support/pluggable_port.h"

namespace lakshya {

class LineDevicePort final : public PluggablePort {
 public:
  LineDevicePort(emulator::LineDevice& device, ManualClock& clock)
      : PluggablePort("emulated port"), device_(&device), clock_(&clock) {}

  Status read(std::span<std::uint8_t> buffer, Nanoseconds deadline, std::size_t& count) override {
    count = 0;
    for (;;) {
      if (gone()) return Status::disconnected;
      input_ += device_->say(clock_->now());
      count = std::min(buffer.size(), input_.size());
      if (count > 0) break;
      if (clock_->now() >= deadline) return Status::timeout;
      clock_->sleep_until(std::min(deadline, clock_->now() + kLook));
    }
    std::copy_n(input_.begin(), count, buffer.begin());
    input_.erase(0, count);
    return Status::ok;
  }

  Status write(std::span<const std::uint8_t> bytes, Nanoseconds /*deadline*/) override {
    if (gone()) return Status::disconnected;
    device_->hear({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, clock_->now());
    return Status::ok;
  }

  void discard_input() override {
    (void)device_->say(clock_->now());
    input_.clear();
  }

 private:
  static constexpr Nanoseconds kLook = 50'000;

  emulator::LineDevice* device_;
  ManualClock* clock_;
  std::string input_;
};

}  // namespace lakshya

// What an emulated device says and hears on its line, whoever carries the bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lakshya::emulator {

class LineDevice {
 public:
  virtual ~LineDevice() = default;
  // Bytes from the host at `now_ns`; the device's clock never steps back.
  virtual void hear(std::string_view bytes, std::int64_t now_ns) = 0;
  // What the device has to say by `now_ns`, and not before.
  virtual std::string say(std::int64_t now_ns) = 0;
};

}  // namespace lakshya::emulator

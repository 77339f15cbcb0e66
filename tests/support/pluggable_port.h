// What the serial ports of tests have in common: a plug that can be pulled.
#pragma once

#include "hal/serial_port.h"

namespace lakshya {

class PluggablePort : public SerialPort {
 public:
  Status open() override {
    ++opened;
    if (unplugged) {
      problem_.set("%s: not there", name_);
      return Status::disconnected;
    }
    open_ = true;
    return Status::ok;
  }
  void close() override { open_ = false; }
  std::span<const Counter> counters() const override { return {}; }
  bool is_open() const override { return open_; }

  int opened = 0;
  bool unplugged = false;

 protected:
  explicit PluggablePort(const char* name) : name_(name) {}

  bool gone() {
    if (unplugged) open_ = false;
    return !open_;
  }

 private:
  const char* name_;
  bool open_ = false;
};

}  // namespace lakshya

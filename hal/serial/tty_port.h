// A serial port of the kernel's (termios): /dev/ttyUSB0, /dev/ttyAMA0, a pseudo-terminal. 8 data bits, no parity, no flow
// control, every byte as it is.
#pragma once

#include <string>

#include "hal/serial_port.h"

namespace lakshya {

struct TtySettings {
  std::string path;
  int baud = 115200;  // 4800, 9600, 19200, 38400, 57600, 115200 or 230400
  int stop_bits = 1;  // 1 or 2
};

class TtyPort final : public SerialPort {
 public:
  // `clock` outlives the port.
  TtyPort(TtySettings settings, Clock& clock);
  ~TtyPort() override;
  TtyPort(const TtyPort&) = delete;
  TtyPort& operator=(const TtyPort&) = delete;

  // Takes the port for this process alone (TIOCEXCL): refused where another has it.
  Status open() override;
  void close() override;
  std::span<const Counter> counters() const override { return counters_; }

  bool is_open() const override { return fd_ >= 0; }
  Status read(std::span<std::uint8_t> buffer, Nanoseconds deadline, std::size_t& count) override;
  Status write(std::span<const std::uint8_t> bytes, Nanoseconds deadline) override;
  void discard_input() override;

 private:
  Status fail(int error, const char* doing);
  Status give_up(int error);

  const TtySettings settings_;
  Clock* clock_;
  int fd_ = -1;
  Counter counters_[2] = {{"disconnections"}, {"write_timeouts"}};
};

}  // namespace lakshya

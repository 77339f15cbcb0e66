// A serial port whose other end is a script: what it says by itself, and what it answers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>

#include "tests/support/manual_clock.h"
#include "tests/support/pluggable_port.h"

namespace lakshya {

class FakeSerialPort final : public PluggablePort {
 public:
  explicit FakeSerialPort(ManualClock& clock) : PluggablePort("fake"), clock_(&clock) {}

  Status read(std::span<std::uint8_t> buffer, Nanoseconds deadline, std::size_t& count) override {
    count = 0;
    if (gone()) return Status::disconnected;
    if (pieces_.empty() || pieces_.front().time > deadline) {
      clock_->sleep_until(deadline);
      return Status::timeout;
    }
    Piece& piece = pieces_.front();
    clock_->sleep_until(piece.time);
    count = std::min(buffer.size(), piece.bytes.size());
    std::copy_n(piece.bytes.begin(), count, buffer.begin());
    piece.bytes.erase(0, count);
    if (piece.bytes.empty()) pieces_.pop_front();
    return Status::ok;
  }

  Status write(std::span<const std::uint8_t> bytes, Nanoseconds deadline) override {
    if (gone()) return Status::disconnected;
    if (stuck) {
      clock_->sleep_until(deadline);
      return Status::timeout;
    }
    const std::string text(bytes.begin(), bytes.end());
    written += text;
    if (answer) answer(text);
    return Status::ok;
  }

  void discard_input() override {
    while (!pieces_.empty() && pieces_.front().time <= clock_->now())
      pieces_.pop_front();
  }

  // The other end says this, `after` from now (in one piece: what one read gives at most).
  void say(std::string_view bytes, Nanoseconds after = 0) {
    pieces_.push_back({clock_->now() + after, std::string(bytes)});
  }

  std::function<void(const std::string& written)> answer;  // called with every write
  std::string written;
  bool stuck = false;  // nothing can be written

 private:
  struct Piece {
    Nanoseconds time;
    std::string bytes;
  };

  ManualClock* clock_;
  std::deque<Piece> pieces_;
};

}  // namespace lakshya

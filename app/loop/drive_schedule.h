// Which of its two exchanges with the drives a control turn has time for. On a slow serial line a command and a reading of the
// travel do not fit one period together (hal/servo/quicksilver.h has the figures): then every second turn reads.
#pragma once

#include <algorithm>

#include "hal/clock.h"

namespace lakshya {

class DriveSchedule {
 public:
  explicit DriveSchedule(Nanoseconds period) : period_(period) {}

  // Called at the beginning of every turn. `urgent`: the wheels must be told something else than before the turn.
  void begin(bool urgent) {
    reads_ = !urgent && (fits() || !reads_);
    commands_ = urgent || fits() || !reads_;
  }
  bool commands() const { return commands_; }
  bool reads() const { return reads_; }

  void commanded(Nanoseconds took) { keep(took, command_); }
  void has_read(Nanoseconds took) { keep(took, read_); }

 private:
  // A tenth of the period is for everything else.
  bool fits() const { return command_ + read_ <= period_ - period_ / 10; }
  // The longest of late: what is rare fades within some seconds.
  static void keep(Nanoseconds took, Nanoseconds& longest) {
    longest = std::max(took, longest - longest / 64);
  }

  const Nanoseconds period_;
  Nanoseconds command_ = 0;
  Nanoseconds read_ = 0;
  bool commands_ = true;
  bool reads_ = true;
};

}  // namespace lakshya

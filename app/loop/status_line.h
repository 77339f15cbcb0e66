// What somebody who watches sees: one line that is written over on a terminal, a log line every few seconds elsewhere, and every
// change of state once.
#pragma once

#include <string>

#include "app/loop/messages.h"

namespace lakshya {

// Without a way "no way open" instead of direction and clear distance:
// "RUN 12.4 s  at 1.20 -0.31 m, 12 deg  0.45 m/s  to +5 deg, clear 3.2 m  nearest 1.9 m  frame 124 21.3 ms"
std::string status_text(const StatusNote& status, Nanoseconds start);

// "RUN -> STOP: camera_silent (no pair has come for safety.camera_silent_s)"
std::string note_text(const StateNote& note);

class StatusLine {
 public:
  // `live`: stderr is a terminal.
  StatusLine(bool live, Nanoseconds start) : live_(live), start_(start) {}
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(const StatusNote& status);
  void log(const StateNote& note);

 private:
  void clear();

  const bool live_;
  const Nanoseconds start_;
  Nanoseconds next_ = 0;
  bool is_shown_ = false;
};

}  // namespace lakshya

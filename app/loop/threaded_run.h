// A run on the machine's clock: a thread for capture, one for perception (with OpenMP's team), one for control at 50 Hz, one for the
// drives' line, one for the compass, one for signals and watchdogs; the caller's thread does what may wait: log, status, recording.
#pragma once

#include <functional>

#include "app/loop/machinery.h"
#include "app/loop/stepped_run.h"
#include "hal/watchdog.h"

namespace lakshya {

struct ThreadedHooks {
  // The caller's thread, every 50 ms at least: log, status line, recording. It may wait for a disk or a terminal: nothing else does.
  std::function<void()> housekeeping;
  // The caller's thread: SIGUSR1 has come, and what is latched is about to be reset.
  std::function<void()> before_reset;
  // Kicked as long as the control loop turns.
  std::vector<Watchdog*> watchdogs;
};

// Returns when the run is over: frames, recording, SIGINT, SIGTERM, SIGHUP or SIGQUIT; the wheels have got their last zero then.
// SIGUSR1 resets what is latched. `clock` is the one that the machinery was given.
void run_threaded(Machinery& machinery, Clock& clock, const RunLimits& limits, const ThreadedHooks& hooks);

}  // namespace lakshya

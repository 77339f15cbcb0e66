// Runs an emulated device on a pseudo-terminal in a thread of its own, for tests and for the commands started by hand.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <thread>

#include "tests/emulators/line.h"
#include "tests/support/pseudo_terminal.h"

namespace lakshya::emulator {

class OnTerminal {
 public:
  // `device` outlives this; while this runs, it is touched through locked() only.
  explicit OnTerminal(LineDevice& device);
  ~OnTerminal();
  OnTerminal(const OnTerminal&) = delete;
  OnTerminal& operator=(const OnTerminal&) = delete;

  const std::string& path() const { return terminal_.path(); }
  const std::string& device() const { return terminal_.device(); }

  // Pulls the plug; the device runs on by itself.
  void unplug();

  // Hold it to look at the device or turn its knobs.
  std::unique_lock<std::mutex> locked() { return std::unique_lock(mutex_); }

 private:
  void run();

  std::mutex mutex_;  // of the next three
  LineDevice& device_;
  PseudoTerminal terminal_;
  bool plugged_ = true;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

// CLOCK_MONOTONIC.
std::int64_t monotonic_ns();

}  // namespace lakshya::emulator

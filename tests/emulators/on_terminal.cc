#include "tests/emulators/on_terminal.h"

#include <pthread.h>
#include <sched.h>

#include <chrono>

namespace lakshya::emulator {

std::int64_t monotonic_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

OnTerminal::OnTerminal(LineDevice& device) : device_(device), thread_([this] { run(); }) {}

OnTerminal::~OnTerminal() {
  stop_ = true;
  thread_.join();
}

void OnTerminal::unplug() {
  const auto lock = locked();
  plugged_ = false;
  terminal_.unplug();
}

// A millisecond is short beside the 8 ms that a reply of 16 characters takes at 19200 baud, and long enough not to load the
// machine.
void OnTerminal::run() {
  // A device on its line does not wait for this machine's processors, however busy they are; where that is not permitted it does.
  const sched_param first{.sched_priority = 60};
  (void)pthread_setschedparam(pthread_self(), SCHED_FIFO, &first);
  while (!stop_) {
    {
      const auto lock = locked();
      const std::string heard = plugged_ ? terminal_.read(0) : std::string();
      if (!heard.empty()) device_.hear(heard, monotonic_ns());
      const std::string said = device_.say(monotonic_ns());
      if (!said.empty() && plugged_) terminal_.write(said);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace lakshya::emulator

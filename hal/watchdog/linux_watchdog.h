// The machine's own watchdog (/dev/watchdog): it resets the machine when nobody kicks it. Linux:
// Documentation/watchdog/watchdog-api.rst.
#pragma once

#include <string>

#include "hal/linux/system_calls.h"
#include "hal/watchdog.h"

namespace lakshya {

struct LinuxWatchdogSettings {
  std::string path = "/dev/watchdog";
  int timeout_s = 10;  // 1 .. 3600; the hardware may round it
};

class LinuxWatchdog final : public Watchdog {
 public:
  explicit LinuxWatchdog(LinuxWatchdogSettings settings, SystemCalls& system = linux_system_calls());
  ~LinuxWatchdog() override;
  LinuxWatchdog(const LinuxWatchdog&) = delete;
  LinuxWatchdog& operator=(const LinuxWatchdog&) = delete;

  // disconnected: no such device, or somebody else (systemd) has it.
  Status open() override;
  // Disarmed by WDIOS_DISABLECARD; where the kernel forbids that (nowayout), the machine will be reset, and problem() says so.
  void close() override;
  // kick_failures
  std::span<const Counter> counters() const override { return counters_; }

  Status kick() override;
  double timeout_s() const override { return timeout_s_; }

 private:
  const LinuxWatchdogSettings settings_;
  SystemCalls* system_;
  int fd_ = -1;
  int timeout_s_ = 0;
  Counter counters_[1] = {{"kick_failures"}};
};

}  // namespace lakshya

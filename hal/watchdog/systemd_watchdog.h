// systemd, told how this program is: that it is ready, what it does, that it is alive, that it stops. A unit with
// Type=notify, WatchdogSec= and Restart=on-failure has the program started again when it was silent for too long.
//
// sd_notify(3) documents the protocol for clients of one's own: each message is one datagram of text to the socket
// that $NOTIFY_SOCKET names. libsystemd opens a socket for every message, may wait in it, and would be one more
// library to link.
#pragma once

#include <sys/socket.h>
#include <sys/un.h>

#include <string>
#include <string_view>

#include "hal/watchdog.h"

namespace lakshya {

struct SystemdWatchdogSettings {
  std::string socket;    // a path, or "@name" for Linux's abstract sockets; empty: nobody is there to be told
  double timeout_s = 0;  // 0: systemd expects no kicks
};

// As $NOTIFY_SOCKET, $WATCHDOG_USEC and $WATCHDOG_PID say. To be called at the start, before there are threads. A
// timeout meant for another process, or one that is no number, counts as none.
SystemdWatchdogSettings systemd_watchdog_settings();

class SystemdWatchdog final : public Watchdog {
 public:
  explicit SystemdWatchdog(SystemdWatchdogSettings settings);
  ~SystemdWatchdog() override;
  SystemdWatchdog(const SystemdWatchdog&) = delete;
  SystemdWatchdog& operator=(const SystemdWatchdog&) = delete;

  // Sends nothing: the watchdog has been running since systemd started the program. unsupported: no socket, or a
  // kind that is none of ours; disconnected: nobody listens there.
  Status open() override;
  // Tells systemd that the program is ending on purpose.
  void close() override;
  // send_failures
  std::span<const Counter> counters() const override { return counters_; }

  // All of these send at once or not at all. timeout: systemd has not read the last ones yet; disconnected: not
  // open, or nobody listens any more. A socket that has been made anew is found by the next message.

  // The start-up is done.
  Status ready();
  // One line for `systemctl status`; cut after 247 bytes, other lines become blanks.
  Status say(const char* text);
  // Sends nothing where no kicks are expected.
  Status kick() override;
  // 0: no kicks are expected, and it never acts.
  double timeout_s() const override { return settings_.timeout_s; }

 private:
  int connect_socket();
  Status send(std::string_view message);

  const SystemdWatchdogSettings settings_;
  int fd_ = -1;
  sockaddr_un address_{};
  socklen_t address_bytes_ = 0;
  Counter counters_[1] = {{"send_failures"}};
};

}  // namespace lakshya

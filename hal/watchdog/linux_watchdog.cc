#include "hal/watchdog/linux_watchdog.h"

#include <fcntl.h>
#include <linux/watchdog.h>

#include <cstring>
#include <utility>

namespace lakshya {

LinuxWatchdog::LinuxWatchdog(LinuxWatchdogSettings settings, SystemCalls& system)
    : settings_(std::move(settings)), system_(&system) {}

LinuxWatchdog::~LinuxWatchdog() {
  LinuxWatchdog::close();
}

Status LinuxWatchdog::open() {
  close();
  if (settings_.timeout_s < 1 || settings_.timeout_s > 3600) {
    problem_.set("%s: %d s: out of range", settings_.path.c_str(), settings_.timeout_s);
    return Status::bad_argument;
  }
  fd_ = system_->open(settings_.path.c_str(), O_WRONLY);
  if (fd_ < 0) {
    problem_.set("%s: %s", settings_.path.c_str(), strerrordesc_np(-fd_));
    fd_ = -1;
    return Status::disconnected;
  }
  timeout_s_ = settings_.timeout_s;
  Status status = Status::ok;
  const int error = system_->ioctl(fd_, WDIOC_SETTIMEOUT, &timeout_s_);
  if (error < 0) {
    problem_.set("%s: takes no timeout of %d s: %s", settings_.path.c_str(), settings_.timeout_s,
                 strerrordesc_np(-error));
    status = Status::unsupported;
  } else {
    status = kick();
  }
  if (status == Status::ok) return status;
  // Opening has armed it: nobody would kick it from now on.
  const Problem why = problem_;
  close();
  problem_ = why;
  return status;
}

void LinuxWatchdog::close() {
  if (fd_ < 0) return;
  int off = WDIOS_DISABLECARD;
  if (system_->ioctl(fd_, WDIOC_SETOPTIONS, &off) < 0) {
    problem_.set("%s: cannot be stopped: the machine will be reset in %d s", settings_.path.c_str(), timeout_s_);
  }
  (void)system_->close(fd_);
  fd_ = -1;
}

Status LinuxWatchdog::kick() {
  if (fd_ < 0) return Status::disconnected;
  int unused = 0;
  const int error = system_->ioctl(fd_, WDIOC_KEEPALIVE, &unused);
  if (error >= 0) return Status::ok;
  ++counters_[0].value;
  problem_.set("%s: %s", settings_.path.c_str(), strerrordesc_np(-error));
  return Status::disconnected;
}

}  // namespace lakshya

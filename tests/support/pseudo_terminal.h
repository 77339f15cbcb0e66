// A pair of connected terminals of the kernel's: a driver opens path(), the test or emulator holds the other end. The path is a
// link that goes with the plug: the kernel gives a terminal's number to the next who asks, and a driver that looks for a line
// that it lost must not find somebody else's.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>  // posix_openpt is POSIX
#include <termios.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tests/support/temp_folder.h"

namespace lakshya {

class PseudoTerminal {
 public:
  PseudoTerminal() {
    fd_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    char name[64] = {};
    if (fd_ < 0 || grantpt(fd_) != 0 || unlockpt(fd_) != 0 || ptsname_r(fd_, name, sizeof name) != 0)
      throw std::runtime_error("no pseudo-terminal");
    device_ = name;
    path_ = folder_.path("tty");
    std::filesystem::create_symlink(device_, path_);
    // Held open, so that the line lives on while nobody else has it open, and nothing is echoed before the driver sets it up.
    held_ = ::open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios mode{};
    if (held_ < 0 || tcgetattr(held_, &mode) != 0) throw std::runtime_error("no pseudo-terminal: " + path_);
    cfmakeraw(&mode);
    (void)tcsetattr(held_, TCSANOW, &mode);
  }
  ~PseudoTerminal() { unplug(); }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  const std::string& path() const { return path_; }
  // What the link points to, for people who start an emulator by hand.
  const std::string& device() const { return device_; }

  // The plug is pulled: for the driver the terminal is gone.
  void unplug() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
    for (int* fd : {&held_, &fd_}) {
      if (*fd >= 0) (void)::close(*fd);
      *fd = -1;
    }
  }

  // Bytes for which there is no more room, some 4000 after nobody has read, are lost, as on a line.
  void write(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t taken = ::write(fd_, bytes.data(), bytes.size());
      if (taken <= 0) return;
      bytes.remove_prefix(static_cast<std::size_t>(taken));
    }
  }

  // What comes within the time, at most 4096 bytes; empty when nothing does.
  std::string read(int timeout_ms) const {
    pollfd event{.fd = fd_, .events = POLLIN, .revents = 0};
    if (poll(&event, 1, timeout_ms) <= 0) return {};
    char buffer[4096];
    const ssize_t got = ::read(fd_, buffer, sizeof buffer);
    return got > 0 ? std::string(buffer, static_cast<std::size_t>(got)) : std::string();
  }

 private:
  int fd_ = -1;
  int held_ = -1;
  TempFolder folder_;
  std::string device_;
  std::string path_;
};

}  // namespace lakshya

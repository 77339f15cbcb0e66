#include "hal/serial/tty_port.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace lakshya {
namespace {

struct Baud {
  int baud;
  speed_t speed;
};
constexpr Baud kBauds[] = {{4800, B4800},   {9600, B9600},     {19200, B19200},  {38400, B38400},
                           {57600, B57600}, {115200, B115200}, {230400, B230400}};

bool find_speed(int baud, speed_t& speed) {
  for (const Baud& b : kBauds) {
    if (b.baud != baud) continue;
    speed = b.speed;
    return true;
  }
  return false;
}

// cfmakeraw() and what it leaves open.
termios raw_mode(termios mode, speed_t speed, int stop_bits) {
  cfmakeraw(&mode);
  mode.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  mode.c_cflag |= CLOCAL | CREAD | (stop_bits == 2 ? CSTOPB : 0U);
  mode.c_cc[VMIN] = 0;
  mode.c_cc[VTIME] = 0;
  cfsetispeed(&mode, speed);
  cfsetospeed(&mode, speed);
  return mode;
}

}  // namespace

TtyPort::TtyPort(TtySettings settings, Clock& clock) : settings_(std::move(settings)), clock_(&clock) {}

TtyPort::~TtyPort() {
  TtyPort::close();
}

Status TtyPort::fail(int error, const char* doing) {
  problem_.set("%s: %s: %s", settings_.path.c_str(), doing, strerrordesc_np(error));
  close();
  return error == EBUSY ? Status::refused : Status::disconnected;
}

// A port that was there does not come back under the same descriptor.
Status TtyPort::give_up(int error) {
  ++counters_[0].value;
  problem_.set("%s: gone: %s", settings_.path.c_str(), strerrordesc_np(error));
  close();
  return Status::disconnected;
}

Status TtyPort::open() {
  close();
  speed_t speed = 0;
  if (!find_speed(settings_.baud, speed) || settings_.stop_bits < 1 || settings_.stop_bits > 2) {
    problem_.set("%s: %d baud with %d stop bits: no such setting", settings_.path.c_str(), settings_.baud,
                 settings_.stop_bits);
    return Status::bad_argument;
  }
  fd_ = ::open(settings_.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd_ < 0) return fail(errno, "cannot be opened");
  termios mode{};
  if (tcgetattr(fd_, &mode) != 0) return fail(errno, "is no serial port");
  if (ioctl(fd_, TIOCEXCL) != 0) return fail(errno, "cannot be taken for this program alone");
  mode = raw_mode(mode, speed, settings_.stop_bits);
  if (tcsetattr(fd_, TCSANOW, &mode) != 0) return fail(errno, "does not take the settings");
  discard_input();
  return Status::ok;
}

void TtyPort::close() {
  if (fd_ < 0) return;
  // Errors here change nothing that anybody could do.
  (void)ioctl(fd_, TIOCNXCL);
  (void)::close(fd_);
  fd_ = -1;
}

Status TtyPort::read(std::span<std::uint8_t> buffer, Nanoseconds deadline, std::size_t& count) {
  count = 0;
  if (fd_ < 0) return Status::disconnected;
  for (;;) {
    const Status waited = clock_->wait_for(fd_, Ready::to_read, deadline);
    if (waited != Status::ok) return waited;
    const ssize_t got = ::read(fd_, buffer.data(), buffer.size());
    if (got > 0) {
      count = static_cast<std::size_t>(got);
      return Status::ok;
    }
    if (got == 0) return give_up(ENODEV);  // ready, and yet nothing to read: hung up
    if (errno != EINTR && errno != EAGAIN) return give_up(errno);
    if (clock_->now() >= deadline) return Status::timeout;
  }
}

Status TtyPort::write(std::span<const std::uint8_t> bytes, Nanoseconds deadline) {
  if (fd_ < 0) return Status::disconnected;
  while (!bytes.empty()) {
    const ssize_t taken = ::write(fd_, bytes.data(), bytes.size());
    if (taken > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(taken));
      continue;
    }
    if (taken < 0 && errno != EINTR && errno != EAGAIN) return give_up(errno);
    const Status waited = clock_->wait_for(fd_, Ready::to_write, deadline);
    // Ready, and yet not taken: not for ever.
    const bool late = waited == Status::timeout || clock_->now() >= deadline;
    if (late) ++counters_[1].value;
    if (late || waited != Status::ok) return late ? Status::timeout : waited;
  }
  return Status::ok;
}

void TtyPort::discard_input() {
  if (fd_ >= 0) (void)tcflush(fd_, TCIFLUSH);
}

}  // namespace lakshya

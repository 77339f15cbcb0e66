#include "hal/watchdog/systemd_watchdog.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <utility>

namespace lakshya {
namespace {

constexpr double kMicrosecondsPerSecond = 1e6;

std::string_view variable(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr ? value : "";
}

// 0 for what is no number.
std::uint64_t number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : 0;
}

bool is_inside_a_character(char byte) {  // UTF-8
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

}  // namespace

SystemdWatchdogSettings systemd_watchdog_settings() {
  SystemdWatchdogSettings settings{.socket = std::string(variable("NOTIFY_SOCKET")), .timeout_s = 0};
  const std::string_view pid = variable("WATCHDOG_PID");
  const std::uint64_t timeout_us = number(variable("WATCHDOG_USEC"));
  const bool is_ours = pid.empty() || number(pid) == static_cast<std::uint64_t>(getpid());
  if (is_ours && timeout_us != std::numeric_limits<std::uint64_t>::max())  // systemd's infinity
    settings.timeout_s = static_cast<double>(timeout_us) / kMicrosecondsPerSecond;
  return settings;
}

SystemdWatchdog::SystemdWatchdog(SystemdWatchdogSettings settings) : settings_(std::move(settings)) {}

SystemdWatchdog::~SystemdWatchdog() {
  SystemdWatchdog::close();
}

Status SystemdWatchdog::open() {
  close();
  const std::string& name = settings_.socket;
  if (name.empty()) {
    problem_.set("systemd: no NOTIFY_SOCKET: it did not start this program, or not with Type=notify");
    return Status::unsupported;
  }
  if (name[0] != '/' && name[0] != '@') {
    problem_.set("systemd: NOTIFY_SOCKET is \"%s\": neither a path nor an abstract socket", name.c_str());
    return Status::unsupported;
  }
  address_ = {};
  address_.sun_family = AF_UNIX;
  if (name.size() < 2 || name.size() >= sizeof address_.sun_path) {
    problem_.set("systemd: NOTIFY_SOCKET of %zu characters: not possible", name.size());
    return Status::bad_argument;
  }
  name.copy(address_.sun_path, name.size());
  const bool is_abstract = name[0] == '@';
  if (is_abstract) address_.sun_path[0] = '\0';
  // The name of an abstract socket is all that its length says, that of a path ends with its 0.
  address_bytes_ = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size() + (is_abstract ? 0 : 1));
  fd_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int error = fd_ < 0 ? errno : connect_socket();
  if (error == 0) return Status::ok;
  problem_.set("systemd: %s: %s", name.c_str(), strerrordesc_np(error));
  if (fd_ >= 0) (void)::close(fd_);
  fd_ = -1;
  return Status::disconnected;
}

void SystemdWatchdog::close() {
  if (fd_ < 0) return;
  (void)send("STOPPING=1");
  (void)::close(fd_);
  fd_ = -1;
}

Status SystemdWatchdog::ready() {
  return send("READY=1");
}

Status SystemdWatchdog::say(const char* text) {
  std::array<char, 254> message{};
  constexpr std::string_view kBegin = "STATUS=";
  const std::size_t room = message.size() - kBegin.size();
  const std::string_view all(text);
  std::size_t length = std::min(all.size(), room);
  // systemd takes no text whose last character is cut.
  while (length > 0 && length < all.size() && is_inside_a_character(all[length]))
    --length;
  const auto at = std::ranges::copy(kBegin, message.begin()).out;
  // A line of its own would be an assignment of its own.
  const auto end = std::ranges::replace_copy(all.substr(0, length), at, '\n', ' ').out;
  return send({message.data(), static_cast<std::size_t>(end - message.begin())});
}

Status SystemdWatchdog::kick() {
  if (settings_.timeout_s <= 0) return fd_ < 0 ? Status::disconnected : Status::ok;
  return send("WATCHDOG=1");
}

// 0 or errno.
int SystemdWatchdog::connect_socket() {
  const auto* const address = reinterpret_cast<const sockaddr*>(&address_);
  return ::connect(fd_, address, address_bytes_) == 0 ? 0 : errno;
}

Status SystemdWatchdog::send(std::string_view message) {
  if (fd_ < 0) return Status::disconnected;
  const auto once = [&] {
    return ::send(fd_, message.data(), message.size(), MSG_DONTWAIT | MSG_NOSIGNAL) >= 0 ? 0 : errno;
  };
  int error = once();
  // Whoever listened has gone, now or at the last message: perhaps somebody else is there.
  if (error == ECONNREFUSED || error == ENOTCONN) {
    error = connect_socket();
    if (error == 0) error = once();
  }
  if (error == 0) return Status::ok;
  ++counters_[0].value;
  problem_.set("systemd: %s: %s", settings_.socket.c_str(), strerrordesc_np(error));
  return error == EAGAIN ? Status::timeout : Status::disconnected;
}

}  // namespace lakshya

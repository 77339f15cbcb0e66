#include "hal/watchdog/systemd_watchdog.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <string>

#include "tests/support/count_allocations.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

// systemd's end.
class NotifySocket {
 public:
  explicit NotifySocket(const std::string& name)
      : is_path_(name[0] == '/'), path_(name), fd_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name.copy(address.sun_path, name.size());
    if (!is_path_) address.sun_path[0] = '\0';
    const auto bytes = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size() + (is_path_ ? 1 : 0));
    EXPECT_EQ(::bind(fd_, reinterpret_cast<const sockaddr*>(&address), bytes), 0) << name;
  }
  ~NotifySocket() {
    ::close(fd_);
    if (is_path_) ::unlink(path_.c_str());
  }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  // The oldest message; "" when there is none.
  std::string next() {
    std::array<char, 1024> buffer{};
    const ssize_t got = ::recv(fd_, buffer.data(), buffer.size(), MSG_DONTWAIT);
    return got < 0 ? std::string() : std::string(buffer.data(), static_cast<std::size_t>(got));
  }

 private:
  bool is_path_;
  std::string path_;
  int fd_;
};

class SystemdWatchdogTest : public testing::Test {
 protected:
  TempFolder folder_;
  const std::string path_ = folder_.path("notify");
  std::unique_ptr<NotifySocket> systemd_ = std::make_unique<NotifySocket>(path_);
  SystemdWatchdog watchdog_{{.socket = path_, .timeout_s = 2.5}};
};

TEST_F(SystemdWatchdogTest, TellsFromTheStartToTheEnd) {
  ASSERT_EQ(watchdog_.open(), Status::ok) << watchdog_.problem();
  EXPECT_EQ(systemd_->next(), "");
  EXPECT_EQ(watchdog_.timeout_s(), 2.5);
  test::allocations = 0;
  EXPECT_EQ(watchdog_.ready(), Status::ok);
  EXPECT_EQ(watchdog_.say("10 Hz, 3 pairs lost"), Status::ok);
  EXPECT_EQ(watchdog_.kick(), Status::ok);
  EXPECT_EQ(test::allocations, 0);
  watchdog_.close();
  EXPECT_EQ(systemd_->next(), "READY=1");
  EXPECT_EQ(systemd_->next(), "STATUS=10 Hz, 3 pairs lost");
  EXPECT_EQ(systemd_->next(), "WATCHDOG=1");
  EXPECT_EQ(systemd_->next(), "STOPPING=1");
  watchdog_.close();
  EXPECT_EQ(systemd_->next(), "");
  EXPECT_EQ(watchdog_.kick(), Status::disconnected);
  EXPECT_EQ(watchdog_.ready(), Status::disconnected);
  EXPECT_EQ(watchdog_.counters()[0].value, 0U);
}

TEST_F(SystemdWatchdogTest, AbstractSocketsHaveNoPath) {
  const std::string name = "@lakshya-test-" + std::to_string(getpid());
  NotifySocket systemd(name);
  SystemdWatchdog watchdog({.socket = name, .timeout_s = 1});
  ASSERT_EQ(watchdog.open(), Status::ok) << watchdog.problem();
  EXPECT_EQ(watchdog.kick(), Status::ok);
  EXPECT_EQ(systemd.next(), "WATCHDOG=1");
}

TEST_F(SystemdWatchdogTest, WithoutATimeoutThereAreNoKicks) {
  SystemdWatchdog watchdog({.socket = path_});
  EXPECT_EQ(watchdog.kick(), Status::disconnected);
  ASSERT_EQ(watchdog.open(), Status::ok);
  EXPECT_EQ(watchdog.kick(), Status::ok);
  EXPECT_EQ(watchdog.ready(), Status::ok);
  EXPECT_EQ(systemd_->next(), "READY=1");
}

TEST_F(SystemdWatchdogTest, AStatusIsOneLineOfWholeCharacters) {
  ASSERT_EQ(watchdog_.open(), Status::ok);
  EXPECT_EQ(watchdog_.say("well\nSTOPPING=1"), Status::ok);
  EXPECT_EQ(systemd_->next(), "STATUS=well STOPPING=1");
  EXPECT_EQ(watchdog_.say(""), Status::ok);
  EXPECT_EQ(systemd_->next(), "STATUS=");
  EXPECT_EQ(watchdog_.say((std::string(247, 'a')).c_str()), Status::ok);
  EXPECT_EQ(systemd_->next(), "STATUS=" + std::string(247, 'a'));
  EXPECT_EQ(watchdog_.say((std::string(246, 'a') + "bc").c_str()), Status::ok);
  EXPECT_EQ(systemd_->next(), "STATUS=" + std::string(246, 'a') + "b");
  EXPECT_EQ(watchdog_.say((std::string(246, 'a') + "\u00e9").c_str()), Status::ok);  // 2 bytes
  EXPECT_EQ(systemd_->next(), "STATUS=" + std::string(246, 'a'));
  EXPECT_EQ(watchdog_.say((std::string(245, 'a') + "\u00e9").c_str()), Status::ok);
  EXPECT_EQ(systemd_->next(), "STATUS=" + std::string(245, 'a') + "\u00e9");
}

TEST_F(SystemdWatchdogTest, WhoeverDoesNotReadIsNotWaitedFor) {
  ASSERT_EQ(watchdog_.open(), Status::ok);
  Status status = Status::ok;
  for (int n = 0; n < 100'000 && status == Status::ok; ++n)
    status = watchdog_.kick();
  EXPECT_EQ(status, Status::timeout);
  EXPECT_EQ(watchdog_.counters()[0].value, 1U);
  while (!systemd_->next().empty()) {
  }
  EXPECT_EQ(watchdog_.kick(), Status::ok);
}

TEST_F(SystemdWatchdogTest, ASocketThatIsMadeAnewIsFound) {
  ASSERT_EQ(watchdog_.open(), Status::ok);
  systemd_.reset();
  test::allocations = 0;
  EXPECT_EQ(watchdog_.kick(), Status::disconnected);
  EXPECT_EQ(watchdog_.kick(), Status::disconnected);
  EXPECT_EQ(test::allocations, 0);
  EXPECT_NE(std::string(watchdog_.problem()).find("No such file"), std::string::npos) << watchdog_.problem();
  EXPECT_EQ(watchdog_.counters()[0].value, 2U);
  systemd_ = std::make_unique<NotifySocket>(path_);
  EXPECT_EQ(watchdog_.kick(), Status::ok);
  EXPECT_EQ(systemd_->next(), "WATCHDOG=1");
}

TEST_F(SystemdWatchdogTest, WithoutASocketThereIsNothingToTell) {
  SystemdWatchdog none({.socket = {}, .timeout_s = 1});
  EXPECT_EQ(none.open(), Status::unsupported);
  EXPECT_NE(std::string(none.problem()).find("no NOTIFY_SOCKET"), std::string::npos) << none.problem();
  SystemdWatchdog other({.socket = "vsock:2:1234"});
  EXPECT_EQ(other.open(), Status::unsupported);
  SystemdWatchdog nobody({.socket = folder_.path("nobody")});
  EXPECT_EQ(nobody.open(), Status::disconnected);
  EXPECT_NE(std::string(nobody.problem()).find("No such file"), std::string::npos) << nobody.problem();
  for (const std::string& name : {std::string("/"), std::string("@"), "/" + std::string(107, 'a')}) {
    SystemdWatchdog odd({.socket = name});
    EXPECT_EQ(odd.open(), Status::bad_argument) << name;
  }
  SystemdWatchdog longest({.socket = "/" + std::string(106, 'a')});
  EXPECT_EQ(longest.open(), Status::disconnected);
}

// ---- the environment

class Environment {
 public:
  ~Environment() { clear(); }
  void clear() {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"})
      ::unsetenv(name);
  }
  void set(const char* name, const std::string& value) { ::setenv(name, value.c_str(), 1); }
};

TEST(SystemdWatchdogSettings, ComeFromTheEnvironment) {
  Environment environment;
  environment.clear();
  EXPECT_EQ(systemd_watchdog_settings().socket, "");
  EXPECT_EQ(systemd_watchdog_settings().timeout_s, 0);
  environment.set("NOTIFY_SOCKET", "/run/systemd/notify");
  environment.set("WATCHDOG_USEC", "1500000");
  EXPECT_EQ(systemd_watchdog_settings().socket, "/run/systemd/notify");
  EXPECT_EQ(systemd_watchdog_settings().timeout_s, 1.5);
  environment.set("WATCHDOG_PID", std::to_string(getpid()));
  EXPECT_EQ(systemd_watchdog_settings().timeout_s, 1.5);
}

TEST(SystemdWatchdogSettings, ATimeoutForSomebodyElseIsNone) {
  Environment environment;
  environment.clear();
  environment.set("WATCHDOG_USEC", "1500000");
  for (const std::string& pid : {std::to_string(getpid() + 1), std::string("x"), std::string("-1")}) {
    environment.set("WATCHDOG_PID", pid);
    EXPECT_EQ(systemd_watchdog_settings().timeout_s, 0) << pid;
  }
  environment.clear();
  for (const char* timeout : {"", "0", "-5", "2s", "1.5", "18446744073709551615", "99999999999999999999"}) {
    environment.set("WATCHDOG_USEC", timeout);
    EXPECT_EQ(systemd_watchdog_settings().timeout_s, 0) << timeout;
  }
}

}  // namespace
}  // namespace lakshya

#include "hal/watchdog/linux_watchdog.h"

#include <gtest/gtest.h>
#include <linux/watchdog.h>

#include <cstring>
#include <string>
#include <vector>

#include "tests/support/count_allocations.h"
#include "tests/support/faulty_system.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

// Hardware that counts in steps of 8 s.
class LinuxWatchdogTest : public testing::Test {
 protected:
  LinuxWatchdogTest() {
    system_.on_ioctl = [this](unsigned long request, void* argument) {
      if (request == WDIOC_KEEPALIVE) {
        ++kicks_;
        return 0;
      }
      int value = 0;
      std::memcpy(&value, argument, sizeof value);
      if (request == WDIOC_SETTIMEOUT) {
        value = (value + 7) / 8 * 8;
        std::memcpy(argument, &value, sizeof value);
        return 0;
      }
      if (request == WDIOC_SETOPTIONS) {
        disarmed_ = value == WDIOS_DISABLECARD && !no_way_out_;
        return no_way_out_ ? -EBUSY : 0;
      }
      return -ENOTTY;
    };
  }

  TempFolder folder_;
  FaultySystem system_;
  LinuxWatchdogSettings settings_{.path = folder_.write("watchdog", std::string()), .timeout_s = 10};
  int kicks_ = 0;
  bool disarmed_ = false;
  bool no_way_out_ = false;
};

TEST_F(LinuxWatchdogTest, IsArmedKickedAndDisarmed) {
  LinuxWatchdog watchdog(settings_, system_);
  ASSERT_EQ(watchdog.open(), Status::ok) << watchdog.problem();
  EXPECT_EQ(watchdog.timeout_s(), 16);
  EXPECT_EQ(kicks_, 1);
  test::allocations = 0;
  EXPECT_EQ(watchdog.kick(), Status::ok);
  EXPECT_EQ(test::allocations, 0);
  EXPECT_EQ(kicks_, 2);
  watchdog.close();
  EXPECT_TRUE(disarmed_);
  EXPECT_EQ(system_.open_files(), 0U);
  EXPECT_EQ(watchdog.kick(), Status::disconnected);
}

TEST_F(LinuxWatchdogTest, SaysWhenTheKernelDoesNotLetGo) {
  no_way_out_ = true;
  LinuxWatchdog watchdog(settings_, system_);
  ASSERT_EQ(watchdog.open(), Status::ok);
  watchdog.close();
  EXPECT_NE(std::string(watchdog.problem()).find("will be reset in 16 s"), std::string::npos) << watchdog.problem();
}

TEST_F(LinuxWatchdogTest, CountsKicksThatDoNotArrive) {
  LinuxWatchdog watchdog(settings_, system_);
  ASSERT_EQ(watchdog.open(), Status::ok);
  system_.unplugged = true;
  EXPECT_EQ(watchdog.kick(), Status::disconnected);
  EXPECT_EQ(watchdog.counters()[0].value, 1U);
  system_.unplugged = false;
  EXPECT_EQ(watchdog.kick(), Status::ok);
}

TEST_F(LinuxWatchdogTest, IsDisarmedAgainWhenItCannotBeKicked) {
  const auto answer = system_.on_ioctl;
  system_.on_ioctl = [&](unsigned long request, void* argument) {
    return request == WDIOC_KEEPALIVE ? -EIO : answer(request, argument);
  };
  LinuxWatchdog watchdog(settings_, system_);
  EXPECT_EQ(watchdog.open(), Status::disconnected);
  EXPECT_TRUE(disarmed_);
  EXPECT_EQ(system_.open_files(), 0U);
  EXPECT_NE(std::string(watchdog.problem()).find("Input/output error"), std::string::npos) << watchdog.problem();
}

TEST_F(LinuxWatchdogTest, RefusesWhatIsNoWatchdog) {
  LinuxWatchdog none({.path = folder_.path("none")}, system_);
  EXPECT_EQ(none.open(), Status::disconnected);
  EXPECT_NE(std::string(none.problem()).find("No such file"), std::string::npos);
  LinuxWatchdog odd({.path = settings_.path, .timeout_s = 0}, system_);
  EXPECT_EQ(odd.open(), Status::bad_argument);
  system_.on_ioctl = nullptr;
  LinuxWatchdog file(settings_, system_);
  EXPECT_EQ(file.open(), Status::unsupported);
  EXPECT_EQ(system_.open_files(), 0U);
}

}  // namespace
}  // namespace lakshya

// `lakshyad run` as systemd starts it: a recorded drive as the camera, emulated drives and compass on their lines.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/emulators/on_terminal.h"
#include "tests/emulators/os5000_device.h"
#include "tests/emulators/quicksilver_drive.h"
#include "tests/support/child_process.h"
#include "tests/support/emulated.h"
#include "tests/support/recorded_run.h"

namespace lakshya {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

class RunCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (lakshyad_binary().empty()) GTEST_SKIP() << "LAKSHYAD_BIN names no lakshyad";
    const auto lock = compass_terminal_.locked();
    compass_.rate_hz = 20;
  }

  std::string config() const {
    std::ostringstream text;
    text << "camera: {height_m: 0.6, calibration: " << recording_.path() << "calib.txt}\n"
         << "matcher: {disparities: 32}\nvehicle: {max_speed_mps: 0.6}\n"
         << "drivers: {camera: folder, servo: quicksilver, compass: os5000, estop: file}\n"
         << "folder: {left: " << recording_.path() << "left, right: " << recording_.path()
         << "right, pace: rate, rate_hz: 15, repeat: 'yes'}\n"
         << "quicksilver: {port: " << drive_terminal_.path() << "}\nos5000: {port: " << compass_terminal_.path()
         << "}\ncompass: {rate_hz: 20}\nestop: {path: " << folder_.path("estop") << "}\nsafety: {recover_s: 0.3}\n";
    return folder_.write("vehicle.yaml", text.str());
  }

  Words run_words(Words more = {}) const {
    (void)folder_.write("estop", std::string("0"));
    Words words{lakshyad_binary(), "run", "--config", config(), "--report", folder_.path("report.json")};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  // Both drives told to stand, by whomever.
  bool stands() {
    const auto lock = drive_terminal_.locked();
    for (std::size_t i = 0; i < drives_.drives(); ++i) {
      const emulator::QuickSilverState s = drives_.state(i, emulator::monotonic_ns());
      // A velocity of 1 is the driver's trial of the resident program.
      if (std::abs(drives_.drive(i).value(30)) > 1 && !s.tripped) return false;
    }
    return true;
  }

  static double milliseconds_until(const std::function<bool()>& what, int limit_ms) {
    const std::int64_t begin = emulator::monotonic_ns();
    while (!what()) {
      if (emulator::monotonic_ns() - begin > limit_ms * std::int64_t{1'000'000}) return -1;
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    return static_cast<double>(emulator::monotonic_ns() - begin) / 1e6;
  }

  bool drives_soon(const ChildProcess& firmware) {
    const bool moves = milliseconds_until([this] { return !stands(); }, 10'000) >= 0;
    EXPECT_TRUE(moves) << firmware.err();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    return moves;
  }

  // The wheels turn, then `number` comes.
  void signal_and_stop(int number, int exit_code) {
    ChildProcess firmware(run_words());
    ASSERT_TRUE(drives_soon(firmware));
    firmware.signal(number);
    const double ms = milliseconds_until([this] { return stands(); }, 1000);
    EXPECT_GE(ms, 0);
    EXPECT_LE(ms, 200);
    EXPECT_EQ(firmware.wait(3000), exit_code) << firmware.err();
    std::printf("| signal %s | `terminate` | %.0f | 200 | | |\n", strsignal(number), ms);
    const Json report = Json::parse(bytes_of(folder_.path("report.json")));
    EXPECT_EQ(report["states"].back()["state"], "END");
    EXPECT_GT(report["frames"], 10);
    EXPECT_TRUE(stands());
  }

  test::RecordedRun recording_{6, 160, 120, {.first = 0, .left_column = 45, .right_column = 90}};
  TempFolder folder_;
  emulator::QuickSilverLine drives_;
  emulator::OnTerminal drive_terminal_{drives_};
  emulator::Os5000Device compass_;
  emulator::OnTerminal compass_terminal_{compass_};
};

TEST_F(RunCommand, SigtermStopsTheWheelsAndEndsWell) {
  signal_and_stop(SIGTERM, 0);
}

TEST_F(RunCommand, SigintStopsTheWheelsAndEndsWell) {
  signal_and_stop(SIGINT, 0);
}

// kill -9 and a process that is stopped: nobody commands zero any more, the drives' own programs do.
TEST_F(RunCommand, DrivesStopByThemselvesWhenTheProgramIsKilledOrStopped) {
  for (const int number : {SIGKILL, SIGSTOP}) {
    ChildProcess firmware(run_words());
    ASSERT_TRUE(drives_soon(firmware));
    firmware.signal(number);
    const double ms = milliseconds_until([this] { return stands(); }, 1000);
    EXPECT_GE(ms, 0);
    EXPECT_LE(ms, 300);
    std::printf("| signal %s | drives' own | %.0f | 300 | | |\n", strsignal(number), ms);
    if (number == SIGSTOP) {
      // It goes on, finds that it was late, and drives again when all is well.
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      firmware.signal(SIGCONT);
      EXPECT_GE(milliseconds_until([this] { return !stands(); }, 5000), 0) << firmware.err();
      EXPECT_NE(firmware.err().find("control_late"), std::string::npos) << firmware.err();
    }
  }
}

TEST_F(RunCommand, StopMotorsStopsWhatACrashLeftRunning) {
  // Without their program drives run on until the next command.
  emulator::QuickSilverLine bare({16, 17}, {.at_power_up = false});
  emulator::OnTerminal terminal(bare);
  const Words words{lakshyad_binary(), "stop-motors",
                    "--set",           "drivers.servo=quicksilver",
                    "--set",           "quicksilver.port=" + terminal.path(),
                    "--set",           "quicksilver.supervised=no"};
  {
    const auto lock = terminal.locked();
    bare.hear("@16 15 38655 64424509 0 0\r@17 15 38655 64424509 0 0\r", emulator::monotonic_ns());
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const Outcome o = run_command(words);
  EXPECT_EQ(o.exit_code, 0) << o.err;
  const auto lock = terminal.locked();
  const std::int64_t soon = emulator::monotonic_ns() + 2'000'000'000;
  EXPECT_GT(bare.state(0, soon).position, 0) << "never ran: the test shows nothing";
  EXPECT_EQ(bare.state(0, soon).velocity_rpm, 0);
  EXPECT_EQ(bare.state(1, soon).velocity_rpm, 0);
}

TEST_F(RunCommand, TheEmergencyStopHoldsUntilReset) {
  ChildProcess firmware(run_words());
  ASSERT_TRUE(drives_soon(firmware));
  (void)folder_.write("estop", std::string("1"));
  const double ms = milliseconds_until([this] { return stands(); }, 1000);
  EXPECT_GE(ms, 0);
  EXPECT_LE(ms, 200);
  (void)folder_.write("estop", std::string("0"));
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  EXPECT_TRUE(stands()) << "is not latched";
  firmware.signal(SIGUSR1);
  EXPECT_GE(milliseconds_until([this] { return !stands(); }, 5000), 0) << firmware.err();
  firmware.signal(SIGTERM);
  EXPECT_EQ(firmware.wait(3000), 0);
  const Json report = Json::parse(bytes_of(folder_.path("report.json")));
  EXPECT_EQ(report["faults"].value("emergency_stop", 0), 1);
}

TEST_F(RunCommand, AFaultThatWaitsForAPersonOutlivesACrash) {
  const Words words = run_words({"--latch", folder_.path("fault")});
  {
    ChildProcess firmware(words);
    ASSERT_TRUE(drives_soon(firmware));
    (void)folder_.write("estop", std::string("1"));
    EXPECT_GE(milliseconds_until([&] { return std::filesystem::exists(folder_.path("fault")); }, 2000), 0);
    firmware.signal(SIGKILL);
    EXPECT_EQ(firmware.wait(1000), 128 + SIGKILL);
  }
  (void)folder_.write("estop", std::string("0"));
  ChildProcess again(words);
  EXPECT_GE(milliseconds_until([&] { return again.err().find("fault_before") != std::string::npos; }, 5000), 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  EXPECT_TRUE(stands()) << again.err();
  again.signal(SIGUSR1);
  EXPECT_GE(milliseconds_until([this] { return !stands(); }, 5000), 0) << again.err();
  EXPECT_GE(milliseconds_until([&] { return !std::filesystem::exists(folder_.path("fault")); }, 1000), 0);
  again.signal(SIGHUP);
  EXPECT_EQ(again.wait(3000), 0);
  EXPECT_TRUE(stands());
}

// A terminal that no longer takes anything holds up the log, not the stop.
TEST_F(RunCommand, ABlockedLogDoesNotDelayTheEnd) {
  int ends[2] = {-1, -1};
  ASSERT_EQ(::pipe(ends), 0);
  Words words{"/bin/sh", "-c", "exec \"$@\" 2>/proc/self/fd/" + std::to_string(ends[1]), "sh"};
  for (const std::string& word : run_words({"--set", "drivers.compass=none"}))
    words.push_back(word);
  ChildProcess firmware(words);
  const bool moves = milliseconds_until([this] { return !stands(); }, 10'000) >= 0;
  std::string filling(65536, '.');  // nobody reads: the pipe is full
  (void)::fcntl(ends[1], F_SETFL, O_NONBLOCK);
  (void)!::write(ends[1], filling.data(), filling.size());
  EXPECT_TRUE(moves);
  firmware.signal(SIGUSR1);
  std::this_thread::sleep_for(std::chrono::milliseconds(6000));  // a line of status is due every 5 s
  EXPECT_FALSE(stands()) << "nothing was wrong";
  firmware.signal(SIGTERM);
  const double ms = milliseconds_until([this] { return stands(); }, 1000);
  EXPECT_GE(ms, 0);
  EXPECT_LE(ms, 200);
  (void)::close(ends[0]);
  (void)::close(ends[1]);
}

// The disk is full: here no file of the program may grow beyond 8 blocks of 512 bytes.
TEST_F(RunCommand, ARecordingThatCannotBeWrittenStopsTheWheels) {
  Words words{"/bin/sh", "-c", "trap '' XFSZ; ulimit -f 8; exec \"$@\"", "sh"};
  for (const std::string& word : run_words({"--out", folder_.path("out"), "--picture-every", "0"}))
    words.push_back(word);
  ChildProcess firmware(words);
  EXPECT_GE(milliseconds_until([this] { return !stands(); }, 10'000), 0) << firmware.err();
  EXPECT_GE(
      milliseconds_until([&] { return firmware.err().find("recording_failed") != std::string::npos; }, 10'000), 0)
      << firmware.err();
  EXPECT_GE(milliseconds_until([this] { return stands(); }, 200), 0);
  EXPECT_NE(firmware.err().find("decisions.jsonl: "), std::string::npos) << firmware.err();
  firmware.signal(SIGTERM);
  EXPECT_EQ(firmware.wait(3000), 0);
  // No half line stays.
  const std::string lines = bytes_of(folder_.path("out") + "/decisions.jsonl");
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines.back(), '\n');
}

TEST_F(RunCommand, WhatCannotBeginNeverTurnsAWheel) {
  const auto refused = [&](Words more, const std::string& why) {
    const Outcome o = run_command(run_words(std::move(more)));
    EXPECT_EQ(o.exit_code, 1) << o.err;
    EXPECT_NE(o.err.find(why), std::string::npos) << o.err;
    EXPECT_TRUE(stands());
    EXPECT_FALSE(std::filesystem::exists(folder_.path("report.json")));
    const auto lock = drive_terminal_.locked();
    EXPECT_LT(drives_.state(0, emulator::monotonic_ns()).position, 1);  // count: the trial of the resident program
  };
  refused({"--set", "vehicle.max_speed_mps=fast"}, "vehicle.max_speed_mps");
  refused({"--set", "safety.tilt_deg=-1"}, "safety.tilt_deg");
  refused({"--set", "drivers.compass=sim"}, "sim");
  refused({"--set", "camera.calibration=/no/calib.txt"}, "/no/calib.txt");
  refused({"--set", "quicksilver.left_address=99"}, "drivers.servo: quicksilver");
  refused({"--set", "memory.limit_mb=1"}, "memory.limit_mb");
}

// systemd's side: a socket for its messages.
class NotifySocket {
 public:
  explicit NotifySocket(const std::string& path)
      : fd_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~NotifySocket() { (void)::close(fd_); }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  // Everything that has come since the last call.
  std::string messages() const {
    std::string all;
    char buffer[512];
    for (ssize_t got = 0; (got = ::recv(fd_, buffer, sizeof buffer, 0)) > 0;)
      all += std::string(buffer, static_cast<std::size_t>(got)) + "\n";
    return all;
  }

 private:
  int fd_;
};

TEST_F(RunCommand, SystemdIsToldAsLongAsTheLoopTurns) {
  if (is_emulated()) GTEST_SKIP() << "an emulated processor is too late for the limits of time";
  const std::string path = folder_.path("notify");
  const NotifySocket systemd(path);
  Words words{"/usr/bin/env", "NOTIFY_SOCKET=" + path, "WATCHDOG_USEC=1000000"};
  for (const std::string& word : run_words())
    words.push_back(word);
  ChildProcess firmware(words);
  ASSERT_TRUE(drives_soon(firmware));
  const std::string started = systemd.messages();
  EXPECT_NE(started.find("READY=1"), std::string::npos) << started;
  EXPECT_NE(started.find("STATUS=RUN"), std::string::npos) << started;
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_NE(systemd.messages().find("WATCHDOG=1"), std::string::npos);
  firmware.signal(SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  (void)systemd.messages();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(systemd.messages(), "") << "kicked by a program that hangs";
  firmware.signal(SIGCONT);
  firmware.signal(SIGTERM);
  EXPECT_EQ(firmware.wait(3000), 0);
  EXPECT_NE(systemd.messages().find("STOPPING=1"), std::string::npos);
}

// The emulated compass is on the vehicle whose wheels the emulated drives turn.
class CompassOnTheVehicle {
 public:
  CompassOnTheVehicle(emulator::QuickSilverLine& drives, emulator::OnTerminal& drive_line,
                      emulator::Os5000Device& compass, emulator::OnTerminal& compass_line)
      : thread_([&drives, &drive_line, &compass, &compass_line](const std::stop_token& stop) {
          constexpr double kMetresPerCount = 2 * 3.14159265 * 0.1 / 10 / 8000;
          constexpr double kTrack = 0.5;
          while (!stop.stop_requested()) {
            double turned = 0;
            {
              const auto lock = drive_line.locked();
              turned = drives.state(1, emulator::monotonic_ns()).position -
                       drives.state(0, emulator::monotonic_ns()).position;
            }
            {
              const auto lock = compass_line.locked();
              compass.heading_deg = std::fmod(720 - turned * kMetresPerCount / kTrack * 57.29578, 360);
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
          }
        }) {}

 private:
  std::jthread thread_;
};

// A thing stands half left: the wheels' counts show that the vehicle turns to the right of it.
TEST_F(RunCommand, ItDrivesAndAvoids) {
  if (is_emulated()) GTEST_SKIP() << "an emulated processor is too late for the limits of time";
  const CompassOnTheVehicle follows(drives_, drive_terminal_, compass_, compass_terminal_);
  ChildProcess firmware(run_words({"--frames", "60", "--out", folder_.path("out"), "--json"}));
  EXPECT_EQ(firmware.wait(20'000), 0) << firmware.err();
  const Json report = Json::parse(firmware.out());
  EXPECT_GE(report["frames"], 60);
  EXPECT_TRUE(report["faults"].empty()) << report["faults"];
  EXPECT_GT(report["state_s"]["RUN"], 1.0);
  EXPECT_LE(report["page_faults_after_ready"], 20);
  if (!report["allocations_after_ready"].is_null()) {
    EXPECT_EQ(report["allocations_after_ready"], 0);
  }
  EXPECT_EQ(report["devices"]["servo"]["timeouts"], 0);
  const auto lock = drive_terminal_.locked();
  const double left = drives_.state(0, emulator::monotonic_ns()).position;
  const double right = drives_.state(1, emulator::monotonic_ns()).position;
  EXPECT_GT(right, 1000) << "counts";
  EXPECT_GT(left, 1.1 * right);
}

}  // namespace
}  // namespace lakshya

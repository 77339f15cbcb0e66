#include "app/loop/status_line.h"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <sstream>

#include "hal/angle.h"

namespace lakshya {
namespace {

constexpr Nanoseconds kStart = 100 * kSecond;

StatusNote driving() {
  StatusNote s;
  s.time = kStart + 12'400 * kMillisecond;
  s.state = State::run;
  s.pose.east_m = 1.2;
  s.pose.north_m = -0.31;
  s.pose.yaw = 12 * kRadiansPerDegree;
  s.wheels = {.left_mps = 0.4, .right_mps = 0.5};
  s.blocked = false;
  s.direction = 5 * kRadiansPerDegree;
  s.clear_m = 3.2;
  s.nearest_m = 1.9;
  s.frames = 124;
  s.frame_time = 21'300'000;
  return s;
}

TEST(StatusText, SaysWhereTheVehicleIsAndWhatItDoes) {
  EXPECT_EQ(status_text(driving(), kStart),
            "RUN        12.4 s  at 1.20 -0.31 m, 12 deg  0.45 m/s  to +5 deg, clear 3.2 m  nearest 1.9 m  frame "
            "124 21.3 ms");
}

TEST(StatusText, SaysWhyItDoesNot) {
  StatusNote s = driving();
  s.state = State::stop;
  s.reason = Event::camera_silent;
  s.wheels = {};
  s.blocked = true;
  s.nearest_m = -1;
  EXPECT_EQ(status_text(s, kStart),
            "STOP       12.4 s  at 1.20 -0.31 m, 12 deg  0.00 m/s  no way open  nearest -  frame 124 21.3 ms  "
            "camera_silent");
}

TEST(NoteText, NamesAChangeOfState) {
  EXPECT_EQ(note_text({.time = kStart, .event = Event::camera_silent, .from = State::run, .to = State::stop}),
            "RUN -> STOP: camera_silent (no pair has come for safety.camera_silent_s)");
}

TEST(NoteText, NamesAFaultThatChangesNothing) {
  EXPECT_EQ(note_text({.time = kStart, .event = Event::tipping, .from = State::fault, .to = State::fault}),
            "FAULT: tipping (pitch or roll is greater than safety.tilt_deg)");
}

// What goes to the log while it lives.
class Log {
 public:
  Log() {
    auto sink = std::make_shared<spdlog::sinks::ostream_sink_st>(text_);
    auto logger = std::make_shared<spdlog::logger>("test", sink);
    logger->set_pattern("%l %v");
    spdlog::set_default_logger(logger);
  }
  ~Log() { spdlog::set_default_logger(before_); }
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;
  std::string text() const { return text_.str(); }
  std::ptrdiff_t lines() const { return std::ranges::count(text_.str(), '\n'); }

 private:
  std::shared_ptr<spdlog::logger> before_ = spdlog::default_logger();
  std::ostringstream text_;
};

TEST(StatusLine, WithoutATerminalThereIsALineEveryFiveSeconds) {
  const Log log;
  StatusLine line(false, kStart);
  StatusNote s = driving();
  for (int turn = 0; turn < 50 * 12; ++turn) {  // 12 s
    s.time = kStart + turn * 20 * kMillisecond;
    line.show(s);
  }
  EXPECT_EQ(log.lines(), 3);
  EXPECT_NE(log.text().find("info RUN         0.0 s"), std::string::npos) << log.text();
  EXPECT_NE(log.text().find("info RUN         5.0 s"), std::string::npos) << log.text();
  EXPECT_NE(log.text().find("info RUN        10.0 s"), std::string::npos) << log.text();
}

TEST(StatusLine, AFaultIsAWarningAndACourseIsNot) {
  const Log log;
  StatusLine line(false, kStart);
  line.log({.time = kStart + 1'500'000'000, .event = Event::go, .from = State::ready, .to = State::run});
  line.log({.time = kStart + 2'250'000'000, .event = Event::plan_old, .from = State::run, .to = State::stop});
  EXPECT_EQ(log.text(),
            "info 1.500 s: READY -> RUN: go (there is somewhere to go)\n"
            "warning 2.250 s: RUN -> STOP: plan_old (the plan is older than safety.plan_age_s)\n");
}

TEST(StatusLine, OnATerminalItIsWrittenOverTenTimesASecondAndGoneBeforeALogLine) {
  const Log log;
  testing::internal::CaptureStderr();
  {
    StatusLine line(true, kStart);
    StatusNote s = driving();
    for (int turn = 0; turn < 50; ++turn) {
      s.time = kStart + turn * 20 * kMillisecond;
      line.show(s);
    }
    line.log({.time = kStart, .event = Event::go, .from = State::ready, .to = State::run});
    line.log({.time = kStart, .event = Event::go, .from = State::ready, .to = State::run});
  }
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(log.lines(), 2);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  EXPECT_EQ(std::ranges::count(text, '\r'), 10 + 1);  // shown, and wiped once
  EXPECT_TRUE(text.ends_with("\r\033[K"));
}

}  // namespace
}  // namespace lakshya

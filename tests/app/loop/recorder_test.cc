#include "app/loop/recorder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "app/core/image_file.h"
#include "app/core/input_error.h"
#include "hal/angle.h"
#include "kernels/base/units.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr Nanoseconds kStart = 50 * kSecond;

Decision decision(std::uint64_t number = 7) {
  Decision d;
  PlanNote& p = d.plan;
  p.status = Status::ok;
  p.number = number;
  p.taken = kStart + 1'250'000'000;
  p.done = p.taken + 87'654'321;
  p.target = -30 * kRadiansPerDegree;
  p.blocked = false;
  p.recovery = Side::right;
  p.direction = 12.5 * kRadiansPerDegree;
  p.clear_m = 3.25;
  p.clear_end = ClearEnd::obstacle;
  p.speed_mps = 0.4375;
  p.ground_pitch_deg = -0.125;
  p.nearest_m = 1.875;
  p.obstacles = 42;
  d.time = kStart + 1'340'000'000;
  d.state = State::degraded;
  d.reason = Event::camera_damaged;
  d.pose.east_m = 1.5;
  d.pose.north_m = -2.25;
  d.pose.yaw = 90 * kRadiansPerDegree;
  d.wheels = {.left_mps = 0.25, .right_mps = -0.5};
  return d;
}

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string reason_of_refusal(const std::string& folder) {
  try {
    const Recorder recorder(folder, 1);
    return "";
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST(DecisionLine, IsJsonWithTheValuesOfPlanAndTurn) {
  const std::string line = decision_line(decision(), kStart);
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  const Json expected = Json::parse(R"({
      "frame": 7, "taken_s": 1.25, "time_s": 1.34, "latency_ms": 87.654, "status": "ok",
      "state": "DEGRADED", "reason": "camera_damaged", "target_deg": -30.0, "blocked": false,
      "direction_deg": 12.5, "recovery": "right", "clear_m": 3.25, "clear_end": "obstacle",
      "speed_mps": 0.4375, "nearest_m": 1.875, "obstacle_cells": 42, "ground_pitch_deg": -0.125,
      "pose": {"east_m": 1.5, "north_m": -2.25, "yaw_deg": 90.0}, "wheels": {"left_mps": 0.25, "right_mps": -0.5}})");
  EXPECT_EQ(Json::parse(line), expected) << line;
}

TEST(DecisionLine, OfWhatFailedSaysSo) {
  Decision d;
  d.plan.status = Status::size_mismatch;
  d.plan.number = std::numeric_limits<std::uint64_t>::max();
  const Json json = Json::parse(decision_line(d, kStart));
  EXPECT_EQ(json["status"], "size mismatch");
  EXPECT_EQ(json["frame"], std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(json["reason"], "");
  EXPECT_EQ(json["state"], "INIT");
  EXPECT_EQ(json["blocked"], true);
  EXPECT_EQ(json["recovery"], "left");
  EXPECT_EQ(json["clear_end"], "unknown");
  EXPECT_EQ(json["nearest_m"], -1);
}

TEST(DecisionLine, WhatIsNoNumberIsNull) {
  Decision d = decision();
  d.plan.clear_m = std::numeric_limits<double>::infinity();
  d.pose.yaw = std::numeric_limits<double>::quiet_NaN();
  d.wheels.left_mps = -std::numeric_limits<double>::infinity();
  const Json json = Json::parse(decision_line(d, kStart));
  EXPECT_TRUE(json["clear_m"].is_null());
  EXPECT_TRUE(json["pose"]["yaw_deg"].is_null());
  EXPECT_TRUE(json["wheels"]["left_mps"].is_null());
  EXPECT_EQ(json["wheels"]["right_mps"], -0.5);
}

TEST(Recorder, WithoutAFolderRecordsNothingAndNeverFails) {
  Recorder recorder("", 1);
  EXPECT_FALSE(recorder.is_on());
  EXPECT_FALSE(recorder.wants_picture(1));
  EXPECT_TRUE(recorder.write(decision(), kStart));
  EXPECT_TRUE(recorder.write_map({}, {}, {}));
  EXPECT_FALSE(recorder.has_failed());
}

TEST(Recorder, MakesTheFolderAndWritesALineForEveryDecision) {
  const TempFolder temp;
  const std::string folder = temp.path("a/b/run");
  std::string expected;
  Recorder recorder(folder, 0);
  for (std::uint64_t i = 1; i <= 3; ++i) {
    EXPECT_TRUE(recorder.write(decision(i), kStart));
    expected += decision_line(decision(i), kStart);
    EXPECT_EQ(content(folder + "/decisions.jsonl"), expected);  // at once, not at the end
  }
  EXPECT_FALSE(recorder.has_failed());
  EXPECT_EQ(recorder.folder(), folder);
}

TEST(Recorder, BeginsAnew) {
  const TempFolder temp;
  (void)temp.write("decisions.jsonl", std::string("of an earlier run\n"));
  Recorder recorder(temp.path("."), 0);
  EXPECT_TRUE(recorder.write(decision(), kStart));
  EXPECT_EQ(content(temp.path("decisions.jsonl")), decision_line(decision(), kStart));
}

TEST(Recorder, EveryNthPlanHasAPicture) {
  const TempFolder temp;
  const auto wanted = [&](std::uint64_t every) {
    Recorder recorder(temp.path("run"), every);
    const Image<std::uint8_t> map(4, 4, std::uint8_t{kCellUnknown});
    std::set<int> numbers;
    for (int number = 1; number <= 9; ++number) {
      PlanNote plan;
      plan.number = static_cast<std::uint64_t>(number);
      if (!recorder.wants_picture(plan.number)) continue;
      numbers.insert(number);
      EXPECT_TRUE(recorder.write_map(map.view(), plan, {}));
    }
    return numbers;
  };
  EXPECT_EQ(wanted(0), std::set<int>());
  EXPECT_EQ(wanted(1), (std::set<int>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(wanted(4), (std::set<int>{1, 5, 9}));
}

TEST(Recorder, AMapIsAPictureNamedByItsPlan) {
  const TempFolder temp;
  Recorder recorder(temp.path("run"), 1);
  const Image<std::uint8_t> type(60, 40, kCellUnoccupied);
  ASSERT_TRUE(recorder.write_map(type.view(), decision(12).plan, {})) << recorder.problem();
  const auto picture = read_gray(temp.path("run/map_000012.png"));
  EXPECT_EQ(picture.width(), 60 * 15);
  EXPECT_EQ(picture.height(), 40 * 15);
}

TEST(Recorder, AFolderThatCannotBeMadeIsRefused) {
  const TempFolder temp;
  const std::string file = temp.write("file", std::string("no folder"));
  for (const std::string& folder : {file, file + "/run", std::string("/proc/no/run")}) {
    const std::string message = reason_of_refusal(folder);
    EXPECT_EQ(message.find(folder + ": cannot be made: "), 0U) << message;
    EXPECT_NE(message.find("--out"), std::string::npos) << message;
  }
}

TEST(Recorder, AFolderThatCannotBeWrittenIsRefused) {
  const TempFolder temp;
  fs::create_directory(temp.path("decisions.jsonl"));
  const std::string message = reason_of_refusal(temp.path("."));
  EXPECT_NE(message.find("decisions.jsonl: cannot be written: Is a directory"), std::string::npos) << message;
}

TEST(Recorder, AFullDiskIsReportedAndNothingMoreIsWritten) {
  if (!fs::exists("/dev/full")) GTEST_SKIP();
  const TempFolder temp;
  fs::create_symlink("/dev/full", temp.path("decisions.jsonl"));
  Recorder recorder(temp.path("."), 1);
  EXPECT_FALSE(recorder.write(decision(), kStart));
  EXPECT_TRUE(recorder.has_failed());
  EXPECT_EQ(recorder.problem(), temp.path(".") + "/decisions.jsonl: No space left on device");
  const Image<std::uint8_t> type(60, 40, kCellUnoccupied);
  EXPECT_FALSE(recorder.write_map(type.view(), decision().plan, {}));
  EXPECT_FALSE(recorder.write(decision(), kStart));
  EXPECT_FALSE(fs::exists(temp.path("map_000007.png")));
  EXPECT_EQ(recorder.problem(), temp.path(".") + "/decisions.jsonl: No space left on device");
}

TEST(Recorder, AMapThatCannotBeWrittenIsAFailure) {
  const TempFolder temp;
  Recorder recorder(temp.path("run"), 1);
  fs::create_directories(temp.path("run/map_000007.png/in the way"));
  const Image<std::uint8_t> type(60, 40, kCellUnoccupied);
  EXPECT_FALSE(recorder.write_map(type.view(), decision().plan, {}));
  EXPECT_TRUE(recorder.has_failed());
  EXPECT_NE(recorder.problem().find("map_000007.png"), std::string::npos) << recorder.problem();
  EXPECT_FALSE(recorder.write(decision(), kStart));
}

// The file may grow to two lines and a half, then writing fails in the middle of a line. Returns a number for what was wrong.
int fill_up(const std::string& folder, std::size_t limit) {
  const rlimit size{.rlim_cur = limit, .rlim_max = limit};
  if (std::signal(SIGXFSZ, SIG_IGN) == SIG_ERR || ::setrlimit(RLIMIT_FSIZE, &size) != 0) return 1;
  Recorder recorder(folder, 1);
  if (!recorder.write(decision(), kStart) || !recorder.write(decision(), kStart)) return 2;
  if (recorder.write(decision(), kStart)) return 3;
  if (!recorder.has_failed() || recorder.problem().empty()) return 4;
  if (recorder.write(decision(), kStart)) return 5;
  return 0;
}

TEST(Recorder, AFailedWriteLeavesNoHalfLine) {
  const TempFolder temp;
  const std::string line = decision_line(decision(), kStart);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) ::_exit(fill_up(temp.path("run"), 2 * line.size() + line.size() / 2));
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(content(temp.path("run/decisions.jsonl")), line + line);
}

}  // namespace
}  // namespace lakshya

// `lakshyad replay` as a user starts it.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/emulated.h"
#include "tests/support/recorded_run.h"

namespace lakshya {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;
using test::RecordedRun;

class ReplayCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (lakshyad_binary().empty()) GTEST_SKIP() << "LAKSHYAD_BIN names no lakshyad";
  }

  static Outcome replay(const std::string& source, Words more = {}, const std::string& threads = "") {
    Words words{"/usr/bin/env"};
    if (!threads.empty()) words.push_back("OMP_NUM_THREADS=" + threads);
    words.insert(words.end(), {lakshyad_binary(), "replay", source, "--json", "--set", "camera.height_m=0.6",
                               "--set", "matcher.disparities=32"});
    words.insert(words.end(), more.begin(), more.end());
    return run_command(words);
  }

  static std::vector<Json> lines_of(const std::string& path) {
    std::vector<Json> lines;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);)
      lines.push_back(Json::parse(line));
    return lines;
  }

  TempFolder folder_;
};

TEST_F(ReplayCommand, EveryFrameIsProcessedAndReported) {
  const RecordedRun run(24, 160, 120);
  const std::string out = folder_.path("out");
  const Outcome o = replay(run.path(), {"--out", out, "--report", out + "/report.json", "--picture-every", "10"});
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json report = Json::parse(o.out);
  EXPECT_EQ(report, Json::parse(bytes_of(out + "/report.json")));
  EXPECT_EQ(o.err.find("warning"), std::string::npos) << o.err;
  EXPECT_EQ(report["frames"], 24);
  EXPECT_EQ(report["dropped"], 0);
  EXPECT_EQ(report["overruns"], 0);
  EXPECT_EQ(report["clock"], "virtual");
  EXPECT_GT(report["arena_bytes"], 100'000);
  EXPECT_GT(report["rss_bytes"], 1'000'000);
  EXPECT_TRUE(report["faults"].empty()) << report["faults"];
  EXPECT_GT(report["stages_ms"]["match"]["p50"], 0);
  EXPECT_GE(report["stages_ms"]["match"]["max"], report["stages_ms"]["match"]["p99"]);
  // 24 pairs at 10 a second: INIT for half a second, then READY and at once RUN to the end.
  std::vector<std::string> states;
  for (const Json& change : report["states"])
    states.push_back(change["state"]);
  EXPECT_EQ(states, (std::vector<std::string>{"INIT", "READY", "RUN", "END"}));
  EXPECT_NEAR(report["state_s"]["RUN"].get<double>(), 1.8, 0.15);

  const std::vector<Json> lines = lines_of(out + "/decisions.jsonl");
  ASSERT_EQ(lines.size(), 24U);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_EQ(lines[i]["frame"], i + 1);
    EXPECT_EQ(lines[i]["status"], "ok");
    EXPECT_NEAR(lines[i]["taken_s"].get<double>(), 0.1 * static_cast<double>(i), 1e-6);
    EXPECT_NEAR(lines[i]["latency_ms"].get<double>(), 100, 1e-6);
  }
  EXPECT_EQ(lines.back()["state"], "RUN");
  EXPECT_GT(lines.back()["wheels"]["left_mps"], 0.2);
  for (const char* picture : {"map_000001.png", "map_000011.png", "map_000021.png"})
    EXPECT_TRUE(std::filesystem::exists(out + "/" + picture)) << picture;
  EXPECT_FALSE(std::filesystem::exists(out + "/map_000002.png"));
}

TEST_F(ReplayCommand, ABoxIsPassedAndAWallStopsTheVehicle) {
  const auto last_line = [&](const test::StandingThing& thing) {
    const RecordedRun run(60, 160, 120, thing);
    const Outcome o =
        replay(run.path(), {"--out", folder_.path("out"), "--picture-every", "0", "--profile", "indoor"});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    return lines_of(folder_.path("out") + "/decisions.jsonl").back();
  };
  const Json right_of_it = last_line({.first = 20, .left_column = 45, .right_column = 90});
  EXPECT_LT(right_of_it["direction_deg"], -8) << right_of_it;
  EXPECT_GT(right_of_it["wheels"]["left_mps"], right_of_it["wheels"]["right_mps"].get<double>() + 0.05);
  EXPECT_NEAR(right_of_it["nearest_m"].get<double>(), 2.0, 0.15);
  const Json left_of_it = last_line({.first = 20, .left_column = 70, .right_column = 115});
  EXPECT_GT(left_of_it["direction_deg"], 8) << left_of_it;
  const Json wall = last_line({.first = 20, .left_column = 0, .right_column = 160});
  EXPECT_NEAR(wall["wheels"]["left_mps"].get<double>() + wall["wheels"]["right_mps"].get<double>(), 0, 1e-9)
      << wall;
  EXPECT_LT(wall["clear_m"], 2.1);
}

TEST_F(ReplayCommand, TheResultIsTheSameOnAnyNumberOfThreads) {
  const RecordedRun run(20, 320, 240);
  for (const char* threads : {"1", "2", "3"}) {
    const Outcome o = replay(run.path(), {"--out", folder_.path(threads), "--picture-every", "5"}, threads);
    ASSERT_EQ(o.exit_code, 0) << o.err;
    EXPECT_EQ(bytes_of(folder_.path(threads) + "/decisions.jsonl"),
              bytes_of(folder_.path("1") + "/decisions.jsonl"));
    EXPECT_EQ(bytes_of(folder_.path(threads) + "/map_000016.png"), bytes_of(folder_.path("1") + "/map_000016.png"));
  }
  EXPECT_GT(bytes_of(folder_.path("1") + "/decisions.jsonl").size(), 5000U);
}

TEST_F(ReplayCommand, NothingIsAllocatedInAThousandFrames) {
  const RecordedRun run(10, 160, 120);
  const Outcome o = replay(run.path(), {"--frames", "1000"});
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json report = Json::parse(o.out);
  EXPECT_EQ(report["frames"], 1000);
  if (report["allocations_after_ready"].is_null()) GTEST_SKIP() << "a sanitizer's malloc is not counted";
  EXPECT_EQ(report["allocations_after_ready"], 0);
  EXPECT_GT(report["allocations_decoding"], 1000) << "nobody counts";
  EXPECT_LE(report["page_faults_after_ready"], 2);
}

TEST_F(ReplayCommand, MemoryAtVgaIsWithinItsPromise) {
  const RecordedRun run(5, 640, 480);
  const Outcome o = run_command({lakshyad_binary(), "replay", run.path(), "--json", "--frames", "10"});
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json report = Json::parse(o.out);
  EXPECT_LT(report["arena_bytes"], 24'000'000);
  if (report["allocations_after_ready"].is_null()) GTEST_SKIP() << "a sanitizer's memory is not the program's";
  EXPECT_LT(report["rss_peak_bytes"], 64'000'000);
}

TEST_F(ReplayCommand, FaultsInTheRecordingStopTheVehicle) {
  const RecordedRun run(40, 160, 120);
  for (const int n : {12, 13})
    run.cover(n, 0);
  for (const int n : {24, 25})
    run.cover(n, 255);
  run.freeze(34);
  const std::string out = folder_.path("out");
  const Outcome o = replay(run.path(), {"--out", out});
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json report = Json::parse(o.out);
  EXPECT_EQ(report["faults"]["camera_dark"], 1);
  EXPECT_EQ(report["faults"]["camera_bright"], 1);
  EXPECT_EQ(report["faults"]["camera_frozen"], 1);
  // Covered pairs arrive at 1.2 s: zero no later than two control turns after that; driving again 0.5 s after the last one.
  for (const Json& line : lines_of(out + "/decisions.jsonl")) {
    const double t = line["time_s"];
    if (t > 1.25 && t < 1.75) {
      EXPECT_EQ(line["wheels"]["left_mps"], 0) << line;
    } else if (t > 2.2 && t < 2.4) {
      EXPECT_GT(line["wheels"]["left_mps"], 0) << line;
    }
  }
}

TEST_F(ReplayCommand, WhatCannotBeginIsRefusedAndLeavesNothing) {
  const RecordedRun run(3, 160, 120);
  const std::string out = folder_.path("out");
  const std::string report = folder_.path("report.json");
  const auto refused = [&](const std::string& source, Words more, const std::string& why, int code = 1) {
    more.insert(more.end(), {"--out", out, "--report", report});
    const Outcome o = replay(source, more);
    EXPECT_EQ(o.exit_code, code) << o.err;
    EXPECT_NE(o.err.find(why), std::string::npos) << o.err;
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_FALSE(std::filesystem::exists(report));
  };
  refused(folder_.path("nothing"), {}, "nothing");
  refused(run.path(), {"--set", "memory.limit_mb=1"}, "memory.limit_mb: 1: the main loop needs");
  refused(run.path(), {"--rate", "fast"}, "neither max nor real", 2);
  refused(run.path(), {"--way-points", folder_.path("none.csv")}, "none.csv");
  refused(run.path(), {"--calib", run.path() + "/left"}, "left");
  std::filesystem::remove(run.name("right", 1));
  refused(run.path(), {}, "right");
  // A folder that cannot be made is found before the first frame.
  const Outcome o = replay(RecordedRun(3, 160, 120).path(), {"--out", "/proc/no/such"});
  EXPECT_EQ(o.exit_code, 1) << o.err;
  EXPECT_NE(o.err.find("/proc/no/such"), std::string::npos);
}

TEST_F(ReplayCommand, InRealTimeItKeepsTheRecordingsPace) {
  if (is_emulated()) GTEST_SKIP() << "an emulated processor keeps no pace";
  const RecordedRun run(20, 160, 120);
  const Outcome o = replay(run.path(), {"--rate", "20"});
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Json report = Json::parse(o.out);
  EXPECT_EQ(report["clock"], "real");
  EXPECT_NEAR(report["wall_s"].get<double>(), 1.1, 0.5);
  EXPECT_GE(report["frames"], 15);
  EXPECT_GT(report["control"]["turns"], 40);
}

}  // namespace
}  // namespace lakshya

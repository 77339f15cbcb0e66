// `lakshya profile`: what it counts, what it prints, and that measuring costs next to nothing.
#include "app/tools/profile_command.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/core/image_file.h"
#include "app/tools/profile_report.h"
#include "app/tools/profile_run.h"
#include "app/tools/profile_trace.h"
#include "hal/clock/monotonic_clock.h"
#include "tests/support/count_allocations.h"
#include "tests/support/run_command.h"
#include "tests/support/stereo_pair.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Words = std::vector<std::string>;
using test::StereoRig;

constexpr double kPixels = StereoRig::kWidth * StereoRig::kHeight;

StereoCalibration rig() {
  StereoCalibration c;
  c.width = StereoRig::kWidth;
  c.height = StereoRig::kHeight;
  c.left = {.fx = 100, .fy = 100, .cx = 79.5, .cy = 59.5};
  c.right = c.left;
  c.T = {-0.1, 0, 0};
  c.images_rectified = true;
  return c;
}

// A floor below the horizon, a wall above it.
test::StereoPair scene() {
  return test::textured_pair([](int v) { return std::max(4, (v - 60) / 6); });
}

class ProfileRunTest : public ::testing::Test {
 protected:
  void frames(ProfileRun& run, int n) {
    for (int i = 0; i < n; ++i)
      ASSERT_EQ(run.frame(pipeline_, pair_.left.view(), pair_.right.view()), Status::ok);
  }

  MonotonicClock clock_;
  test::StereoPair pair_ = scene();
  Pipeline pipeline_{VehicleConfig{}, rig(), StereoRig::kWidth, StereoRig::kHeight, kSimdKernels, clock_};
};

TEST_F(ProfileRunTest, NoPixelIsLostOnItsWayIntoTheMap) {
  ProfileRun run(0);
  frames(run, 3);
  const ProfileCounts& counts = run.counts();
  EXPECT_EQ(counts.frames, 3U);
  const std::vector<PruningStep> steps = pruning_steps(counts);
  EXPECT_EQ(steps.front().in, static_cast<std::uint64_t>(3 * kPixels));
  for (std::size_t i = 1; i < steps.size(); ++i)
    EXPECT_EQ(steps[i].in, steps[i - 1].out) << steps[i].name;
  for (const PruningStep& step : steps)
    EXPECT_LE(step.out, step.in) << step.name;
  EXPECT_EQ(steps.back().out, counts.points_in_map);
  EXPECT_GT(counts.points_in_map, 1000U);
  EXPECT_EQ(counts.cells[0] + counts.cells[1] + counts.cells[2], 3U * 200 * 200);
  EXPECT_TRUE(run.trace().empty());
}

TEST_F(ProfileRunTest, MeasuringAllocatesNothing) {
  ProfileRun run(4);
  frames(run, 1);  // OpenMP makes its threads
  const int before = test::allocations;
  frames(run, 4);  // one more than the trace has room for
  EXPECT_EQ(test::allocations, before);
  EXPECT_EQ(run.trace().size(), 4U);
  EXPECT_EQ(pipeline_.times().frame().count(), 5U);
  pipeline_.clear_times();
  EXPECT_EQ(pipeline_.times().frame().count(), 0U);
}

TEST_F(ProfileRunTest, StagesFillTheFrameAndPassesTheMatching) {
  ProfileRun run(2);
  frames(run, 2);
  for (const FrameTimes& f : run.trace()) {
    for (std::size_t i = 1; i < f.begin.size(); ++i)
      EXPECT_GE(f.begin[i], f.begin[i - 1] + f.took[i - 1]);
    const auto match = static_cast<std::size_t>(Stage::match);
    EXPECT_GE(f.match.at.front(), f.begin[match]);
    EXPECT_LE(f.match.at.back(), f.begin[match] + f.took[match]);
    for (int p = 0; p < kMatchPasses; ++p)
      EXPECT_GT(f.pass(static_cast<MatchPass>(p)), 0);
  }
}

TEST_F(ProfileRunTest, AFrameThatFailsIsNotCounted) {
  ProfileRun run(1);
  EXPECT_EQ(run.frame(pipeline_, {}, {}), Status::size_mismatch);
  EXPECT_EQ(run.counts().frames, 0U);
  EXPECT_EQ(pipeline_.times().frame().count(), 0U);
}

// Even of this small frame.
TEST_F(ProfileRunTest, MeasuringCostsLessThanOnePercent) {
  ProfileRun run(0);
  frames(run, 5);
  EXPECT_LT(100 * measuring_cost(clock_), pipeline_.times().frame().quantile(500));
}

// What a viewer relies on: events of one thread lie one after the other or one inside the other.
void expect_nested(const Json& events) {
  constexpr double kTick = 0.0005;  // half a nanosecond, in microseconds
  std::vector<double> open_ends;
  double last_begin = 0;
  for (const Json& e : events) {
    const double begin = e["ts"];
    const double end = begin + e["dur"].get<double>();
    ASSERT_GE(begin, last_begin) << e;  // as they are written; the format does not ask for it
    last_begin = begin;
    while (!open_ends.empty() && open_ends.back() <= begin + kTick)
      open_ends.pop_back();
    if (!open_ends.empty()) {
      EXPECT_LE(end, open_ends.back() + kTick) << e;
    }
    open_ends.push_back(end);
  }
}

void expect_trace(const Json& trace, int frames) {
  EXPECT_EQ(trace["displayTimeUnit"], "ms");
  Json complete = Json::array();
  std::map<std::string, int> names;
  for (const Json& e : trace["traceEvents"]) {
    ASSERT_TRUE(e["name"].is_string() && e["pid"].is_number_integer() && e["tid"].is_number_integer()) << e;
    if (e["ph"] == "M") {
      EXPECT_TRUE(e["args"]["name"].is_string()) << e;
      continue;
    }
    ASSERT_EQ(e["ph"], "X") << e;
    ASSERT_TRUE(e["ts"].is_number() && e["dur"].is_number()) << e;
    EXPECT_GE(e["ts"], 0) << e;
    EXPECT_GE(e["dur"], 0) << e;
    ++names[e["name"]];
    complete.push_back(e);
  }
  const std::map<std::string, int> wanted{
      {"frame", frames},  {"rectify", frames},  {"match", frames},  {"describe", frames},
      {"search", frames}, {"support", frames},  {"ground", frames}, {"project_and_bin", frames},
      {"score", frames},  {"remember", frames}, {"plan", frames}};
  EXPECT_EQ(names, wanted);
  expect_nested(complete);
}

TEST_F(ProfileRunTest, TheTraceNestsStagesInFrames) {
  ProfileRun run(3);
  frames(run, 3);
  expect_trace(Json::parse(trace_json(run.trace())), 3);
  EXPECT_EQ(Json::parse(trace_json({}))["traceEvents"].size(), 2U);  // names only
}

TEST(ProfileTrace, NanosecondsAreKept) {
  FrameTimes f;
  const Nanoseconds start = 9'007'199'254'740'993;  // more than a double holds
  f.begin = {start,
             start + 11,
             start + 2'000'011,
             start + 2'000'012,
             start + 2'000'013,
             start + 2'000'014,
             start + 2'000'015};
  f.took = {10, 2'000'000, 1, 1, 1, 1, 1};
  f.match.at = {start + 12, start + 1'000'012, start + 1'000'013, start + 2'000'011};
  const Json events = Json::parse(trace_json(std::span(&f, 1)))["traceEvents"];
  EXPECT_EQ(
      events[2].dump(),
      R"({"args":{"frame":0},"cat":"frame","dur":2000.016,"name":"frame","ph":"X","pid":1,"tid":1,"ts":0.0})");
  EXPECT_EQ(events[4]["ts"], 0.011);
  EXPECT_EQ(events[5]["dur"], 1000.0);
  expect_trace({{"traceEvents", events}, {"displayTimeUnit", "ms"}}, 1);
}

class ProfileCommandTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (lakshya_binary().empty()) GTEST_SKIP() << "LAKSHYA_BIN names no lakshya";
    for (const char* folder : {"seq", "seq/left", "seq/right"})
      fs::create_directories(folder_.path(folder));
    for (const char* name : {"0.png", "1.png", "2.png"}) {
      const test::StereoPair pair = scene();
      write_png(folder_.path("seq/left/") + name, pair.left.view());
      write_png(folder_.path("seq/right/") + name, pair.right.view());
    }
    folder_.write("seq/calib.txt", StereoRig::middlebury());
  }

  Outcome profile(const Words& more) const {
    Words words{lakshya_binary(), "profile"};
    words.insert(words.end(), more.begin(), more.end());
    return run_command(words);
  }

  Words pair() const {
    return {"--left",  folder_.path("seq/left/0.png"), "--right", folder_.path("seq/right/0.png"),
            "--calib", folder_.path("seq/calib.txt")};
  }

  TempFolder folder_;
};

TEST_F(ProfileCommandTest, PrintsWhatItPromises) {
  Words words = pair();
  for (const char* word : {"--frames", "4", "--threads", "1", "--json", "--trace"})
    words.emplace_back(word);
  words.push_back(folder_.path("trace.json"));
  const Outcome outcome = profile(words);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["frames"], 4);
  EXPECT_EQ(json["threads"], 1);
  EXPECT_EQ(json["backend"], "simd");
  EXPECT_FALSE(json["isa"].get<std::string>().empty());
  EXPECT_GT(json["arena_bytes"], 100'000);
  ASSERT_EQ(json["stages"].size(), 11U);
  EXPECT_EQ(json["stages"][0]["stage"], "frame");
  EXPECT_EQ(json["stages"][0]["share"], 1.0);
  double stages = 0;
  double passes = 0;
  for (const Json& stage : json["stages"]) {
    EXPECT_LE(stage["p50_ms"], stage["p99_ms"]) << stage;
    EXPECT_LE(stage["p99_ms"], stage["max_ms"]) << stage;
    if (stage.contains("of")) {
      EXPECT_EQ(stage["of"], "match");
      passes += stage["share"].get<double>();
    } else if (stage["stage"] != "frame") {
      stages += stage["share"].get<double>();
    }
  }
  EXPECT_NEAR(stages, 1, 0.01);
  EXPECT_LE(passes, json["stages"][2]["share"].get<double>() + 1e-5);
  EXPECT_EQ(json["pruning"][0]["step"], "no_disparity");
  EXPECT_EQ(json["pruning"][0]["in"], kPixels);
  EXPECT_EQ(json["cells"]["obstacle"].get<double>() + json["cells"]["unoccupied"].get<double>() +
                json["cells"]["unknown"].get<double>(),
            200 * 200);
  EXPECT_LT(json["measuring"]["share"], 0.01);
  expect_trace(Json::parse(bytes_of(folder_.path("trace.json"))), 4);
}

TEST_F(ProfileCommandTest, AFoldersFramesAreTakenInTurn) {
  // The last pair has another size: it is reached by the third frame.
  const Words sequence{"--sequence", folder_.path("seq"), "--frames", "7"};
  const Outcome all = profile(sequence);
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_NE(all.out.find("; 7 frames; "), std::string::npos) << all.out;
  EXPECT_NE(all.out.find("\nmeasuring costs "), std::string::npos) << all.out;
  const Image<std::uint8_t> other(64, 64);
  write_png(folder_.path("seq/left/2.png"), other.view());
  write_png(folder_.path("seq/right/2.png"), other.view());
  const Outcome third = profile(sequence);
  EXPECT_EQ(third.exit_code, 1);
  EXPECT_NE(third.err.find("seq/left/2.png"), std::string::npos) << third.err;
  EXPECT_EQ(profile({"--sequence", folder_.path("seq"), "--frames", "2"}).exit_code, 0);
  EXPECT_EQ(profile({"--sequence", folder_.path("seq"), "--frames", "2", "--frame", "3"}).exit_code, 1);
}

TEST_F(ProfileCommandTest, RefusesWhatItCannotDo) {
  for (const Words& wrong : {Words{"--frames", "0"}, Words{"--threads", "0"}}) {
    Words words = pair();
    words.insert(words.end(), wrong.begin(), wrong.end());
    EXPECT_EQ(profile(words).exit_code, 2) << wrong[0];
  }
  EXPECT_EQ(profile({}).exit_code, 2);
  Words words = pair();
  words.emplace_back("--isa");
  words.emplace_back("mmx");
  EXPECT_EQ(profile(words).exit_code, 1);
}

}  // namespace
}  // namespace lakshya

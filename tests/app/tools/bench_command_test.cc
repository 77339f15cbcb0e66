// `lakshya bench` as a user starts it, on small images: what it prints, not how fast it is.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/core/image_file.h"
#include "tests/support/run_command.h"

namespace lakshya {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

class BenchCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (lakshya_binary().empty()) GTEST_SKIP() << "LAKSHYA_BIN names no command";
  }

  static Outcome bench(const Words& more) {
    Words words{lakshya_binary(), "bench", "--size", "160x120", "--disparities", "32", "--runs", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return run_command(words);
  }

  static void expect_refused(const Words& words, int exit_code, const std::string& part) {
    Words all{lakshya_binary(), "bench", "--runs", "1"};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = run_command(all);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }

  TempFolder folder_;
};

TEST_F(BenchCommand, EveryRowHasATimeAndAPeerOrNone) {
  const Outcome outcome = bench({"--json", "--ref-runs", "1"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["width"], 160);
  EXPECT_EQ(json["height"], 120);
  EXPECT_EQ(json["disparities"], 32);
  EXPECT_EQ(json["threads"], 1);
  EXPECT_FALSE(json["isa"].get<std::string>().empty());
  EXPECT_FALSE(json["opencv"]["baseline"].get<std::string>().empty());
  const Words names{"rectify", "sad", "census", "sgm", "sgm_vs_bm", "ground", "project_and_bin", "frame"};
  ASSERT_EQ(json["rows"].size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Json& row = json["rows"][i];
    EXPECT_EQ(row["name"], names[i]);
    EXPECT_GT(row["ms"], 0.0) << names[i];
    EXPECT_GT(row["ref_ms"], 0.0) << names[i];
    if (names[i] == "ground") {
      EXPECT_TRUE(row["peer"].is_null() && row["peer_ms"].is_null() && row["speedup"].is_null());
      continue;
    }
    EXPECT_FALSE(row["peer"].get<std::string>().empty());
    const double speedup = row["peer_ms"].get<double>() / row["ms"].get<double>();
    EXPECT_NEAR(row["speedup"].get<double>(), speedup, 0.01 + 0.02 * speedup) << names[i];
  }
}

// A matcher that finds nothing would be measured on nothing: the made-up scene is one that it can match.
TEST_F(BenchCommand, TheMadeUpSceneIsMatchedAndHasFloorAndObstacles) {
  const Outcome outcome = run_command({lakshya_binary(), "bench", "--size", "320x240", "--json", "--runs", "1",
                                       "--ref-runs", "0", "--rows", "ground"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_GT(json["density"], 0.75);
  EXPECT_GT(json["floor_share"], 0.2);
  EXPECT_GT(json["obstacle_share"], 0.1);
  ASSERT_EQ(json["rows"].size(), 1U);
  EXPECT_TRUE(json["rows"][0]["ref_ms"].is_null());
}

TEST_F(BenchCommand, ARealPairIsCroppedShiftedAndScaled) {
  Image<std::uint8_t> left(300, 200);
  Image<std::uint8_t> right(300, 200);
  for (int v = 0; v < 200; ++v) {
    for (int u = 0; u < 300; ++u) {
      const auto gray = [&](int x) { return static_cast<std::uint8_t>((x * x / 7 + 13 * v + x * v / 5) % 251); };
      left.view().at(u, v) = gray(u);
      right.view().at(u, v) = gray(u + 20);
    }
  }
  write_png(folder_.path("left.png"), std::as_const(left).view());
  write_png(folder_.path("right.png"), std::as_const(right).view());
  const Words pair{"--left", folder_.path("left.png"), "--right", folder_.path("right.png")};
  Words shifted = pair;
  shifted.insert(shifted.end(), {"--shift", "10", "--rows", "frame", "--ref-runs", "0"});
  const Outcome outcome = bench(shifted);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("160x120, 32 disparities, 1 thread"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("frame "), std::string::npos) << outcome.out;

  shifted[5] = "200";
  shifted.insert(shifted.begin(), {"--size", "160x120"});
  expect_refused(shifted, 1, "shift 200");
  expect_refused({"--left", folder_.path("left.png"), "--right", folder_.path("none.png")}, 1, "none.png");
}

TEST_F(BenchCommand, RefusesWhatCannotBeMeasured) {
  for (const char* size : {"640", "640x", "x480", "640x480x2", "640*480", "+640x480", "640 x480"})
    expect_refused({std::string("--size=") + size}, 1, "is no size");
  expect_refused({"--size", "32x480"}, 1, "64 to 4096");
  expect_refused({"--size=-640x480"}, 1, "64 to 4096");
  expect_refused({"--size", "640x5000"}, 1, "64 to 4096");
  expect_refused({"--size", "64x64", "--disparities", "64"}, 1, "do not fit");
  expect_refused({"--threads", "0"}, 1, "--threads");
  expect_refused({"--threads", "100000"}, 1, "this machine has");
  expect_refused({"--threads", "2", "--thread-time"}, 1, "one thread only");
  expect_refused({"--isa", "mmx"}, 1, "'mmx' is not to be had here");
  expect_refused({"--backend", "gpu"}, 1, "there is no backend 'gpu'");
  expect_refused({"--set", "matcher.paths=4"}, 1, "matcher.paths");
  expect_refused({"--rows", "everything"}, 2, "--rows");
  expect_refused({"--disparities", "0"}, 2, "--disparities");
  expect_refused({"--left", "a.png"}, 2, "--right");
}

}  // namespace
}  // namespace lakshya

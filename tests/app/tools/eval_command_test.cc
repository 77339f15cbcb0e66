// `lakshya eval` and `lakshya accuracy` as a user starts them, on a pair whose disparity is known by construction.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/core/image_file.h"
#include "tests/support/run_command.h"
#include "tests/support/stereo_pair.h"

namespace lakshya {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;
using test::StereoRig;

class EvalCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (lakshya_binary().empty()) GTEST_SKIP() << "LAKSHYA_BIN names no command";
    const test::StereoPair pair = test::textured_pair([](int) { return 8; });
    write_png(left_, pair.left.view());
    write_png(right_, pair.right.view());
    const Image<std::uint16_t> truth(StereoRig::kWidth, StereoRig::kHeight, 8 * 256);
    write_png(truth_, truth.view());
  }

  Outcome eval(const Words& more) const {
    Words words{lakshya_binary(), "eval", "--left", left_,           "--right",
                right_,           "--gt", truth_,   "--disparities", "17"};
    words.insert(words.end(), more.begin(), more.end());
    return run_command(words);
  }

  TempFolder folder_;
  std::string left_ = folder_.path("left.png");
  std::string right_ = folder_.path("right.png");
  std::string truth_ = folder_.path("truth.png");
};

TEST_F(EvalCommand, EveryMatcherOfOursAndOfOpenCvFindsAKnownShift) {
  const Outcome outcome =
      eval({"--gt-format", "kitti", "--against", "opencv-bm,opencv-sgbm,opencv-sgbm-3way", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["disparities"], 32);  // rounded up
  ASSERT_EQ(json["results"].size(), 6U);
  const Words names{"sgm", "census", "sad", "opencv-bm", "opencv-sgbm", "opencv-sgbm-3way"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Json& row = json["results"][i];
    EXPECT_EQ(row["matcher"], names[i]);
    EXPECT_EQ(row["gt_pixels"], (StereoRig::kWidth - 32) * StereoRig::kHeight);
    EXPECT_EQ(row["full_gt_pixels"], StereoRig::kWidth * StereoRig::kHeight);
    EXPECT_GT(row["density"], 0.75) << names[i];
    EXPECT_EQ(row["bad1"], 0) << names[i];
    EXPECT_LT(row["avg_err"], 0.1) << names[i];
    EXPECT_NEAR(row["wrong_or_missing2"].get<double>(), 1 - row["density"].get<double>(), 2e-6);
    EXPECT_FALSE(row["parameters"].get<std::string>().empty());
  }
  EXPECT_GT(json["results"][0]["density"], 0.98);
}

TEST_F(EvalCommand, AWrongScaleShowsAsErrors) {
  const Outcome outcome = eval({"--gt-format", "scaled:128", "--matcher", "sgm", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json row = Json::parse(outcome.out)["results"][0];
  EXPECT_EQ(row["bad4"], 1);
  EXPECT_NEAR(row["avg_err"].get<double>(), 8, 0.1);
}

TEST_F(EvalCommand, RefusesWithFileAndReason) {
  Image<std::uint8_t> small(10, 10);
  write_png(folder_.path("small.png"), std::as_const(small).view());
  const auto refused = [&](const Words& more, const std::string& part) {
    const Outcome outcome = eval(more);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  };
  refused({"--gt-format", "kitti", "--mask", folder_.path("small.png")}, "small.png: mask size: 10x10 differs");
  refused({"--gt-format", "pfm"}, "truth.png: pfm: does not start with Pf");
  refused({"--gt-format", "kitti", "--min-disparity", "1000"}, "search range");
  EXPECT_EQ(eval({"--gt-format", "other"}).exit_code, 2);
  EXPECT_EQ(eval({"--gt-format", "kitti", "--matcher", "none"}).exit_code, 2);
  EXPECT_EQ(eval({"--gt-format", "kitti", "--against", "opencv"}).exit_code, 2);
}

TEST_F(EvalCommand, AccuracyWritesTableJsonAndPictures) {
  folder_.write(
      "pairs.json",
      std::string(
          R"([{"name":"a","left":"left.png","right":"right.png","gt":"truth.png","gt_format":"kitti","disparities":16},
                    {"name":"b","left":"left.png","right":"right.png","gt":"truth.png","gt_format":"kitti","disparities":32}])"));
  const std::string out = folder_.path("out");
  const Outcome outcome =
      run_command({lakshya_binary(), "accuracy", "--pairs", folder_.path("pairs.json"), "--data", folder_.path("."),
                   "--out", out, "--matcher", "sgm,sad", "--against", "opencv-bm"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(bytes_of(out + "/accuracy.json"));
  ASSERT_EQ(json["mean"].size(), 3U);
  ASSERT_EQ(json["pairs"].size(), 2U);
  const double a = json["pairs"][0]["results"][1]["density"];
  const double b = json["pairs"][1]["results"][1]["density"];
  EXPECT_NEAR(json["mean"][1]["density"].get<double>(), (a + b) / 2, 1e-6);
  EXPECT_NE(bytes_of(out + "/accuracy.md").find("| sad |"), std::string::npos);
  for (const char* picture : {"/density_bad2.png", "/error_a.png", "/error_b.png"})
    EXPECT_GT(read_gray(out + picture).width(), 600) << picture;
}

TEST_F(EvalCommand, AccuracyRefusesABadListAndLeavesNothing) {
  const auto refused = [&](const std::string& list, const std::string& part) {
    folder_.write("pairs.json", list);
    const Outcome outcome = run_command({lakshya_binary(), "accuracy", "--pairs", folder_.path("pairs.json"),
                                         "--data", folder_.path("."), "--out", folder_.path("out")});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path("out")));
  };
  refused("[]", "is empty");
  refused("[", "list of pairs");
  refused(R"([{"name":"../a"}])", "list of pairs");
  refused(
      R"([{"name":"a","left":"none.png","right":"right.png","gt":"truth.png","gt_format":"kitti","disparities":16}])",
      "none.png");
}

}  // namespace
}  // namespace lakshya

// `lakshya compare`: the tables of kernels of this build agree, and one that does not is caught in its stage.
#include "app/tools/compare_command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "app/core/image_file.h"
#include "app/core/input_error.h"
#include "app/core/vehicle_config_file.h"
#include "app/tools/compare_report.h"
#include "app/tools/compare_stages.h"
#include "app/tools/compare_tables.h"
#include "app/tools/stereo_input.h"
#include "kernels/base/isa.h"
#include "tests/support/data_path.h"
#include "tests/support/run_command.h"
#include "tests/support/stereo_pair.h"
#include "tests/support/test_image.h"

namespace lakshya {
namespace {

using Json = nlohmann::json;
using Results = std::vector<StageComparison>;
using Words = std::vector<std::string>;

StereoCalibration rig(int width, int height) {
  StereoCalibration c;
  c.width = width;
  c.height = height;
  c.left = {.fx = 160, .fy = 160, .cx = (width - 1) / 2.0, .cy = (height - 1) / 2.0};
  c.right = c.left;
  c.T = {-0.15, 0, 0};
  c.images_rectified = true;
  return c;
}

VehicleConfig vehicle(const std::string& matcher = "sgm") {
  VehicleConfig c;
  c.matcher.name = matcher;
  c.matcher.disparities = 32;
  c.grid.rows = c.grid.cols = 60;
  return c;
}

Results compare(const Image<std::uint8_t>& left, const Image<std::uint8_t>& right, const KernelTable& other,
                const VehicleConfig& config, const StereoCalibration& calibration,
                const CompareChoice& choice = {}) {
  const CompareSetup setup(config, calibration, left.view(), right.view());
  return compare_tables(setup, kReferenceKernels, other, choice);
}

Results compare(const test::StereoPair& pair, const KernelTable& other, const CompareChoice& choice = {}) {
  return compare(pair.left, pair.right, other, vehicle(), rig(test::StereoRig::kWidth, test::StereoRig::kHeight),
                 choice);
}

test::StereoPair wall() {
  return test::textured_pair([](int v) { return std::max(4, (v - 50) / 6); });
}

void expect_equal(const Results& results) {
  EXPECT_EQ(results.size(), compare_stages().size() * available_isas().size());
  for (const StageComparison& r : results) {
    EXPECT_EQ(r.numbers.different, 0U) << compare_line({r});
    EXPECT_EQ(r.status, Status::ok) << r.stage;
    EXPECT_EQ(r.numbers.compared == 0, r.same_kernels) << r.stage;
  }
}

// Every sixth pixel of every sixth row, so that disparities are a sixth.
Image<std::uint8_t> sixth_of(const std::string& path) {
  const Image<std::uint8_t> whole = read_gray(path);
  Image<std::uint8_t> small(whole.width() / 6, whole.height() / 6);
  for (int v = 0; v < small.height(); ++v) {
    for (int u = 0; u < small.width(); ++u)
      small.view().at(u, v) = whole.view().at(6 * u, 6 * v);
  }
  return small;
}

TEST(CompareTables, TheKernelsOfThisBuildAgreeOnTheDemoPair) {
  const char* root = std::getenv("LAKSHYA_ROOT");
  const std::string folder = std::string(root == nullptr ? "." : root) + "/data/opencv-doc/";
  if (!std::ifstream(folder + "aloeL.jpg")) GTEST_SKIP() << "no demo pictures in " << folder << " (./dev data)";
  const Image<std::uint8_t> left = sixth_of(folder + "aloeL.jpg");
  const Image<std::uint8_t> right = sixth_of(folder + "aloeR.jpg");
  VehicleConfig config = vehicle();
  config.matcher.disparities = 48;
  expect_equal(compare(left, right, kSimdKernels, config, rig(left.width(), left.height())));
}

TEST(CompareTables, TheKernelsOfThisBuildAgreeOnRandomImagesWithEveryMatcher) {
  std::mt19937 random(3);
  Image<std::uint8_t> left(131, 67);
  Image<std::uint8_t> right(131, 67);
  test::fill_random(left.view(), random, 0, 255);
  test::fill_random(right.view(), random, 0, 255);
  StereoCalibration distorted = rig(131, 67);
  distorted.images_rectified = false;
  distorted.left.distortion[0] = distorted.right.distortion[0] = -0.1;
  for (const char* matcher : {"sgm", "census", "sad"}) {
    SCOPED_TRACE(matcher);
    expect_equal(compare(left, right, kSimdKernels, vehicle(matcher), distorted));
  }
}

TEST(CompareTables, ARealPairAgrees) {
  const std::string folder = test::data_path("rendered/s2");
  if (folder.empty()) GTEST_SKIP() << "LAKSHYA_DATA has no rendered/s2";
  StereoInputOptions options;
  options.left = folder + "/left.png";
  options.right = folder + "/right.png";
  options.calibration = {folder + "/calib.txt"};
  const StereoInput input = read_stereo_input(options, 1.0);
  const VehicleConfig config = load_vehicle_config("", "", {"camera.pitch_deg=5"});
  expect_equal(compare(input.left, input.right, kSimdKernels, config, input.calibration, {}));
}

// One wrong bit in one code.
Status wrong_census(ImageView<const std::uint8_t> image, Rows rows, ImageView<CensusCode> codes) {
  const Status status = census_ref(image, rows, codes);
  if (rows.begin <= 40 && 40 < rows.end) codes.at(21, 40) ^= 8U;
  return status;
}

TEST(CompareTables, AWrongKernelIsNamedWithItsPixelAndValues) {
  KernelTable wrong = kReferenceKernels;
  wrong.census = wrong_census;
  const test::StereoPair pair = wall();
  const Results results = compare(pair, wrong);
  Image<CensusCode> codes(test::StereoRig::kWidth, test::StereoRig::kHeight);
  ASSERT_EQ(census_ref(pair.left.view(), {0, codes.height()}, codes.view()), Status::ok);
  const std::uint32_t right_code = codes.view().at(21, 40);
  EXPECT_FALSE(all_equal(results));
  for (const StageComparison& r : results) {
    if (r.stage == "census") {
      ASSERT_TRUE(r.numbers.first) << r.isa;
      EXPECT_EQ(r.numbers.first->what, "left");
      EXPECT_EQ(r.numbers.first->u, 21);
      EXPECT_EQ(r.numbers.first->v, 40);
      EXPECT_EQ(r.numbers.first->reference, right_code);
      EXPECT_EQ(r.numbers.first->value, right_code ^ 8U);
      EXPECT_EQ(r.numbers.different, 2U);  // the left image's and the right image's
      EXPECT_EQ(r.numbers.compared, 1U + 2U * test::StereoRig::kWidth * test::StereoRig::kHeight);
    } else if (r.stage != "frame") {
      EXPECT_TRUE(r.same_kernels) << r.stage;  // later stages were given the reference's codes
    }
  }
  const Json json = compare_json(results);
  const auto census = std::find_if(json.begin(), json.end(), [](const Json& r) { return r["stage"] == "census"; });
  ASSERT_NE(census, json.end());
  EXPECT_EQ((*census)["equal"], false);
  EXPECT_EQ((*census)["at"], Json({21, 40}));
  EXPECT_EQ((*census)["value"], right_code ^ 8U);
  EXPECT_NE(compare_table(results).find("census on " + results.front().isa + ": left at (21, 40) is "),
            std::string::npos);
  EXPECT_TRUE(compare_line(results).starts_with("DIFFERS: census on ")) << compare_line(results);
}

// One obstacle point too many in the nearest cell.
Status wrong_project(const PruneModel& model, ImageView<const std::int16_t> disparity, Rows rows,
                     const NavGrid& grid, PixelCounts& counts, ImageView<PixelClass> classes,
                     std::span<std::byte> scratch) {
  if (rows.begin == 0) ++grid.count.at(0, 0);
  return project_rows_ref(model, disparity, rows, grid, counts, classes, scratch);
}

Status refusing_score(std::span<const CellThresholds>, std::int32_t, const NavGrid&) {
  return Status::bad_argument;
}

TEST(CompareTables, PointsAndRefusalsCount) {
  KernelTable wrong = kReferenceKernels;
  wrong.project_rows = wrong_project;
  wrong.score = refusing_score;
  const Results points = compare(wall(), wrong, {"best", "project"});
  ASSERT_EQ(points.size(), 1U);
  ASSERT_TRUE(points[0].numbers.first);
  EXPECT_EQ(points[0].numbers.first->what, "points");
  EXPECT_EQ(points[0].numbers.first->value, points[0].numbers.first->reference + 1);
  const Results refused = compare(wall(), wrong, {"best", "score"});
  ASSERT_TRUE(refused.at(0).numbers.first);
  EXPECT_EQ(refused[0].numbers.first->what, "status");
}

TEST(CompareTables, WhatIsChosenIsRun) {
  const test::StereoPair pair = wall();
  for (const CompareStage& stage : compare_stages()) {
    const Results one = compare(pair, kSimdKernels, {"best", stage.name});
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one[0].stage, stage.name);
    EXPECT_EQ(one[0].isa, available_isas().front());
    EXPECT_EQ(one[0].numbers.different, 0U) << compare_line(one);
  }
  EXPECT_STREQ(active_isa(), available_isas().front());
}

TEST(CompareTables, UnknownNamesAreRefusedWithThoseThatExist) {
  const auto message = [](const CompareChoice& choice) -> std::string {
    try {
      (void)chosen_isas(choice);
      (void)chosen_stages(choice);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(message({}), "");
  const std::string isa = message({"mmx", "all"});
  EXPECT_NE(isa.find("'mmx'"), std::string::npos);
  EXPECT_NE(isa.find(available_isas().back()), std::string::npos) << isa;
  const std::string stage = message({"all", "rectifying"});
  EXPECT_NE(stage.find("'rectifying'"), std::string::npos);
  EXPECT_NE(stage.find("rectify, census, texture, edge_log,"), std::string::npos) << stage;
}

class CompareCommandTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (lakshya_binary().empty()) GTEST_SKIP() << "LAKSHYA_BIN names no lakshya";
    const test::StereoPair pair = wall();
    write_png(folder_.path("left.png"), pair.left.view());
    write_png(folder_.path("right.png"), pair.right.view());
    folder_.write("calib.txt", test::StereoRig::middlebury());
  }

  Outcome run(const Words& more) const {
    Words words{lakshya_binary(), "compare"};
    words.insert(words.end(), more.begin(), more.end());
    return run_command(words);
  }

  Outcome compare_pair(const Words& more) const {
    Words words{"--left",  folder_.path("left.png"), "--right", folder_.path("right.png"),
                "--calib", folder_.path("calib.txt")};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }

  TempFolder folder_;
};

TEST_F(CompareCommandTest, PrintsATableOrJson) {
  const Outcome table = compare_pair({});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_TRUE(table.out.starts_with("stage ")) << table.out;
  EXPECT_NE(table.out.find("\npolar_histogram  equal "), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("\nequal: "), std::string::npos) << table.out;
  const Outcome outcome = compare_pair({"--json", "--isa", "best", "--stage", "census"});
  const Json json = Json::parse(outcome.out);
  ASSERT_EQ(json["results"].size(), 1U);
  EXPECT_EQ(json["results"][0]["isa"], available_isas().front());
  EXPECT_EQ(json["results"][0]["stage"], "census");
  EXPECT_EQ(json["results"][0]["equal"], true);
  EXPECT_EQ(json["results"][0]["compared"], 1 + 2 * test::StereoRig::kWidth * test::StereoRig::kHeight);
}

TEST_F(CompareCommandTest, ListsGiveALineForEachPair) {
  const std::string list = folder_.write(
      "list.json", std::string(R"([{"name":"own-rig","left":"left.png","right":"right.png","calib":"calib.txt",)"
                               R"("disparities":20,"set":["matcher.name=sad"]},)"
                               R"({"name":"made-up","left":"left.png","right":"right.png","disparities":32}])"));
  const Words words{"--pairs", list, "--data", folder_.path("."), "--stage", "census"};
  const Outcome outcome = run(words);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("own-rig             160x120     32  equal: 1 of 1 stages"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("\nmade-up             160x120     32  equal: "), std::string::npos) << outcome.out;
}

TEST_F(CompareCommandTest, RefusesWhatItDoesNotKnow) {
  const Outcome isa = compare_pair({"--isa", "mmx"});
  EXPECT_EQ(isa.exit_code, 1);
  EXPECT_NE(isa.err.find("'mmx' is not to be had here (there are: all, "), std::string::npos) << isa.err;
  const Outcome stage = compare_pair({"--stage", "sgbm"});
  EXPECT_EQ(stage.exit_code, 1);
  EXPECT_NE(stage.err.find("there is no 'sgbm'"), std::string::npos) << stage.err;
  const std::string list = folder_.write("list.json", std::string(R"([{"left":"left.png"}])"));
  EXPECT_EQ(run({"--pairs", list, "--data", folder_.path(".")}).exit_code, 1);
  EXPECT_EQ(run({"--pairs", list}).exit_code, 2);
  EXPECT_EQ(run({}).exit_code, 2);
}

}  // namespace
}  // namespace lakshya

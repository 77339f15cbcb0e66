// The command `lakshya process` as a user starts it, on pairs whose disparities are known by construction.
#include "app/tools/process_command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "app/core/image_file.h"
#include "app/tools/map_file.h"
#include "kernels/base/units.h"
#include "tests/support/run_command.h"
#include "tests/support/stereo_pair.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Names = std::set<std::string>;
using Words = std::vector<std::string>;
using test::StereoRig;

constexpr int kPixels = StereoRig::kWidth * StereoRig::kHeight;
constexpr int kWallShift = 8;  // px: 1.25 m, in row 12 of the map
// Looks over the camera's whole view of the wall: no floor below it.
constexpr const char* kHeight = "1";

const Names kResults{"classes.png", "disparity.png", "disparity_color.png", "map.json", "map.png", "summary.png"};

Names everything_in(const std::string& folder) {
  Names names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    names.insert(fs::relative(entry.path(), folder).string());
  return names;
}

int sum(const Json& counts) {
  int total = 0;
  for (const Json& count : counts)
    total += count.get<int>();
  return total;
}

class ProcessCommandTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (lakshya_.empty()) GTEST_SKIP() << "LAKSHYA_BIN names no lakshya";
    give(test::textured_pair([](int) { return kWallShift; }));
  }

  void give(const test::StereoPair& pair) const {
    write_png(left_, pair.left.view());
    write_png(right_, pair.right.view());
  }

  // `lakshya process` with the fixture's inputs and more options.
  Outcome process(const Words& options, const std::string& out = "out", const std::string& threads = "2") const {
    Words words{"env",     "OMP_NUM_THREADS=" + threads,
                lakshya_,  "process",
                "--left",  left_,
                "--right", right_,
                "--calib", calibration_,
                "--out",   folder_.path(out)};
    words.insert(words.end(), options.begin(), options.end());
    return run_command(words);
  }

  Json json_of(Words options, const std::string& out = "out") const {
    options.emplace_back("--json");
    const Outcome outcome = process(options, out);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(outcome.out);
  }

  std::string map_of(const Words& options, const std::string& threads = "2") const {
    const Outcome outcome = process(options, "out", threads);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return bytes_of(result("map.json"));
  }

  std::string result(const std::string& name) const { return folder_.path("out/" + name); }

  // disparity.png has a value for most pixels, and nearly always this one.
  void expect_disparity(int code) const {
    const Image<std::uint16_t> image = read_gray16(result("disparity.png"));
    ASSERT_EQ(image.width(), StereoRig::kWidth);
    ASSERT_EQ(image.height(), StereoRig::kHeight);
    constexpr int kNearly = 2 * 16;  // two sixteenths of a pixel
    int valid = 0;
    int right = 0;
    for (int i = 0; i < kPixels; ++i) {
      const int written = image.view().data[i];
      valid += written != 0 ? 1 : 0;
      right += std::abs(written - code) <= kNearly ? 1 : 0;
    }
    EXPECT_GT(valid, kPixels * 8 / 10);
    EXPECT_GT(right, valid * 99 / 100);
  }

  // Obstacle cells lie in the map's row and nowhere else, and fill the view from side to side.
  void expect_wall(int row, int least_width) const {
    const MapFile map = read_map(result("map.json"), 0.1);
    int found = 0;
    for (int r = 0; r < map.geometry.rows; ++r) {
      for (int c = 0; c < map.geometry.cols; ++c) {
        if (map.type.view().at(c, r) != kCellObstacle) continue;
        EXPECT_EQ(r, row) << "column " << c;
        ++found;
      }
    }
    EXPECT_GE(found, least_width);
  }

  // Exit code 1, nothing on stdout, all parts of the reason on stderr, and no file more or less than before.
  void expect_refused(const Words& options, const Words& parts) const {
    const Names before = everything_in(folder_.path(""));
    const Outcome outcome = process(options);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("lakshya: error: "), std::string::npos) << outcome.err;
    for (const std::string& part : parts)
      EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err << "\nlacks: " << part;
    EXPECT_EQ(everything_in(folder_.path("")), before);
  }

  TempFolder folder_;
  std::string lakshya_ = lakshya_binary();
  std::string left_ = folder_.path("left.png");
  std::string right_ = folder_.path("right.png");
  std::string calibration_ = folder_.write("calib.txt", StereoRig::middlebury());
};

TEST_F(ProcessCommandTest, WallBecomesDisparityMapAndPictures) {
  const Json json = json_of({"--camera-height", kHeight});
  EXPECT_EQ(everything_in(folder_.path("out")), kResults);
  expect_disparity(kWallShift * 256);
  expect_wall(12, 16);
  for (const std::string& name : kResults) {
    if (!name.ends_with(".png") || name == "disparity.png") continue;
    const Image<std::uint8_t> picture = read_gray(result(name));
    EXPECT_GE(picture.width(), StereoRig::kWidth) << name;
    EXPECT_GE(picture.height(), StereoRig::kHeight) << name;
  }
  EXPECT_EQ(json["blocked"], true);
  EXPECT_EQ(json["speed_mps"], 0.0);
}

TEST_F(ProcessCommandTest, CountsAddUp) {
  const Json json = json_of({"--camera-height", kHeight, "--set", "grid.rows=70", "--set", "grid.cols=60"});
  EXPECT_EQ(sum(json["pixels"]), kPixels);
  EXPECT_EQ(sum(json["cells"]), 70 * 60);
  EXPECT_LE(sum(json["no_disparity"]), json["pixels"]["no_disparity"]);
  EXPECT_EQ(json["width"], StereoRig::kWidth);
  EXPECT_EQ(json["height"], StereoRig::kHeight);
  EXPECT_EQ(json["focal_px"], 100.0);
  EXPECT_NEAR(json["baseline_m"], 0.1, 1e-12);
  EXPECT_EQ(json["doffs"], 0.0);
  EXPECT_EQ(json["out"], folder_.path("out"));
  double stages = 0;
  for (const auto& [stage, time] : json["time_ms"].items())
    stages += stage == "total" ? 0.0 : time.get<double>();
  EXPECT_NEAR(json["time_ms"]["total"], stages, 0.01);

  const MapFile map = read_map(result("map.json"), 0.1);
  EXPECT_EQ(map.geometry.rows, 70);
  EXPECT_EQ(map.geometry.cols, 60);
  std::uint32_t points = 0;
  for (int i = 0; i < 70 * 60; ++i)
    points += map.count.view().data[i];
  EXPECT_EQ(points, json["pixels"]["obstacle"]);
}

TEST_F(ProcessCommandTest, FreeFloorLeadsToTheTarget) {
  // A level camera 0.6 m above the ground: d_f = (B / H) (v - c_v), here rounded to whole pixels.
  give(test::textured_pair(
      [](int v) { return std::max(0, static_cast<int>(std::lround(0.1 / 0.6 * (v - StereoRig::kCenterV)))); }));
  for (const int deg : {-15, 0, 15}) {
    const Json json = json_of({"--target", std::to_string(deg)});
    EXPECT_EQ(json["blocked"], false);
    EXPECT_EQ(json["direction_deg"], deg);
    EXPECT_GT(json["speed_mps"], 0.0);
    EXPECT_EQ(json["cells"]["obstacle"], 0);
    EXPECT_GT(json["cells"]["unoccupied"], 500);
  }
}

TEST_F(ProcessCommandTest, PlainOutputIsATable) {
  const Outcome outcome = process({});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("pixels\n")) << outcome.out;
  for (const char* part : {"\nmap cells\n", "\ntime\n", "\ndecision\n", "/out/summary.png shows"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << outcome.out << "\nlacks: " << part;
}

TEST_F(ProcessCommandTest, PointsOnlyOnRequest) {
  const Json json = json_of({"--camera-height", kHeight, "--points"});
  Names with_points = kResults;
  with_points.insert("points.ply");
  EXPECT_EQ(everything_in(folder_.path("out")), with_points);
  const Json& pixels = json["pixels"];
  const int points = kPixels - pixels["no_disparity"].get<int>() - pixels["too_far"].get<int>();
  const std::string ply = bytes_of(result("points.ply"));
  EXPECT_TRUE(ply.starts_with("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_NE(ply.find("\nelement vertex " + std::to_string(points) + "\n"), std::string::npos);

  // The next run has none and takes the old one away, but nothing else.
  folder_.write("out/notes.txt", std::string("mine"));
  EXPECT_EQ(process({}).exit_code, 0);
  Names without_points = kResults;
  without_points.insert("notes.txt");
  EXPECT_EQ(everything_in(folder_.path("out")), without_points);
}

TEST_F(ProcessCommandTest, OpencvYamlOfTheSameRigGivesTheSameMap) {
  const std::string map = map_of({});
  calibration_ = folder_.write("calib.yaml", StereoRig::opencv_yaml());
  EXPECT_EQ(map_of({}), map);
  calibration_ = folder_.write("calib_mm.yaml", StereoRig::opencv_yaml("100"));
  EXPECT_EQ(map_of({"--set", "camera.calibration_unit_m=0.001"}), map);
}

TEST_F(ProcessCommandTest, DoffsMovesTheWallButNotTheImageDisparity) {
  // Stored 9.5 px: 1.05 m.
  calibration_ = folder_.write("calib.txt", StereoRig::middlebury(1.5));
  EXPECT_EQ(json_of({"--camera-height", kHeight})["doffs"], 1.5);
  expect_disparity(kWallShift * 256);
  expect_wall(10, 13);
}

TEST_F(ProcessCommandTest, CameraOptionsOverrideTheConfiguration) {
  const std::string config =
      folder_.write("vehicle.yaml", std::string("camera:\n  height_m: 0.3\n  pitch_deg: 20\n  roll_deg: 5\n"));
  const std::string wanted =
      map_of({"--set", "camera.height_m=0.9", "--set", "camera.pitch_deg=-2.5", "--set", "camera.roll_deg=-1.25"});
  EXPECT_NE(map_of({"--config", config}), wanted);
  EXPECT_EQ(
      map_of({"--config", config, "--camera-height", "0.9", "--camera-pitch", "-2.5", "--camera-roll", "-1.25"}),
      wanted);
}

TEST_F(ProcessCommandTest, SearchRangeOptions) {
  const Outcome rounded = process({"--disparities", "20"});
  EXPECT_EQ(rounded.exit_code, 0) << rounded.err;
  EXPECT_NE(rounded.err.find("160x120, 32 disparities"), std::string::npos) << rounded.err;
  EXPECT_EQ(bytes_of(result("map.json")), map_of({"--set", "matcher.disparities=32"}));

  EXPECT_EQ(map_of({"--min-disparity", "4", "--matcher", "sgm"}), map_of({"--set", "matcher.min_disparity=4"}));
  expect_disparity(kWallShift * 256);
  // Without the wall's own disparity in the range only chance matches remain.
  EXPECT_LT(json_of({"--min-disparity", "9", "--camera-height", kHeight})["pixels"]["obstacle"], kPixels / 5);
}

TEST_F(ProcessCommandTest, EveryRunGivesTheSameBytes) {
  const std::string map = map_of({});
  const std::string disparity = bytes_of(result("disparity.png"));
  for (const char* threads : {"2", "1", "3", "7"}) {
    EXPECT_EQ(map_of({}, threads), map) << threads << " threads";
    EXPECT_EQ(bytes_of(result("disparity.png")), disparity) << threads << " threads";
  }
}

TEST_F(ProcessCommandTest, RefusesUnreadableImages) {
  const std::string whole = bytes_of(left_);
  fs::remove(left_);
  expect_refused({}, {left_ + ": "});
  for (const std::size_t length : {std::size_t{0}, std::size_t{20}, whole.size() / 2, whole.size() - 1}) {
    folder_.write("left.png", whole.substr(0, length));
    expect_refused({}, {left_ + ": ", length == 0 ? "empty" : "the data end too early"});
  }
  write_png(left_, Image<std::uint16_t>(StereoRig::kWidth, StereoRig::kHeight).view());
  expect_refused({}, {left_ + ": png: has 16-bit samples"});
  left_ = folder_.path("");
  expect_refused({}, {left_ + ": "});
}

TEST_F(ProcessCommandTest, RefusesSizesThatDiffer) {
  write_png(right_, Image<std::uint8_t>(159, 120).view());
  expect_refused({}, {right_ + ": image size: 159x120 is not the 160x120 of " + calibration_});
  write_png(left_, Image<std::uint8_t>(320, 240).view());
  expect_refused({}, {left_ + ": image size: 320x240 is not the 160x120 of " + calibration_});
  // This calibration states no size.
  calibration_ = folder_.write("calib.yaml", StereoRig::opencv_yaml());
  expect_refused({}, {right_ + ": size 159x120 differs from the left image's 320x240"});
}

TEST_F(ProcessCommandTest, RefusesBadCalibrations) {
  std::string text = StereoRig::middlebury();
  const std::string baseline = "baseline=100\n";
  const std::size_t at = text.find(baseline);
  folder_.write("calib.txt", std::string(text).erase(at, baseline.size()));
  expect_refused({}, {calibration_ + ": baseline: "});
  folder_.write("calib.txt", std::string(text).replace(at, baseline.size(), "baseline=nan\n"));
  expect_refused({}, {calibration_ + ": baseline: ", "nan"});
  folder_.write("calib.txt", std::string("cam0=[nan") + text.substr(text.find(" 0 79.5")));
  expect_refused({}, {calibration_ + ": cam0: ", "nan"});
  calibration_ = folder_.write("calib.yaml", StereoRig::opencv_yaml("nan"));
  expect_refused({}, {calibration_ + ": T: ", "nan"});
  calibration_ = folder_.path("none.yaml");
  expect_refused({}, {calibration_ + ": "});
}

TEST_F(ProcessCommandTest, RefusesBadConfigurations) {
  const std::string config = folder_.write("vehicle.yaml", std::string("camera:\n  hieght_m: 0.5\n"));
  expect_refused({"--config", config}, {config + ":2: ", "hieght_m", "did you mean", "height_m"});
  expect_refused({"--set", "matcher.disparites=64"}, {"matcher.disparites", "did you mean matcher.disparities?"});
  expect_refused({"--camera-height", "99"}, {"camera.height_m", "out of range"});
  expect_refused({"--camera-pitch", "nan"}, {"camera.pitch_deg", "nan"});
  expect_refused({"--matcher", "best"}, {"matcher.name", "sgm"});
  expect_refused({"--profile", "forest"}, {"forest"});
  expect_refused({"--set", "matcher.disparities=32", "--disparities", "32"}, {"matcher.disparities: set twice"});
}

TEST_F(ProcessCommandTest, RefusesAFileInPlaceOfTheFolder) {
  folder_.write("out", std::string("a file"));
  expect_refused({}, {folder_.path("out") + ": cannot write results here"});
  EXPECT_EQ(bytes_of(folder_.path("out")), "a file");
}

TEST_F(ProcessCommandTest, WrongUsageIsExitCodeTwo) {
  const Names before = everything_in(folder_.path(""));
  const Words given{lakshya_, "process", "--left", left_, "--right", right_, "--calib", calibration_};
  const Outcome no_out = run_command(given);
  EXPECT_EQ(no_out.exit_code, 2);
  EXPECT_NE(no_out.err.find("--out"), std::string::npos) << no_out.err;
  for (const Words& options :
       {Words{"--target", "500"}, Words{"--target", "nan"}, Words{"--unknown-option"}, Words{"--disparities", "0"},
        Words{"--disparities", "513"}, Words{"--camera-height", "high"}, Words{"--set"}, Words{"extra.png"}}) {
    const Outcome outcome = process(options);
    EXPECT_EQ(outcome.exit_code, 2) << options.front();
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err, "");
  }
  EXPECT_EQ(run_command({lakshya_}).exit_code, 2);
  EXPECT_EQ(run_command({lakshya_, "proces"}).exit_code, 2);
  EXPECT_EQ(everything_in(folder_.path("")), before);
}

TEST_F(ProcessCommandTest, HelpShowsAnExample) {
  const Outcome help = run_command({lakshya_, "process", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.err, "");
  EXPECT_NE(help.out.find("Example: lakshya process --left"), std::string::npos) << help.out;
}

}  // namespace
}  // namespace lakshya

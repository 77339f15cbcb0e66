// Where a command's pair comes from: as options that are read, and as `lakshya process` that a user starts.
#include "app/tools/stereo_input.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/core/image_file.h"
#include "tests/support/calibration_texts.h"
#include "tests/support/data_path.h"
#include "tests/support/image_checks.h"
#include "tests/support/run_command.h"
#include "tests/support/stereo_pair.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;
using test::StereoRig;
using test::with;
using Words = std::vector<std::string>;

// The rig of tests/support/stereo_pair.h in the words of the other formats; f = 100 px, B = 0.1 m.
const std::string kKitti =
    "P0: 100 0 79.5 0 0 100 59.5 0 0 0 1 0\nP1: 100 0 79.5 -10 0 100 59.5 0 0 0 1 0\n"
    "P2: 100 0 79.5 1 0 100 59.5 0 0 0 1 0\nP3: 100 0 79.5 -19 0 100 59.5 0 0 0 1 0\n";

std::string sensor(const std::string& y) {
  const std::string text =
      with(test::euroc_sensor(y, "79.5"), "[100.5, 100.25, 79.5, 60]", "[100, 100, 79.5, 59.5]");
  return with(text, "[-0.28, 0.07, 0.0002, 1.76e-05]", "[0, 0, 0, 0]");
}

std::string camera_info(const std::string& name, const std::string& tx) {
  std::string text =
      with(test::ros_camera_info(name, tx), "[100, 0, 81, 0, 101, 61,", "[100, 0, 79.5, 0, 100, 59.5,");
  text = with(text, "[0.1, 0.2, 0.3, 0.4, 0.5]", "[0, 0, 0, 0, 0]");
  text = with(text, "[0.8, 0, -0.6, 0, 1, 0, 0.6, 0, 0.8]", "[1, 0, 0, 0, 1, 0, 0, 0, 1]");
  return with(with(text, "[90, 0, 80,", "[100, 0, 79.5,"), "0, 90, 60,", "0, 100, 59.5,");
}

class StereoInputTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }

  void text(const std::string& name, const std::string& content) const {
    fs::create_directories(fs::path(path(name)).parent_path());
    folder_.write(name, content);
  }

  // Frame k of both folders shows a wall at 8 + k px.
  void frames(const std::string& left, const std::string& right, const Words& names) const {
    fs::create_directories(path(left));
    fs::create_directories(path(right));
    int shift = 8;
    for (const std::string& name : names) {
      const test::StereoPair pair = test::textured_pair([shift](int) { return shift; });
      write_png((fs::path(path(left)) / name).string(), pair.left.view());
      write_png((fs::path(path(right)) / name).string(), pair.right.view());
      ++shift;
    }
  }

  StereoInputOptions of_sequence(int frame) const {
    StereoInputOptions o;
    o.sequence = path("seq");
    o.frame = frame;
    return o;
  }
  StereoInputOptions of_sides(const std::string& left, const std::string& right, const std::string& calib) const {
    StereoInputOptions o;
    o.left = path(left);
    o.right = path(right);
    o.calibration = {path(calib)};
    return o;
  }
  static double baseline(const StereoInputOptions& o) { return -read_stereo_input(o, 1.0).calibration.T.x(); }
  std::string refused(const std::string& where, const StereoInputOptions& o) const {
    return refusal(path(where), [&](const std::string&) { read_stereo_input(o, 1.0); });
  }

  TempFolder folder_;
};

TEST_F(StereoInputTest, KittiSequenceWithItsOwnCalibrationAndTimes) {
  frames("seq/image_0", "seq/image_1", {"000000.png", "000001.png"});
  text("seq/calib.txt", kKitti);
  text("seq/times.txt", "0\n0.1\n");
  const StereoInput input = read_stereo_input(of_sequence(1), 1.0);
  EXPECT_EQ(input.left_path, path("seq/image_0/000001.png"));
  EXPECT_EQ(input.right_path, path("seq/image_1/000001.png"));
  EXPECT_EQ(input.timestamp_ns, 100000000);
  EXPECT_EQ(input.left.width(), StereoRig::kWidth);
  EXPECT_EQ(pixels(input.left), pixels(read_gray(input.left_path)));
  EXPECT_EQ(pixels(input.right), pixels(read_gray(input.right_path)));
  EXPECT_NEAR(input.calibration.T.x(), -0.1, 1e-12);
}

TEST_F(StereoInputTest, FoldersOrTheOptionChooseKittisCameras) {
  frames("seq/image_2", "seq/image_3", {"000000.png"});
  text("seq/calib.txt", kKitti);
  EXPECT_NEAR(baseline(of_sequence(0)), 0.2, 1e-12);

  StereoInputOptions sides = of_sides("seq/image_2/000000.png", "seq/image_3/000000.png", "seq/calib.txt");
  EXPECT_NEAR(baseline(sides), 0.2, 1e-12);
  sides.cameras = {0, 1};
  EXPECT_NEAR(baseline(sides), 0.1, 1e-12);

  frames("seq/image_0", "seq/image_1", {"000000.png"});
  EXPECT_NEAR(baseline(of_sequence(0)), 0.1, 1e-12);
  StereoInputOptions colour = of_sequence(0);
  colour.cameras = {2, 3};
  EXPECT_EQ(read_stereo_input(colour, 1.0).left_path, path("seq/image_2/000000.png"));
  EXPECT_NEAR(baseline(colour), 0.2, 1e-12);

  const StereoInputOptions swapped = of_sides("seq/image_1/000000.png", "seq/image_0/000000.png", "seq/calib.txt");
  EXPECT_CONTAINS(refused("seq/calib.txt", swapped), "left and right are swapped");
}

TEST_F(StereoInputTest, EurocAndRosCalibrations) {
  frames("seq/mav0/cam0/data", "seq/mav0/cam1/data", {"100.png", "200.png"});
  text("seq/mav0/cam0/sensor.yaml", sensor("0.05"));
  text("seq/mav0/cam1/sensor.yaml", sensor("-0.05"));
  const StereoInput input = read_stereo_input(of_sequence(1), 1.0);
  EXPECT_EQ(input.timestamp_ns, 200);
  EXPECT_NEAR(input.calibration.T.x(), -0.1, 1e-12);

  text("ros/left.yaml", camera_info("left", "0"));
  text("ros/right.yaml", camera_info("right", "-10"));
  StereoInputOptions sides = of_sides("seq/mav0/cam0/data", "seq/mav0/cam1/data", "ros");
  sides.frame = 0;
  EXPECT_NEAR(baseline(sides), 0.1, 1e-12);
  sides.calibration = {path("ros/left.yaml"), path("ros/right.yaml")};
  EXPECT_NEAR(baseline(sides), 0.1, 1e-12);
  EXPECT_FALSE(read_stereo_input(sides, 1.0).timestamp_ns.has_value());
}

TEST_F(StereoInputTest, Refusals) {
  frames("seq/left", "seq/right", {"0.png", "1.png"});
  EXPECT_CONTAINS(refused("seq", of_sequence(2)), "frame 2: there are 2 frames, 0 to 1");
  EXPECT_CONTAINS(refused("seq", of_sequence(1)), "calibration: none found in this folder");
  text("seq/calib.txt", kKitti);
  StereoInputOptions none_chosen = of_sequence(0);
  none_chosen.frame.reset();
  EXPECT_CONTAINS(refused("seq", none_chosen), "frame: holds 2 frames (choose one with --frame 0 to 1)");
  StereoInputOptions sides = of_sides("seq/left", "seq/right", "seq/calib.txt");
  EXPECT_CONTAINS(refused("seq/left", sides), "frame: holds 2 frames");
  EXPECT_CONTAINS(refused("seq/left", of_sides("seq/left", "seq/right/0.png", "seq/calib.txt")),
                  "image: is a folder");
  EXPECT_CONTAINS(refused("seq/right", of_sides("seq/left/0.png", "seq/right", "seq/calib.txt")),
                  "image: is a folder");
  sides = of_sides("seq/left/0.png", "seq/right/0.png", "seq/calib.txt");
  sides.frame = 0;
  EXPECT_CONTAINS(refused("seq/left/0.png", sides), "frame: not a folder of frames (leave --frame out");
  fs::remove(path("seq/right/1.png"));
  EXPECT_CONTAINS(refused("seq/right", of_sequence(0)), "images: 1 here, but 2 in " + path("seq/left"));
  write_png(path("seq/right/1.png"), Image<std::uint8_t>(32, 32).view());
  EXPECT_CONTAINS(refused("seq/right/1.png", of_sequence(1)), "image size: the principal point");
  EXPECT_THROW(read_stereo_input({}, 1.0), CLI::RequiredError);
}

// The command: one rig in five formats gives one map, byte for byte.
class ProcessSequenceTest : public StereoInputTest {
 protected:
  void SetUp() override {
    if (lakshya_.empty()) GTEST_SKIP() << "LAKSHYA_BIN names no lakshya";
  }
  Outcome process(const Words& options, const std::string& camera_height = "1") const {
    Words words{lakshya_, "process", "--camera-height", camera_height, "--json", "--out", path("out")};
    words.insert(words.end(), options.begin(), options.end());
    return run_command(words);
  }
  std::string map_of(const Words& options) const {
    const Outcome outcome = process(options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return bytes_of(path("out/map.json"));
  }

  std::string lakshya_ = lakshya_binary();
};

TEST_F(ProcessSequenceTest, EveryFormatOfTheSameRigGivesTheSameMap) {
  frames("seq/image_0", "seq/image_1", {"000000.png", "000001.png"});
  text("seq/calib.txt", kKitti);
  text("middlebury.txt", StereoRig::middlebury());
  text("euroc/cam0/sensor.yaml", sensor("0.05"));
  text("euroc/cam1/sensor.yaml", sensor("-0.05"));
  text("ros/left.yaml", camera_info("left", "0"));
  text("ros/right.yaml", camera_info("right", "-10"));
  const Words one{"--left", path("seq/image_0/000001.png"), "--right", path("seq/image_1/000001.png"), "--calib"};
  const Words folders{"--left", path("seq/image_0"), "--right", path("seq/image_1"), "--frame", "1", "--calib"};
  const auto plus = [](Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const std::string map = map_of(plus(one, {path("middlebury.txt")}));
  EXPECT_NE(map, "");
  EXPECT_EQ(map_of({"--sequence", path("seq"), "--frame", "1"}), map);
  EXPECT_NE(map_of({"--sequence", path("seq"), "--frame", "0"}), map);
  EXPECT_EQ(map_of({"--sequence", path("seq"), "--frame", "1", "--calib", path("middlebury.txt")}), map);
  EXPECT_EQ(map_of(plus(folders, {path("seq/calib.txt"), "--cameras", "0,1"})), map);
  EXPECT_EQ(map_of(plus(folders, {path("euroc")})), map);
  EXPECT_EQ(map_of(plus(folders, {path("ros/left.yaml"), path("ros/right.yaml")})), map);
}

TEST_F(ProcessSequenceTest, SaysWhichFrameAndWhatWasLeftOut) {
  frames("seq/cam0", "seq/cam1", {"100.png", "200.png", "300.png"});
  fs::remove(path("seq/cam1/200.png"));
  text("seq/calib.txt", kKitti);
  const Outcome outcome = process({"--sequence", path("seq"), "--frame", "1"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_CONTAINS(outcome.err, "1 frames lack their partner; the first: frame at 200 ns left out: no right image");
  EXPECT_CONTAINS(outcome.err, "frame 1 of 2: " + path("seq/cam0/300.png"));
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["timestamp_ns"], 300);
  EXPECT_EQ(json["left"], path("seq/cam0/300.png"));
}

TEST_F(ProcessSequenceTest, RefusalsAndWrongUsage) {
  frames("seq/left", "seq/right", {"0.png"});
  const std::string seq = path("seq");
  const std::string image = path("seq/left/0.png");
  const Outcome missing = process({"--sequence", seq, "--frame", "0"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_EQ(missing.out, "");
  EXPECT_CONTAINS(missing.err, "lakshya: error: " + seq + ": calibration: none found");
  for (const Words& wrong :
       {Words{}, Words{"--calib", seq}, Words{"--frame", "0"}, Words{"--sequence", seq, "--frame", "-1"},
        Words{"--sequence", seq, "--frame", "first"}, Words{"--left", image},
        Words{"--left", image, "--right", image},
        Words{"--sequence", seq, "--left", image, "--right", image, "--calib", seq},
        Words{"--sequence", seq, "--frame", "0", "--cameras", "2"},
        Words{"--sequence", seq, "--frame", "0", "--cameras", "0,4"},
        Words{"--sequence", seq, "--frame", "0", "--calib", seq, seq, seq}}) {
    const Outcome outcome = process(wrong);
    EXPECT_EQ(outcome.exit_code, 2) << (wrong.empty() ? "" : wrong.back()) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err, "");
  }
  EXPECT_FALSE(fs::exists(path("out")));
}

TEST_F(ProcessSequenceTest, RealSequences) {
  const std::string kitti = test::data_path("kitti_odometry_06");
  const std::string euroc = test::data_path("euroc_v1_01_part_a");
  if (kitti.empty() || euroc.empty()) GTEST_SKIP() << "no kitti_odometry_06, euroc_v1_01_part_a under LAKSHYA_DATA";
  const auto json_of = [this](const std::string& sequence, const std::string& camera_height) {
    const Outcome outcome = process({"--sequence", sequence, "--frame", "3"}, camera_height);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  };
  const auto of_kitti = json_of(kitti, "1.65");
  EXPECT_EQ(of_kitti["focal_px"], 707.0912);
  EXPECT_NEAR(of_kitti["baseline_m"], 0.53715, 1e-5);
  EXPECT_LT(of_kitti["pixels"]["no_disparity"], 1226 * 370 * 4 / 10);
  const auto of_euroc = json_of(euroc, "1.2");
  EXPECT_NEAR(of_euroc["baseline_m"], 0.11008, 5e-6);
  EXPECT_EQ(of_euroc["timestamp_ns"], 1403715281212143104);
  EXPECT_LT(of_euroc["pixels"]["no_disparity"], 752 * 480 * 4 / 10);
}

}  // namespace
}  // namespace lakshya

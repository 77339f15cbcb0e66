// Which calibration a folder holds.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "app/core/calibration_file.h"
#include "tests/support/calibration_texts.h"
#include "tests/support/image_checks.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

using Paths = std::vector<std::string>;

class CalibrationFolder : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }
  void write(const std::string& name, const std::string& text = "x") const {
    std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
    folder_.write(name, text);
  }
  Paths found() const { return find_calibration(path("rig")); }
  std::string refused() const {
    return refusal(path("rig"), [](const std::string& p) { find_calibration(p); });
  }

  TempFolder folder_;
};

TEST_F(CalibrationFolder, FindsEveryLayout) {
  const std::vector<std::pair<std::string, std::string>> pairs{{"mav0/cam0/sensor.yaml", "mav0/cam1/sensor.yaml"},
                                                               {"cam0/sensor.yaml", "cam1/sensor.yaml"},
                                                               {"cam0_sensor.yaml", "cam1_sensor.yaml"},
                                                               {"left.yaml", "right.yaml"}};
  for (const auto& [left, right] : pairs) {
    write("rig/" + left);
    EXPECT_CONTAINS(refusal(path("rig/" + right), [this](const std::string&) { found(); }), "missing beside ");
    write("rig/" + right);
    EXPECT_EQ(found(), (Paths{path("rig/" + left), path("rig/" + right)}));
    std::filesystem::remove(path("rig/" + left));
    EXPECT_CONTAINS(refusal(path("rig/" + left), [this](const std::string&) { found(); }), "missing beside ");
    std::filesystem::remove(path("rig/" + right));
  }
  for (const std::string name :
       {"calib.txt", "calib_cam_to_cam.txt", "calib.yaml", "calibration.yml", "stereo.yaml"}) {
    write("rig/" + name);
    EXPECT_EQ(found(), Paths{path("rig/" + name)});
    std::filesystem::remove(path("rig/" + name));
  }
}

TEST_F(CalibrationFolder, NoneAndSeveralAreRefused) {
  std::filesystem::create_directory(path("rig"));
  const std::string none = refused();
  EXPECT_CONTAINS(none, "calibration: none found in this folder; looked for mav0/cam0/sensor.yaml and mav0/cam1");
  EXPECT_CONTAINS(none, "left.yaml and right.yaml, calib.txt, ");
  write("rig/calib.txt");
  write("rig/stereo.yaml");
  const std::string both = refused();
  EXPECT_CONTAINS(both, "calibration: both " + path("rig/calib.txt") + " and " + path("rig/stereo.yaml"));
}

TEST_F(CalibrationFolder, IsReadLikeItsFiles) {
  write("rig/calib.txt", test::kitti_calib());
  EXPECT_EQ(read_calibration(path("rig")).T.x(), -0.5);
  EXPECT_NEAR(read_calibration({{path("rig")}, 1.0, {2, 3}}).T.x(), -0.535, 1e-12);
  write("euroc/cam0/sensor.yaml", test::euroc_sensor("0.06"));
  write("euroc/cam1/sensor.yaml", test::euroc_sensor("-0.05"));
  EXPECT_NEAR(read_calibration(path("euroc")).T.x(), -0.11, 1e-12);
  write("ros/left.yaml", test::ros_camera_info("left", "0"));
  write("ros/right.yaml", test::ros_camera_info("right", "-10.8"));
  EXPECT_NEAR(read_calibration(path("ros")).T.norm(), 0.12, 1e-12);
}

TEST_F(CalibrationFolder, OtherCountsOfPathsAreRefused) {
  const auto none = [](const std::string&) { read_calibration(CalibrationRequest{}); };
  EXPECT_CONTAINS(refusal("calibration", none), "paths: 0 given");
  const auto three = [](const std::string&) { read_calibration({{"a", "b", "c"}, 1.0, {}}); };
  EXPECT_CONTAINS(refusal("calibration", three), "paths: 3 given");
}

}  // namespace
}  // namespace lakshya

// The robot scenes of the evaluation data, which another renderer made, through `lakshya process`: every obstacle is in the map, and the
// map has none where there is none. The tolerance is, as in `lakshya eval`, one cell and three sigma of the depth; up to 6 m.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/data_path.h"
#include "tests/support/run_command.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

using Json = nlohmann::json;
constexpr double kFocalBaseline = 50.4;  // px m, of all scenes
constexpr double kDisparitySigma = 0.25;
constexpr double kRange = 6;
constexpr int kSeenPixels = 200;  // fewer may be lost

struct Scene {
  const char* name;
  const char* mount;
  const char* profile;
};

double distance_to(const Json& polygon, double x, double y) {
  double best = 1e9;
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Json& a = polygon[i];
    const Json& b = polygon[(i + 1) % polygon.size()];
    const double ax = a[0], ay = a[1], bx = b[0], by = b[1];
    if ((ay > y) != (by > y) && x < (bx - ax) * (y - ay) / (by - ay) + ax) inside = !inside;
    const double squared = (bx - ax) * (bx - ax) + (by - ay) * (by - ay);
    const double t =
        squared > 0 ? std::clamp(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / squared, 0.0, 1.0) : 0;
    best = std::min(best, std::hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay)));
  }
  return inside ? 0 : best;
}

class RenderedScenes : public ::testing::TestWithParam<Scene> {};

TEST_P(RenderedScenes, EveryObstacleAndNoFalseCell) {
  const Scene& scene = GetParam();
  const std::string folder = test::data_path(std::string("rendered/") + scene.name);
  if (folder.empty()) GTEST_SKIP() << "LAKSHYA_DATA has no rendered/" << scene.name;
  const std::string at = folder + "/";
  const TempFolder out;
  std::vector<std::string> words{lakshya_binary(), "process",        "--left",  at + "left.png",
                                 "--right",        at + "right.png", "--calib", at + "calib.txt",
                                 "--profile",      scene.profile,    "--out",   out.path("out")};
  std::istringstream mount(scene.mount);
  for (std::string word; mount >> word;)
    words.push_back(word);
  const Outcome r = run_command(words);
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const Json map = Json::parse(std::ifstream(out.path("out/map.json")));
  Json objects = Json::parse(std::ifstream(at + "scene.json"))["objects"];

  std::vector<int> cells(objects.size());
  std::string false_cells;
  int found = 0;
  const double cell_m = map["cell_m"];
  for (int row = 0; row < map["rows"].get<int>(); ++row) {
    for (int col = 0; col < map["cols"].get<int>(); ++col) {
      if (map["type"][static_cast<std::size_t>(row)][static_cast<std::size_t>(col)] != 0) continue;
      const double x = (row + 0.5) * cell_m;
      const double y = (map["cols"].get<int>() / 2.0 - col - 0.5) * cell_m;
      const double tolerance = cell_m + 3 * x * x * kDisparitySigma / kFocalBaseline;
      bool is_true = false;
      for (std::size_t i = 0; i < objects.size(); ++i) {
        if (objects[i]["expect"] == "free" || distance_to(objects[i]["footprint"], x, y) > tolerance) continue;
        ++cells[i];
        is_true = true;
      }
      if (is_true || std::hypot(x, y) > kRange) continue;
      false_cells += " " + std::to_string(x) + " m ahead, " + std::to_string(y) + " m left;";
      ++found;
    }
  }
  EXPECT_EQ(found, 0) << scene.name << ":" << false_cells;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i]["expect"] == "free" || objects[i]["visible_px"] < kSeenPixels) continue;
    EXPECT_GT(cells[i], 0) << scene.name << ": " << objects[i]["name"];
  }
}

INSTANTIATE_TEST_SUITE_P(All, RenderedScenes,
                         ::testing::Values(Scene{"s1", "--camera-height 0.6 --camera-pitch 5", "indoor"},
                                           Scene{"s2", "--camera-height 0.6 --camera-pitch 5", "indoor"},
                                           Scene{"s3", "--camera-height 0.6 --camera-pitch 5", "indoor"},
                                           Scene{"s4", "--camera-height 0.6 --camera-pitch 0", "indoor"},
                                           Scene{"s5", "--camera-height 0.9 --camera-pitch 10", "outdoor"}),
                         [](const auto& scene) { return std::string(scene.param.name); });

}  // namespace
}  // namespace lakshya

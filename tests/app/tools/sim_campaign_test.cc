// A small campaign with thresholds: what `lakshya sim` drives must not get worse. The figures for many worlds: docs/driving.md.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/support/run_command.h"

namespace lakshya {
namespace {

using Json = nlohmann::json;

struct Campaign {
  int reached = 0;
  int collisions = 0;  // that count: not with glass, nor with who was out of view
  int dropoffs = 0;
  std::string lines;
};

Campaign drive(const std::string& arguments) {
  const Outcome r = run_lakshya("sim --json --jobs 2 " + arguments);
  Campaign c;
  c.lines = r.out;
  std::istringstream lines(r.out);
  for (std::string text; std::getline(lines, text);) {
    const Json line = Json::parse(text);
    if (!line.contains("result")) continue;
    const std::string result = line["result"];
    c.reached += result == "reached" ? 1 : 0;
    c.collisions += result == "collision" && line["excuse"].is_null() ? 1 : 0;
    c.dropoffs += result == "dropoff" ? 1 : 0;
  }
  return c;
}

TEST(SimCampaign, StereoInRooms) {
  const Campaign c = drive("--world random-indoor --seed 501 --count 4");
  EXPECT_GE(c.reached, 2) << c.lines;
  EXPECT_LE(c.collisions, 1) << c.lines;
  EXPECT_EQ(c.dropoffs, 0) << c.lines;
}

TEST(SimCampaign, StereoInGardens) {
  const Campaign c = drive("--world random-outdoor --seed 501 --count 4");
  EXPECT_GE(c.reached, 2) << c.lines;
  EXPECT_LE(c.collisions, 1) << c.lines;
  EXPECT_EQ(c.dropoffs, 0) << c.lines;
}

TEST(SimCampaign, TrueDepthInRooms) {
  const Campaign c = drive("--world random-indoor --seed 501 --count 6 --sensor truth");
  EXPECT_GE(c.reached, 4) << c.lines;
  EXPECT_LE(c.collisions, 1) << c.lines;
}

// The worlds are hard enough: what a laser scanner does not see it drives into.
TEST(SimCampaign, ALaserScannerCollides) {
  const Campaign c = drive("--world random-indoor --seed 501 --count 6 --sensor lidar2d");
  EXPECT_GE(c.collisions + c.dropoffs, 2) << c.lines;
}

}  // namespace
}  // namespace lakshya

#include "app/tools/plan_command.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "app/core/input_error.h"
#include "tests/support/run_command.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

using Json = nlohmann::json;

// 40 x 40 cells of 0.1 m: 4 m ahead, 2 m to each side; `type_of(row, column)` gives each cell.
template <class TypeOf>
std::string map_json(TypeOf type_of) {
  Json type = Json::array();
  for (int r = 0; r < 40; ++r) {
    Json row = Json::array();
    for (int c = 0; c < 40; ++c)
      row.push_back(type_of(r, c));
    type.push_back(row);
  }
  return Json{{"rows", 40}, {"cols", 40}, {"cell_m", 0.1}, {"type", type}}.dump();
}

class PlanCommandTest : public ::testing::Test {
 protected:
  // What `lakshya plan --grid MAP ARGS` prints.
  static std::string run(const std::string& map, std::vector<std::string> args) {
    CLI::App app;
    add_plan_command(app);
    args.insert(args.begin(), {"plan", "--grid", map});
    std::vector<std::string> reversed(args.rbegin(), args.rend());  // CLI11 takes the last first
    std::ostringstream printed;
    std::streambuf* before = std::cout.rdbuf(printed.rdbuf());
    try {
      app.parse(reversed);
    } catch (...) {
      std::cout.rdbuf(before);
      throw;
    }
    std::cout.rdbuf(before);
    return printed.str();
  }

  static Json plan(const std::string& map, std::vector<std::string> args) {
    args.emplace_back("--json");
    return Json::parse(run(map, args));
  }

  TempFolder folder_;
  std::string free_ = folder_.write("free.json", map_json([](int, int) { return 1; }));
  std::string wall_ = folder_.write("wall.json", map_json([](int r, int) { return r == 4 ? 0 : 1; }));
  // A wall 2 m ahead, open between 0.3 and 1.9 m to the left.
  std::string gap_ =
      folder_.write("gap.json", map_json([](int r, int c) { return r == 20 && (c < 1 || c > 16) ? 0 : 1; }));
};

TEST_F(PlanCommandTest, FreeMapGoesToTheTarget) {
  for (const int deg : {-80, -20, 0, 20, 79}) {
    const Json json = plan(free_, {"--target", std::to_string(deg)});
    EXPECT_EQ(json["direction_deg"], deg);
    EXPECT_EQ(json["blocked"], false);
    EXPECT_TRUE(json["recovery_turn"].is_null());
    EXPECT_EQ(json["openings"], (Json{{92.5, -92.5}}));
    EXPECT_EQ(json["histogram"], Json(std::vector<int>(37, 0)));
  }
}

TEST_F(PlanCommandTest, SpeedIsWhatTheGovernorAllows) {
  const Json json = plan(free_, {"--target", "0"});
  EXPECT_EQ(json["clear_distance_m"], 4.0);
  EXPECT_NEAR(json["speed_mps"], 4.0 / 2.8, 1e-6);
  EXPECT_EQ(json["turn_rate_dps"], 0.0);
  EXPECT_EQ(plan(free_, {"--target", "20"})["turn_rate_dps"], 30.0);
}

TEST_F(PlanCommandTest, WallBlocks) {
  const Json json = plan(wall_, {"--target", "10"});
  EXPECT_TRUE(json["direction_deg"].is_null());
  EXPECT_EQ(json["blocked"], true);
  EXPECT_EQ(json["recovery_turn"], "left");
  EXPECT_EQ(json["speed_mps"], 0.0);
  EXPECT_EQ(json["openings"], Json::array());
  EXPECT_EQ(json["histogram"].size(), 37U);
  EXPECT_GT(json["histogram"][18], json["threshold_high"]);
}

TEST_F(PlanCommandTest, HistogramAndOpeningsRunFromRightToLeft) {
  const Json json = plan(gap_, {"--target", "0"});
  EXPECT_GT(json["direction_deg"], 10);
  EXPECT_GT(json["histogram"][16], json["threshold_high"]);  // -10 deg
  EXPECT_EQ(json["histogram"][18 + 6], 0);                   // 30 deg
  double last = -181;
  for (const Json& opening : json["openings"]) {
    EXPECT_GT(opening[0], opening[1]);
    EXPECT_GT(opening[1], last);
    last = opening[0];
  }
}

TEST_F(PlanCommandTest, SettingsReachThePlanner) {
  EXPECT_EQ(plan(wall_, {"--target", "10", "--set", "planner.threshold_high=100000", "--set",
                         "planner.threshold_low=99999"})["blocked"],
            false);
  EXPECT_EQ(
      plan(free_, {"--target", "0", "--profile", "indoor", "--set", "vehicle.max_speed_mps=0.5"})["speed_mps"],
      0.5);
  EXPECT_EQ(plan(free_, {"--target", "0", "--planner", "vfh+"})["direction_deg"], 0);
}

TEST_F(PlanCommandTest, ThePlannerIsChosenByOptionOrKey) {
  EXPECT_EQ(plan(gap_, {"--target", "0"})["planner"], "vfh+");
  const Json by_key = plan(gap_, {"--target", "0", "--set", "planner.name=vfh"});
  const Json by_option = plan(gap_, {"--target", "0", "--planner", "vfh"});
  EXPECT_EQ(by_option, by_key);
  EXPECT_EQ(by_option["planner"], "vfh");
  EXPECT_EQ(by_option["threshold_low"], 250);
  EXPECT_EQ(by_option["threshold_high"], 250);
  EXPECT_NE(by_option["histogram"], plan(gap_, {"--target", "0"})["histogram"]);
  EXPECT_EQ(plan(gap_, {"--target", "0", "--planner", "vfh+", "--set", "planner.name=vfh"})["planner"], "vfh+");
  EXPECT_EQ(plan(free_, {"--target", "-20", "--planner", "vfh"})["direction_deg"], -20);
  EXPECT_EQ(plan(wall_, {"--target", "10", "--planner", "vfh"})["blocked"], true);
  const std::string text = run(free_, {"--target", "0", "--planner", "vfh", "--set", "planner.vfh_threshold=99"});
  EXPECT_NE(text.find("blocked above 99"), std::string::npos) << text;
}

TEST_F(PlanCommandTest, HeadingAndPreviousChoiceCount) {
  // Two gaps, mirror images.
  const std::string two = folder_.write("two.json", map_json([](int r, int c) {
                                          const int outward = c < 20 ? 19 - c : c - 20;
                                          return r == 20 && (outward < 3 || outward > 18) ? 0 : 1;
                                        }));
  EXPECT_GT(plan(two, {"--target", "0"})["direction_deg"], 10);
  EXPECT_LT(plan(two, {"--target", "0", "--previous", "-30"})["direction_deg"], -10);
  EXPECT_LT(plan(two, {"--target", "0", "--heading", "-30"})["direction_deg"], -10);
}

TEST_F(PlanCommandTest, PgmTakesItsCellFromTheConfiguration) {
  std::string pgm = "P2\n40 40\n255\n";
  for (int i = 0; i < 1600; ++i)
    pgm += "254 ";
  const std::string map = folder_.write("map.pgm", pgm);
  EXPECT_EQ(plan(map, {"--target", "0"})["clear_distance_m"], 4.0);
  EXPECT_EQ(plan(map, {"--target", "0", "--set", "grid.cell_m=0.2"})["clear_distance_m"], 8.0);
}

TEST_F(PlanCommandTest, PlainOutputIsATable) {
  const std::string text = run(gap_, {"--target", "0"});
  EXPECT_TRUE(text.starts_with("  direction ")) << text;
  EXPECT_NE(text.find("blocked above 120"), std::string::npos);
  EXPECT_TRUE(run(wall_, {"--target", "0"}).starts_with("  blocked: stop, then turn left"));
}

TEST_F(PlanCommandTest, RefusesMapsAndSettings) {
  EXPECT_THROW(run(folder_.path("none.json"), {"--target", "0"}), InputError);
  EXPECT_THROW(run(free_, {"--target", "0", "--set", "planner.nothing=1"}), InputError);
  EXPECT_THROW(run(free_, {"--target", "0", "--profile", "forest"}), InputError);
}

TEST_F(PlanCommandTest, WrongUseIsAParseError) {
  for (const char* angle : {"nan", "inf", "-inf", "180.1", "-181", "1e9", "left", "20deg", ""}) {
    EXPECT_THROW(run(free_, {"--target", angle}), CLI::ParseError) << angle;
    EXPECT_THROW(run(free_, {"--target", "0", "--heading", angle}), CLI::ParseError) << angle;
    EXPECT_THROW(run(free_, {"--target", "0", "--previous", angle}), CLI::ParseError) << angle;
  }
  EXPECT_NO_THROW(run(free_, {"--target", "-180"}));
  EXPECT_THROW(run(free_, {}), CLI::ParseError);
  EXPECT_THROW(run(free_, {"--target", "0", "--planner", "vfh**"}), CLI::ParseError);
  EXPECT_THROW(run(free_, {"--target", "0", "--unknown-option"}), CLI::ParseError);
}

TEST_F(PlanCommandTest, TheBinaryPlansAndSaysWhatIsWrong) {
  const std::string lakshya = lakshya_binary();
  if (lakshya.empty()) GTEST_SKIP() << "LAKSHYA_BIN names no lakshya";
  const Outcome planned = run_command({lakshya, "plan", "--json", "--target", "-20", "--grid", free_});
  EXPECT_EQ(planned.exit_code, 0);
  EXPECT_EQ(Json::parse(planned.out)["direction_deg"], -20);

  const Outcome refused = run_command({lakshya, "plan", "--target", "0", "--grid", folder_.path("none.json")});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("none.json: "), std::string::npos) << refused.err;

  EXPECT_EQ(run_command({lakshya, "plan", "--target", "nan", "--grid", free_}).exit_code, 2);
  const Outcome help = run_command({lakshya, "plan", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.out.find("Example: lakshya plan"), std::string::npos) << help.out;
}

}  // namespace
}  // namespace lakshya

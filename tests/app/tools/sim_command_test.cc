// lakshya sim and lakshya eval --world, as a user calls them.
#include "app/tools/sim_command.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/run_command.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::vector<Json> lines_of(const std::string& text) {
  std::vector<Json> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    lines.push_back(Json::parse(line));
  return lines;
}

// Without the times of this machine.
Json without_times(Json line) {
  line.erase("frame_ms_p50");
  line.erase("frame_ms_p99");
  return line;
}

TEST(SimCommand, DrivesThroughAnEmptyRoomAndReportsALine) {
  const Outcome r = run_lakshya("sim --world empty-room --seed 1 --json");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const std::vector<Json> lines = lines_of(r.out);
  ASSERT_EQ(lines.size(), 2U);
  const Json& run = lines[0];
  EXPECT_EQ(run["world"], "empty-room");
  EXPECT_EQ(run["result"], "reached");
  EXPECT_TRUE(run["hit"].is_null());
  EXPECT_GT(run["path_m"].get<double>(), 3);
  EXPECT_LT(run["path_m"].get<double>(), 1.2 * run["shortest_m"].get<double>());
  EXPECT_GT(run["frames"].get<int>(), 30);
  EXPECT_EQ(run["false_stops"], 0);
  EXPECT_EQ(lines[1]["reached"], 1);
}

TEST(SimCommand, SameSeedSameDriveOnAnyNumberOfThreads) {
  std::vector<Json> runs;
  for (const char* threads : {"1", "2", "1"}) {
    const Outcome r =
        run_lakshya("sim --world figure-7 --seed 3 --json --set loop.threads=" + std::string(threads));
    ASSERT_EQ(r.exit_code, 0) << r.err;
    runs.push_back(without_times(lines_of(r.out).front()));
  }
  EXPECT_EQ(runs[0], runs[1]);
  EXPECT_EQ(runs[0], runs[2]);
}

// The simulated vehicle has a planner and a mount of its own: what the user asks for takes their place.
TEST(SimCommand, OptionsReplaceWhatTheSimulatedVehicleHas) {
  const std::string command = "sim --world empty-room --seed 1 --sensor truth --json ";
  const Outcome usual = run_lakshya(command);
  const Outcome other = run_lakshya(command + "--planner vfh+ --set camera.pitch_deg=10");
  ASSERT_EQ(usual.exit_code, 0) << usual.err;
  ASSERT_EQ(other.exit_code, 0) << other.err;
  EXPECT_NE(without_times(lines_of(usual.out).front()), without_times(lines_of(other.out).front()));
}

TEST(SimCommand, ACampaignThatWasInterruptedGoesOn) {
  const TempFolder folder;
  const std::string results = folder.path("results.jsonl");
  const std::string command = "sim --world empty-room --sensor truth --json --jobs 2 --results " + results;
  ASSERT_EQ(run_lakshya(command + " --seed 1 --count 2").exit_code, 0);
  {
    std::ofstream torn(results, std::ios::app);
    torn << "{\"world\":\"empt";
  }
  const Outcome r = run_lakshya(command + " --seed 1 --count 3");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(lines_of(r.out).size(), 4U);
  const Outcome other = run_lakshya("sim --world figure-7 --sensor truth --seed 1 --count 2 --results " + results);
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.err.find("name another file"), std::string::npos) << other.err;
}

TEST(SimCommand, DrawsEveryDriveFromAbove) {
  const TempFolder folder;
  const Outcome r =
      run_lakshya("sim --world empty-room --sensor truth --seed 1 --count 2 --record " + folder.path("pictures"));
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_TRUE(fs::exists(folder.path("pictures/empty-room_1_truth.png")));
  EXPECT_TRUE(fs::exists(folder.path("pictures/empty-room_2_truth.png")));
}

TEST(SimCommand, OneDriveWithEverythingToLookAt) {
  const TempFolder folder;
  const Outcome r = run_lakshya("sim --world figure-7 --seed 1 --out " + folder.path("out"));
  ASSERT_EQ(r.exit_code, 0) << r.err;
  for (const char* name : {"course.png", "sheet.png", "drive.webp", "result.json"})
    EXPECT_TRUE(fs::exists(folder.path("out/" + std::string(name)))) << name;
}

TEST(SimCommand, ALaserDoesNotSeeATableTop) {
  const Outcome stereo = run_lakshya("sim --world figure-9 --seed 1 --json");
  EXPECT_EQ(lines_of(stereo.out).front()["result"], "reached") << stereo.out;
}

// Up, along a platform and down again; the way round it is 26 m long.
TEST(SimCommand, DrivesOverARamp) {
  for (const std::string sensor : {"truth", "stereo"}) {
    const Outcome r = run_lakshya("sim --world ramp --seed 1 --json --set prune.slope_deg=10 --sensor " + sensor);
    ASSERT_EQ(r.exit_code, 0) << r.err;
    const Json run = lines_of(r.out).front();
    EXPECT_EQ(run["result"], "reached") << sensor;
    EXPECT_LT(run["path_m"].get<double>(), 14) << sensor;
  }
  const Outcome r = run_lakshya("sim --world ramp --seed 1 --json --sensor truth");
  EXPECT_EQ(lines_of(r.out).front()["result"], "reached") << r.out;
  EXPECT_GT(lines_of(r.out).front()["path_m"].get<double>(), 20) << r.out;
}

TEST(SimCommand, RefusesBadInput) {
  const TempFolder folder;
  const Outcome unknown = run_lakshya("sim --world nowhere");
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_NE(unknown.err.find("no such world"), std::string::npos) << unknown.err;
  EXPECT_NE(unknown.err.find("paper-indoor"), std::string::npos) << unknown.err;

  const std::string file = folder.path("bad.yaml");
  std::ofstream(file) << "name: bad\nindoor: true\nthings:\n  - {kind: dragon, at: [1, 0]}\n";
  const Outcome bad = run_lakshya("sim --world " + file);
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_NE(bad.err.find("bad.yaml:4"), std::string::npos) << bad.err;
  EXPECT_NE(bad.err.find("dragon"), std::string::npos) << bad.err;

  EXPECT_EQ(run_lakshya("sim --world empty-room --size 3x3").exit_code, 2);
  EXPECT_EQ(run_lakshya("sim --world empty-room --sensor sonar").exit_code, 2);
  EXPECT_EQ(run_lakshya("sim").exit_code, 2);
}

TEST(EvalCommand, JudgesTheMapOfADrive) {
  const Outcome r = run_lakshya("eval --world figure-7 --seed 1 --matcher sgm --json");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const Json line = lines_of(r.out).front();
  EXPECT_GT(line["frames"].get<int>(), 30);
  EXPECT_GT(line["cells"].get<int>(), 1000);
  EXPECT_GT(line["precision"].get<double>(), 0.98) << line.dump();
  EXPECT_GT(line["recall"]["box"]["2-4 m"]["recall"].get<double>(), 0.98) << line.dump();
  EXPECT_FALSE(line["false_on"].contains("newspaper")) << line.dump();
}

}  // namespace
}  // namespace lakshya

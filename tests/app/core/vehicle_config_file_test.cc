#include "app/core/vehicle_config_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "app/core/vehicle_config_keys.h"
#include "app/core/vehicle_config_text.h"
#include "tests/support/config_checks.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

class VehicleConfigFile : public ::testing::Test {
 protected:
  std::string file(const std::string& text) const { return temp_.write("vehicle.yaml", text); }
  VehicleConfig load(const std::string& text, const std::string& profile = "",
                     const std::vector<std::string>& sets = {}) const {
    return load_vehicle_config(file(text), profile, sets);
  }
  std::string folder() const { return temp_.path(""); }

 private:
  TempFolder temp_;
};

TEST_F(VehicleConfigFile, LaterSourcesCount) {
  const std::string text =
      "camera: {height_m: 0.5}\n"
      "prune: {max_depth_m: 15, clearance_m: 1.5}\n"
      "vehicle: {max_speed_mps: 2.0}\n"
      "profiles:\n"
      "  indoor:\n"
      "    prune: {max_depth_m: 6, clearance_m: 1.0}\n";
  const VehicleConfig outdoor = load(text);
  EXPECT_EQ(outdoor.camera.height_m, 0.5);
  EXPECT_EQ(outdoor.prune.max_depth_m, 15.0);  // the file over the built-in profile
  EXPECT_EQ(outdoor.vehicle.max_speed_mps, 2.0);
  EXPECT_EQ(outdoor.planner.active_radius_m, 8.0);  // the built-in profile over the default

  const VehicleConfig indoor = load(text, "indoor", {"prune.clearance_m=0.9"});
  EXPECT_EQ(indoor.prune.max_depth_m, 6.0);       // the file's profile over its groups
  EXPECT_EQ(indoor.prune.clearance_m, 0.9);       // --set over everything
  EXPECT_EQ(indoor.vehicle.max_speed_mps, 2.0);   // the file's groups over the built-in profile
  EXPECT_EQ(indoor.vehicle.contact_time_s, 1.5);  // the built-in profile over the default
  EXPECT_EQ(indoor.grid.rows, 200);               // the default
}

TEST_F(VehicleConfigFile, FilesMaySelectAndDefineProfiles) {
  const std::string text = "profile: hall\nprofiles:\n  hall:\n    prune: {max_depth_m: 12}\n  empty: {}\n";
  EXPECT_EQ(load(text).prune.max_depth_m, 12.0);
  EXPECT_EQ(load(text).profile, "hall");
  EXPECT_EQ(load(text).planner.active_radius_m, 5.0);  // no built-in profile of that name
  EXPECT_EQ(load(text, "empty").prune.max_depth_m, 20.0);
  EXPECT_EQ(load(text, "indoor").prune.max_depth_m, 8.0);
  EXPECT_EQ(load("profile: indoor\n").prune.max_depth_m, 8.0);
}

TEST_F(VehicleConfigFile, AFileMayIncludeAnother) {
  std::filesystem::create_directories(folder() + "/base");
  std::ofstream(folder() + "/base/rig.yaml") << "profile: hall\n"
                                                "camera: {height_m: 0.5, pitch_deg: 7}\n"
                                                "profiles:\n"
                                                "  hall:\n"
                                                "    prune: {max_depth_m: 12, clearance_m: 1.0}\n";
  const std::string text =
      "include: base/rig.yaml\ncamera: {height_m: 0.8}\nprofiles: {hall: {prune: {max_depth_m: 9}}, yard: {}}\n";
  const VehicleConfig config = load(text);
  EXPECT_EQ(config.profile, "hall");
  EXPECT_EQ(config.camera.height_m, 0.8);  // its own over the included file's
  EXPECT_EQ(config.camera.pitch_deg, 7.0);
  EXPECT_EQ(config.prune.max_depth_m, 9.0);
  EXPECT_EQ(config.prune.clearance_m, 1.0);
  EXPECT_EQ(load("profile: yard\n" + text).prune.max_depth_m, 20.0);
  EXPECT_EQ(load(text, "", {"camera.pitch_deg=3"}).camera.pitch_deg, 3.0);
}

TEST_F(VehicleConfigFile, RefusesWhatCannotBeIncluded) {
  std::ofstream(folder() + "/bad.yaml") << "camera:\n  height_m: much\n";
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases{
      {"camera: {height_m: 1}\ninclude: nowhere.yaml\n", {"vehicle.yaml:2: include: ", "nowhere.yaml"}},
      {"include: vehicle.yaml\n", {"vehicle.yaml:1: include: 4 files include one another already"}},
      {"include: bad.yaml\n", {"bad.yaml:2: camera.height_m: \"much\" is not a number"}},
      {"include: {a: b}\n", {"vehicle.yaml:1: include: not a single value"}},
      {"include: ''\n", {"vehicle.yaml:1: include: no file"}}};
  for (const auto& [text, parts] : cases)
    expect_parts(refusal([&] { load(text); }), parts);
  expect_parts(refusal([&] { parse_vehicle_config("include: x.yaml\n", "text", "", {}); }),
               {"text:1: include: only a file may include another"});
}

TEST_F(VehicleConfigFile, AcceptsTheFormsThatYamlAllows) {
  EXPECT_EQ(load("camera:\r\n  height_m: +0.5\r\n").camera.height_m, 0.5);
  EXPECT_EQ(load("camera: {height_m: 5e-1}\n...\n").camera.height_m, 0.5);
  EXPECT_EQ(load("---\ncamera: {height_m: &h 0.5}\nvehicle: {radius_m: *h}\n").vehicle.radius_m, 0.5);
  EXPECT_EQ(load("planner: {unknown: \"slow\"}\n").planner.unknown, "slow");
}

TEST(VehicleConfigBoards, EveryBoardsConfigurationIsAccepted) {
  const char* root = std::getenv("LAKSHYA_ROOT");
  if (root == nullptr) GTEST_SKIP() << "LAKSHYA_ROOT does not name the source tree";
  int boards = 0;
  for (const auto& board : std::filesystem::directory_iterator(std::filesystem::path(root) / "boards")) {
    const std::string path = (board.path() / "vehicle.yaml").string();
    EXPECT_EQ(refusal([&] { load_vehicle_config(path, "", {}); }), "accepted") << path;
    ++boards;
  }
  EXPECT_GE(boards, 4);
}

TEST_F(VehicleConfigFile, HostBoardIsTheBuiltInConfiguration) {
  if (std::getenv("LAKSHYA_ROOT") == nullptr) GTEST_SKIP() << "LAKSHYA_ROOT does not name the source tree";
  const std::string host = source_file("boards/host/vehicle.yaml");
  EXPECT_EQ(host, documented_yaml()) << "write it again with `lakshya config`";
  expect_same(load(host), load_vehicle_config("", "", {}));
  for (const Profile& profile : kProfiles) {
    const std::string name(profile.name);
    expect_same(load(host, name), load_vehicle_config("", name, {}));
  }
}

TEST_F(VehicleConfigFile, EffectiveTextReadsBackAsTheSameValues) {
  for (const char* profile : {"outdoor", "indoor"}) {
    const VehicleConfig config = load_vehicle_config(
        "", profile, {"prune.max_depth_m=5", "camera.height_m=0.30000000000000004", "grid.rows=150"});
    const VehicleConfig again = load(effective_yaml(config));
    EXPECT_EQ(again.prune.max_depth_m, 5.0);
    EXPECT_EQ(again.camera.height_m, 0.30000000000000004);
    EXPECT_EQ(again.profile, profile);
    expect_same(again, config);
  }
  const VehicleConfig hall = load("profile: hall\nprofiles: {hall: {prune: {max_depth_m: 12}}}\n");
  expect_same(load(effective_yaml(hall)), hall);
}

TEST_F(VehicleConfigFile, ContradictionNamesTheLineThatCameLast) {
  expect_parts(refusal([&] { load("matcher:\n  p1: 30\n  p2_min: 20\n"); }),
               {"vehicle.yaml:3: matcher.p1: 30 must not"});
  expect_parts(refusal([&] { load("matcher:\n  p1: 30\n", "", {"matcher.p2_min=20"}); }),
               {"--set matcher.p2_min=20: matcher.p1"});
}

TEST_F(VehicleConfigFile, RefusesBrokenFilesWithLineKeyAndReason) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases{
      {"camera:\n  hieght_m: 0.4\n", {"vehicle.yaml:2: ", "unknown key (did you mean camera.height_m?)"}},
      {"camra: {height_m: 0.4}\n", {"vehicle.yaml:1: ", "unknown group (did you mean camera?)"}},
      {"height_m: 0.4\n", {"did you mean camera.height_m?"}},
      {"wobble: {}\n", {"unknown group (known: include, profile, profiles, camera, matcher"}},
      {"camera:\n  height_m: tall\n", {"vehicle.yaml:2: camera.height_m: \"tall\" is not a number"}},
      {"camera: {height_m: \"0.5\"}\n", {"is not a number"}},
      {"matcher: {paths: \"5\"}\n", {"is not a whole number"}},
      {"camera: {height_m: 9}\n", {"is out of range (allowed: 0.05 .. 5 m)"}},
      {"camera: {height_m: .nan}\n", {"is not a number"}},
      {"camera: {height_m: nan}\n", {"is not a finite number"}},
      {"camera: {height_m: .inf}\n", {"is not a number"}},
      {"camera: {height_m: true}\n", {"is not a number"}},
      {"camera: {height_m: [0.5]}\n", {"camera.height_m: not a single value"}},
      {"camera: {height_m: }\n", {"camera.height_m: not a single value"}},
      {"camera: {height_m: 0.5, height_m: 0.5}\n", {"\"height_m\": given twice"}},
      {"camera: {height_m: 0.5}\ncamera: {pitch_deg: 1}\n", {"vehicle.yaml:2: \"camera\": given twice"}},
      {"camera:\n  [a, b]: 1\n", {"vehicle.yaml:2: camera: a key is not a name"}},
      {"camera:\n", {"camera: not a map"}},
      {"camera: 5\n", {"camera: not a map"}},
      {"- camera\n", {"the file: not a map"}},
      {"0.5\n", {"the file: not a map"}},
      {"# nothing\n", {"no settings in it"}},
      {"\n \n", {"no settings in it"}},
      {"camera: {height_m: 0.5\n", {"broken YAML"}},
      {"camera:\n\theight_m: 0.5\n", {"vehicle.yaml:2: broken YAML"}},
      {"camera: *nothing\n", {"broken YAML"}},
      {"camera: {}\n---\ncamera: {}\n", {"several YAML documents"}},
      {",\n", {"no settings in it"}},
      {", camera: {}\n", {"no settings in it"}},
      {"profile: forest\n", {"vehicle.yaml:1: profile: \"forest\" is unknown (known: outdoor, indoor)"}},
      {"profile:\n", {"profile: not a single value"}},
      {"profiles:\n", {"profiles: not a map"}},
      {"profiles: {a b: {}}\n", {"\"a b\" is no profile name"}},
      {"profiles: {\"\": {}}\n", {"\"\" is no profile name"}},
      {"profiles: {hall: 5}\n", {"hall: not a map"}},
      {"profiles: {hall: {max_depth_m: 5}}\n", {"did you mean prune.max_depth_m?"}},
      {"profiles:\n  hall:\n    prune: {max_depth_m: 500}\n",
       {"vehicle.yaml:3: prune.max_depth_m: \"500\" is out of"}},
  };
  for (const auto& [text, parts] : cases) {
    const std::string message = refusal([&, &yaml = text] { load(yaml); });
    expect_parts(message, parts);
    expect_parts(message, {folder()});
  }
}

TEST_F(VehicleConfigFile, RefusesUnknownProfileOption) {
  const std::string text = "profiles: {hall: {}}\n";
  expect_parts(refusal([&] { load(text, "forest"); }),
               {"--profile forest: profile: \"forest\" is unknown (known: outdoor, indoor, hall)"});
  expect_parts(refusal([&] { load("profile: forest\n", "indoor"); }), {"\"forest\" is unknown"});
}

TEST_F(VehicleConfigFile, RefusesFilesThatAreNone) {
  const auto refuse = [](const std::string& path) { return refusal([&] { load_vehicle_config(path, "", {}); }); };
  EXPECT_TRUE(contains(refuse(folder() + "missing.yaml"), "missing.yaml"));
  EXPECT_NE(refuse(folder()), "accepted");
  EXPECT_NE(refuse(file("")), "accepted");
  EXPECT_NE(refuse(file("# " + std::string(std::size_t{1} << 20, 'x') + "\n")), "accepted");
  EXPECT_NE(refuse(file("camera: {height_m: 0.5}\n# " + std::string(std::size_t{1} << 20, 'x') + "\n")),
            "accepted");
}

// Nesting deeper than any stack, and aliases that would unfold to an absurd size.
TEST_F(VehicleConfigFile, RefusesHostileYaml) {
  const auto repeated = [](const std::string& part) {
    std::string text;
    while (text.size() < 100000)
      text += part;
    return text;
  };
  for (const char* part : {"[", "{", "- ", "? ", "a: ", "&a [*a,", "{a: [", "!", "\"", "%"}) {
    EXPECT_NE(refusal([&] { load(repeated(part)); }), "accepted") << part;
  }
  std::string laughs = "a0: &a0 [x, x]\n";
  for (int i = 1; i < 40; ++i) {
    const std::string alias = "*a" + std::to_string(i - 1);
    laughs.append("a").append(std::to_string(i)).append(": &a").append(std::to_string(i));
    laughs.append(" [").append(alias).append(", ").append(alias).append("]\n");
  }
  EXPECT_TRUE(contains(refusal([&] { load(laughs); }), "unknown group"));
}

TEST_F(VehicleConfigFile, DamagedFilesAreReadOrRefused) {
  const std::string whole = documented_yaml();
  for (std::size_t length = 0; length < whole.size(); length += 97) {
    refusal([&] { load(whole.substr(0, length)); });
  }
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = whole;
    for (int flips = 0; flips < 3; ++flips)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    refusal([&] { load(damaged); });  // anything but an InputError fails the test
  }
}

}  // namespace
}  // namespace lakshya

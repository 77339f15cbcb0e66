#include "app/tools/sim/world_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "app/core/input_error.h"
#include "app/tools/sim/free_space.h"
#include "app/tools/sim/named_worlds.h"
#include "app/tools/sim/world_generator.h"
#include "tests/support/config_checks.h"
#include "tests/support/temp_folder.h"

namespace lakshya::sim {
namespace {

std::string world_refusal(const std::string& text) {
  return refusal([&] { parse_world(text, "w.yaml"); });
}

const std::string kEnds = "start: {at: [0, 0]}\ngoals: [[5, 0]]\n";

TEST(WorldFile, EverythingIsTakenAsWritten) {
  const World world = parse_world(R"(name: test
indoor: false
ground: {surface: {texture: grass, albedo: 0.3}, extent: [-10, -10, 20, 10]}
patches:
  - {kind: ramp, rect: [6, -1, 8, 1], up: east, to_m: 0.2}
  - {kind: stairs, rect: [10, 4, 12, 5], down: west, steps: 4, rise_m: 0.2}
  - {kind: pothole, rect: [3, 3, 4, 4], depth_m: 0.3}
  - {kind: kerb, rect: [3, -4, 6, -3]}
things:
  - {kind: box, at: [3, 1], yaw_deg: 90, length_m: 0.4, width_m: 0.6, height_m: 0.5}
  - {kind: box, name: the other, at: [3, -1.5], surface: {texture: metal, contrast: 0.1}}
  - {kind: hanging bar, at: [4, 0], bottom_m: 1.4}
  - {kind: person, walk: {points: [[8, 3], [12, 3]], speed_mps: 0.5, start_m: 1}}
light: {ambient: 0.2, sun: 1, sun_direction: [0, 0, 1], sky: 1, clouds: true, lamps: [{at: [1, 2, 3], strength: 4}]}
start: {at: [0.5, 0], yaw_deg: 90}
goals: [[5, 0], [14, 0]]
time_limit_s: 60
traits: [low sun]
)",
                                  "w.yaml");
  EXPECT_EQ(world.name, "test");
  EXPECT_FALSE(world.indoor);
  EXPECT_EQ(world.ground.surface.texture, Texture::grass);
  EXPECT_EQ(world.ground.x1, 20);
  ASSERT_EQ(world.ground.patches.size(), 1U + 4U + 2U + 1U);
  EXPECT_NEAR(ground_height(world.ground, 7, 0), 0.1, 1e-12);
  EXPECT_NEAR(ground_height(world.ground, 11.9, 4.5), -0.2, 1e-12);  // down to the west
  EXPECT_NEAR(ground_height(world.ground, 10.1, 4.5), -0.8, 1e-12);
  ASSERT_EQ(world.things.size(), 4U);
  EXPECT_EQ(world.things[0].name, "box 1");
  EXPECT_NEAR(world.things[0].mesh.vertices[0].x(), 3.3F, 1e-6F);  // turned: 0.6 m along x
  EXPECT_EQ(world.things[1].name, "the other");
  ASSERT_EQ(world.things[1].mesh.surfaces.size(), 1U);
  EXPECT_EQ(world.things[1].mesh.surfaces[0].texture, Texture::metal);
  EXPECT_EQ(world.things[2].expect, Expect::free);
  ASSERT_TRUE(world.things[3].walk);
  EXPECT_EQ(world.things[3].walk->start_m, 1);
  EXPECT_EQ(world.light.lamps.at(0).strength, 4);
  EXPECT_TRUE(world.light.clouds);
  EXPECT_NEAR(world.start.yaw, 1.5707963267949, 1e-12);
  EXPECT_EQ(world.goals.size(), 2U);
  EXPECT_EQ(world.time_limit_s, 60);
  EXPECT_EQ(world.traits, std::vector<std::string>{"low sun"});
}

TEST(WorldFile, FromAFile) {
  const TempFolder folder;
  EXPECT_EQ(read_world(folder.write("a.yaml", kEnds)).goals.size(), 1U);
  expect_parts(refusal([&] { read_world(folder.path("none.yaml")); }), {"none.yaml"});
}

struct Malformed {
  std::string text;
  std::vector<std::string> parts;  // of the message
};

TEST(WorldFile, RefusalsNameTheLineTheReasonAndWhatToDo) {
  const std::vector<Malformed> table{
      {"", {"w.yaml:1", "not a map"}},
      {"- 1\n", {"w.yaml:1", "not a map"}},
      {"start: {at: [0, 0]\n", {"w.yaml:", "broken YAML"}},
      {kEnds + "wind: 3\n", {"w.yaml:3", "'wind' is unknown", "known: name, indoor, ground"}},
      {kEnds + "name: a\nname: b\n", {"w.yaml:4", "given twice"}},
      {"goals: [[5, 0]]\n", {"w.yaml:1", "start is missing"}},
      {"start: {at: [0, 0]}\n", {"goals is missing"}},
      {"start: {at: [0, 0]}\ngoals: []\n", {"w.yaml:2", "no goal"}},
      {"start: {at: [0]}\ngoals: [[5, 0]]\n", {"w.yaml:1", "start: at", "list of 2 numbers"}},
      {"start: {at: [0, nan]}\ngoals: [[5, 0]]\n", {"w.yaml:1"}},
      {"start: {at: [0, 0], yaw_deg: 999}\ngoals: [[5, 0]]\n", {"w.yaml:1", "999", "-360..360"}},
      {kEnds + "time_limit_s: soon\n", {"w.yaml:3", "time_limit_s", "soon"}},
      {kEnds + "indoor: maybe\n", {"w.yaml:3", "'maybe' is unknown", "true, false"}},
      {kEnds + "things: box\n", {"w.yaml:3", "things", "not a list"}},
      {kEnds + "things:\n  - {kind: dragon, at: [2, 2]}\n",
       {"w.yaml:4", "'dragon' is unknown", "known: box, crate"}},
      {kEnds + "things:\n  - {at: [2, 2]}\n", {"w.yaml:4", "kind is missing"}},
      {kEnds + "things:\n  - {kind: box}\n", {"w.yaml:4", "not one of at and walk"}},
      {kEnds + "things:\n  - {kind: box, at: [2, 2], diameter_m: 1}\n",
       {"w.yaml:4", "'diameter_m' is unknown", "length_m, width_m, height_m"}},
      {kEnds + "things:\n  - kind: box\n    at: [2, 2]\n    height_m: -1\n",
       {"w.yaml:6", "height_m", "-1 is outside"}},
      {kEnds + "things:\n  - {kind: box, at: [2, 2], name: a}\n  - {kind: box, at: [2, 4], name: a}\n",
       {"w.yaml:5", "'a' is given twice"}},
      {kEnds + "things:\n  - {kind: box, at: [0.3, 0]}\n", {"w.yaml:1", "start", "'box 1'", "keep 0.35 m"}},
      {kEnds + "things:\n  - {kind: table, at: [5.8, 0]}\n", {"w.yaml:2", "goals", "'table 1'"}},
      {kEnds + "things:\n  - {kind: person, walk: {points: [[2, 2]]}}\n", {"w.yaml:4", "fewer than two points"}},
      {kEnds + "things:\n  - {kind: box, at: [2, 2], surface: {texture: fur}}\n", {"w.yaml:4", "'fur' is unknown"}},
      {kEnds + "patches:\n  - {kind: ramp, rect: [3, 3, 2, 4], up: east, to_m: 1}\n", {"w.yaml:4", "rect"}},
      {kEnds + "patches:\n  - {kind: ramp, rect: [2, 3, 3, 4], up: left, to_m: 1}\n", {"w.yaml:4", "east, north"}},
      {kEnds + "patches:\n  - {kind: kerb, rect: [2, 3, 3, 4], steps: 2}\n", {"w.yaml:4", "'steps' is unknown"}},
      {kEnds + "patches:\n  - {kind: pothole, rect: [4.5, -1, 6, 1]}\n", {"w.yaml:2", "drop-off"}},
      {kEnds + "patches:\n  - {kind: kerb, rect: [5.1, -1, 6, 1]}\n", {"w.yaml:2", "a step of the ground"}},
      {kEnds + "ground: {extent: [-1, -1, 3, 1]}\n", {"w.yaml:2", "no ground"}},
      {kEnds + "light: {sun_direction: [0, 0, 0]}\n", {"w.yaml:3", "no direction"}},
  };
  for (const Malformed& m : table) {
    SCOPED_TRACE(m.text);
    expect_parts(world_refusal(m.text), m.parts);
  }
}

TEST(NamedWorlds, AllAreRead) {
  EXPECT_GE(world_names().size(), 10U);
  for (const std::string_view name : world_names()) {
    const World world = named_world(name);
    EXPECT_EQ(world.name, name);
    EXPECT_TRUE(std::isfinite(shortest_path_m(world, kWayRadiusM))) << name;
  }
  expect_parts(refusal([] { named_world("moon"); }), {"'moon'", "known: figure-7"});
}

}  // namespace
}  // namespace lakshya::sim

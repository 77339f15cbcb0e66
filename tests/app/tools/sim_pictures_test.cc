#include "app/tools/sim_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/tools/picture_colors.h"
#include "app/tools/sim_course.h"
#include "app/tools/sim_sheet.h"

namespace lakshya {
namespace {

using sim::RunResult;
using sim::Thing;
using sim::World;

constexpr double kRadius = 0.3;
constexpr Rgb8 kFurniture{186, 132, 82};
constexpr Rgb8 kFloor{246, 243, 237};

// A box by its two corners.
Thing box(const char* kind, Eigen::Vector3f low, Eigen::Vector3f high) {
  Thing thing;
  thing.kind = kind;
  thing.name = std::string(kind) + " 1";
  for (int i = 0; i < 8; ++i) {
    thing.mesh.vertices.emplace_back((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                                     (i & 4) != 0 ? high.z() : low.z());
  }
  thing.mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                          {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
  thing.mesh.surface.assign(thing.mesh.triangles.size(), 0);
  thing.mesh.surfaces.resize(1);
  return thing;
}

// A floor of 10 m x 6 m, a cupboard in its middle, from west to east below it.
World room() {
  World world;
  world.name = "room";
  world.ground = {.x0 = 0, .y0 = 0, .x1 = 10, .y1 = 6, .surface = {}, .patches = {}};
  world.things.push_back(box("crate", {4, 3, 0}, {6, 5, 1}));
  world.start = {1, 1.5, 0};
  world.goals = {{9, 1.5}};
  return world;
}

RunResult drive(int points) {
  RunResult r;
  r.world = "room";
  r.sensor = "stereo";
  r.ending = sim::Ending::reached;
  for (int i = 0; i < points; ++i)
    r.trace.push_back(
        {.time_s = i * 0.1, .x = 1 + 0.08 * i, .y = 1.5, .yaw = 0, .speed_mps = 0.8, .blocked = false});
  r.time_s = 0.1 * points;
  return r;
}

bool same(Rgb8 a, Rgb8 b) {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}

int count(const Image<Rgb8>& image, Rgb8 color) {
  int n = 0;
  for (int y = 0; y < image.height(); ++y)
    n += static_cast<int>(std::count_if(image.view().row(y), image.view().row(y) + image.width(),
                                        [&](Rgb8 c) { return same(c, color); }));
  return n;
}

TEST(CoursePicture, ShowsWallToWallAndTheWay) {
  const Image<Rgb8> picture = course_picture(room(), drive(100), kRadius);
  EXPECT_EQ(picture.width(), 1200);
  EXPECT_GT(picture.height(), 500);
  EXPECT_LT(picture.height(), 1200);
  // The crate is 2 m x 2 m, less its rim and its name.
  const double scale = 1152.0 / 10;
  EXPECT_NEAR(count(picture, kFurniture), 4 * scale * scale, 0.35 * 4 * scale * scale);
  EXPECT_GT(count(picture, kFloor), 10'000);
  // The fastest is the end of the scale, 5 px wide and 8 m long.
  EXPECT_GT(count(picture, speed_color(1)), 2000);
}

TEST(CoursePicture, ThingsAreWhereTheyAre) {
  const World world = room();
  const RunResult result = drive(100);
  const CourseView view = course_view(world, result, 1000, 900);
  EXPECT_FALSE(view.turned);
  Canvas map(view.width(), view.height(), kPaper);
  const DrawnWorld drawn = draw_world(map, view, world, 0);
  EXPECT_EQ(drawn.looks, std::set<Look>{Look::furniture});
  const Image<Rgb8> image = map.image();
  const auto at = [&](double x, double y) {
    const Point p = view.at(x, y);
    return image.view().at(static_cast<int>(p.x), static_cast<int>(p.y));
  };
  EXPECT_TRUE(same(at(5, 4), kFurniture));
  EXPECT_TRUE(same(at(4.1, 4.9), kFurniture));
  EXPECT_TRUE(same(at(3.8, 4), kFloor));
  EXPECT_TRUE(same(at(5, 2.8), kFloor));
}

TEST(CoursePicture, ALongWayNorthLiesAcross) {
  World world = room();
  world.ground.y1 = 40;
  world.goals = {{1, 35}};
  const CourseView view = course_view(world, drive(0), 1000, 900);
  EXPECT_TRUE(view.turned);
  EXPECT_GT(view.at(1, 35).x, view.at(1, 1).x);  // north is to the right
  EXPECT_GT(view.at(9, 5).y, view.at(1, 5).y);   // and east below
}

TEST(CoursePicture, WhatHangsAndWhatIsFreeLooksDifferent) {
  const sim::Ground ground;
  Thing bar = box("hanging bar", {0, 0, 0.8F}, {1, 1, 0.9F});
  EXPECT_EQ(look_of(bar, ground), Look::hanging_low);
  bar.expect = sim::Expect::free;
  EXPECT_EQ(look_of(bar, ground), Look::hanging_high);
  Thing paper = box("newspaper", {0, 0, 0}, {1, 1, 0.01F});
  paper.expect = sim::Expect::free;
  EXPECT_EQ(look_of(paper, ground), Look::lying);
  Thing pane = box("pane", {0, 0, 0}, {1, 1, 2});
  pane.expect = sim::Expect::glass;
  EXPECT_EQ(look_of(pane, ground), Look::glass);
  EXPECT_EQ(look_of(box("wall", {0, 0, 0}, {1, 1, 2}), ground), Look::wall);
}

// One thing of two bodies: the wall beside a door, and the lintel over it.
TEST(CoursePicture, DoorsAreOpenFromAboveAndCeilingsAreNotThere) {
  World world = room();
  Thing door = box("doorway", {2, 3, 0}, {3, 4, 2});
  const Thing lintel = box("doorway", {3, 3, 2}, {4, 4, 2.5F});
  for (auto t : lintel.mesh.triangles) {
    for (std::uint32_t& corner : t)
      corner += 8;
    door.mesh.triangles.push_back(t);
  }
  door.mesh.vertices.insert(door.mesh.vertices.end(), lintel.mesh.vertices.begin(), lintel.mesh.vertices.end());
  Thing ceiling = box("ceiling", {0, 0, 2.5F}, {10, 6, 2.5F});
  ceiling.expect = sim::Expect::free;
  world.things = {door, ceiling};
  const CourseView view = course_view(world, drive(100), 1000, 900);
  Canvas map(view.width(), view.height(), kPaper);
  draw_world(map, view, world, 0);
  const Image<Rgb8> image = map.image();
  const Point beside = view.at(2.5, 3.5);
  const Point below = view.at(3.5, 3.5);
  EXPECT_FALSE(same(image.view().at(static_cast<int>(beside.x), static_cast<int>(beside.y)), kFloor));
  EXPECT_TRUE(same(image.view().at(static_cast<int>(below.x), static_cast<int>(below.y)), kFloor));
}

TEST(CoursePicture, WithLittleOrNothingToShow) {
  for (const int points : {0, 1, 2}) {
    World nothing;
    nothing.goals = {{0, 0}};
    EXPECT_EQ(course_picture(nothing, drive(points), kRadius).width(), 1200) << points;
    EXPECT_EQ(course_picture(room(), drive(points), kRadius).width(), 1200) << points;
    EXPECT_EQ(drive_sheet(room(), drive(points), {}, kRadius).width(), 2000) << points;
  }
}

TEST(CoursePicture, EveryEndingIsDrawn) {
  World world = room();
  world.ground.patches.push_back(
      {.x0 = 7, .y0 = 3, .x1 = 8, .y1 = 4, .height_m = -1, .kind = "pothole", .dropoff = true, .surface = {}});
  world.ground.patches.push_back(
      {.x0 = 1, .y0 = 3, .x1 = 3, .y1 = 4, .slope_x = 0.1, .kind = "ramp", .surface = {}});
  Thing person = box("person", {-0.2F, -0.2F, 0}, {0.2F, 0.2F, 1.7F});
  person.walk = sim::Walk{.points = {{3, 1}, {3, 3}}};
  world.things.push_back(person);
  for (std::size_t i = 0; i < sim::kEndingNames.size(); ++i) {
    RunResult r = drive(80);
    r.ending = static_cast<sim::Ending>(i);
    if (r.ending == sim::Ending::collision) r.hit = "crate 1";
    r.min_clearance_m = HUGE_VAL;
    r.shortest_m = HUGE_VAL;
    EXPECT_EQ(course_picture(world, r, kRadius).width(), 1200);
    EXPECT_FALSE(ending_text(r).empty());
  }
}

TEST(WorldLabel, IsAFilesName) {
  EXPECT_EQ(world_label("random-indoor"), "random-indoor");
  EXPECT_EQ(world_label("worlds/my park.yaml"), "my_park");
  EXPECT_EQ(world_label("/a/b/c.yml"), "c");
  EXPECT_EQ(world_label("../.."), "world..");
  EXPECT_EQ(world_label(""), "world");
}

}  // namespace
}  // namespace lakshya

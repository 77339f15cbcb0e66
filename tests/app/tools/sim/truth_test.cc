#include "app/tools/sim/truth.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>

#include "app/tools/sim/free_space.h"
#include "app/tools/sim/random.h"
#include "app/tools/sim/shapes.h"
#include "app/tools/sim/walk.h"
#include "app/tools/sim/world_generator.h"

namespace lakshya::sim {
namespace {

World world_with(std::vector<Thing> things) {
  World world;
  world.things = std::move(things);
  world.goals = {{4, 0}};
  return world;
}

double nearest_m(const World& world, double x, double y, double z_low = 0.05, double z_high = 1.2,
                 double time_s = 0) {
  return TrueGeometry(world).nearest(x, y, z_low, z_high, time_s, true).distance_m;
}

TEST(Truth, TriangleBetweenTwoHeights) {
  // Stands upright over y = 0: 2 m wide at the ground, its tip 2 m up.
  const Eigen::Vector3d a{-1, 0, 0};
  const Eigen::Vector3d b{1, 0, 0};
  const Eigen::Vector3d c{0, 0, 2};
  EXPECT_NEAR(distance_to_triangle(a, b, c, 2, 0, 0, 3), 1, 1e-12);
  EXPECT_NEAR(distance_to_triangle(a, b, c, 2, 0, 1, 3), 1.5, 1e-12);  // half as wide there
  EXPECT_NEAR(distance_to_triangle(a, b, c, 0.3, 0.4, 0, 0.5), 0.4, 1e-12);
  EXPECT_NEAR(distance_to_triangle(a, b, c, 4, 4, 0, 0.5), 5, 1e-12);
  EXPECT_TRUE(std::isinf(distance_to_triangle(a, b, c, 0, 0, 2.1, 3)));
  // Lies flat at 1 m.
  const Eigen::Vector3d p{0, 0, 1};
  const Eigen::Vector3d q{1, 0, 1};
  const Eigen::Vector3d r{0, 1, 1};
  EXPECT_EQ(distance_to_triangle(p, q, r, 0.2, 0.2, 0, 1.2), 0);
  EXPECT_EQ(distance_to_triangle(p, r, q, 0.2, 0.2, 0, 1.2), 0);
  EXPECT_NEAR(distance_to_triangle(p, q, r, 1, 1, 0, 1.2), std::sqrt(0.5), 1e-12);
  EXPECT_TRUE(std::isinf(distance_to_triangle(p, q, r, 0.2, 0.2, 0, 0.9)));
}

TEST(Truth, BoxFaceEdgeAndAbove) {
  const World world = world_with({box({3, 0, 0, 0, 1}, 1, 1, 0.5)});
  EXPECT_NEAR(nearest_m(world, 0, 0), 2.5, 1e-6);
  EXPECT_NEAR(nearest_m(world, 0.5, -2), std::hypot(2, 1.5), 1e-6);
  EXPECT_EQ(nearest_m(world, 3, 0.2), 0);  // over its top
  EXPECT_TRUE(std::isinf(nearest_m(world, 0, 0, 0.6, 1.2)));
  EXPECT_TRUE(std::isinf(nearest_m(world_with({}), 0, 0)));
}

TEST(Truth, TableTopCountsAboveItsLegs) {
  const World world = world_with({table({3, 0, 0, 0, 1}, 1.4, 0.8, 0.72)});
  EXPECT_NEAR(nearest_m(world, 0, 0), 2.3, 1e-6);                                 // the top's edge
  EXPECT_NEAR(nearest_m(world, 0, 0, 0.05, 0.5), std::hypot(2.33, 0.325), 1e-6);  // a leg
  EXPECT_EQ(nearest_m(world, 3, 0), 0);
  EXPECT_GT(nearest_m(world, 3, 0, 0.05, 0.5), 0.6);
}

TEST(Truth, ShelfBoardAndHangingBar) {
  const World shelf_world = world_with({shelf({3, 0, 3.14159265358979, 0, 1}, 1, 1.6, 0.7, 0.3)});
  EXPECT_NEAR(nearest_m(shelf_world, 0, 0), 3 - 0.475, 1e-6);
  EXPECT_NEAR(nearest_m(shelf_world, 0, 0, 0.05, 0.6), 3 - 0.175, 1e-6);

  const double along_y = 3.14159265358979 / 2;
  EXPECT_NEAR(nearest_m(world_with({hanging_bar({3, 0, along_y, 1.1, 1}, 1.2, 0.06)}), 0, 0), 2.97, 1e-6);
  EXPECT_TRUE(std::isinf(nearest_m(world_with({hanging_bar({3, 0, along_y, 1.3, 1}, 1.2, 0.06)}), 0, 0)));
}

TEST(Truth, GlassOnRequest) {
  const World world =
      world_with({box({6, 0, 0, 0, 1}, 1, 1, 1), glass_pane({3, 0, 1.5707963267949, 0, 1}, 2, 2.1)});
  const TrueGeometry truth(world);
  EXPECT_EQ(truth.nearest(0, 0, 0.05, 1.2, 0, true).thing, 1);
  EXPECT_EQ(truth.nearest(0, 0, 0.05, 1.2, 0, false).thing, 0);
}

TEST(Truth, WalkerWhereHeIs) {
  Thing walker = box({0, 0, 0, 0, 1}, 0.4, 0.2, 1.7);
  walker.walk = Walk{{{2, 0}, {2, 4}}, 1, 0};
  const World world = world_with({walker});
  EXPECT_NEAR(nearest_m(world, 0, 0, 0.05, 1.2, 0.5), std::hypot(1.9, 0.3),
              1e-6);  // turned north, 0.2 wide, 0.4 long
  EXPECT_NEAR(nearest_m(world, 0, 4, 0.05, 1.2, 4), 1.9, 1e-6);
  EXPECT_NEAR(nearest_m(world, 2, 0, 0.05, 1.2, 6), 1.8, 1e-6);  // on his way back at y = 2
}

TEST(Walk, ThereAndBack) {
  const Walk walk{{{0, 0}, {2, 0}, {2, 1}}, 0.5, 1};
  EXPECT_NEAR(place_on_walk(walk, 0).x, 1, 1e-12);
  EXPECT_NEAR(place_on_walk(walk, 0).yaw, 0, 1e-12);
  const Place corner = place_on_walk(walk, 3);  // 2.5 m along
  EXPECT_NEAR(corner.y, 0.5, 1e-12);
  EXPECT_NEAR(corner.yaw, 1.5707963267949, 1e-9);
  const Place back = place_on_walk(walk, 5);  // 3.5 m along a way of 3 m
  EXPECT_NEAR(back.y, 0.5, 1e-12);
  EXPECT_NEAR(back.yaw, -1.5707963267949, 1e-9);
  EXPECT_NEAR(place_on_walk(walk, 10).x, 0, 1e-12);  // home again after 6 m
  EXPECT_EQ(place_on_walk({{{1, 2}}, 1, 0}, 7).x, 1);
}

TEST(Truth, KerbsRampSidesAndDropOffs) {
  World world = world_with({});
  add_kerb(world.ground, {2, -1, 3, 1}, 0.12, {});
  add_pothole(world.ground, {5, 0, 6, 1}, 0.2, {});
  add_ramp(world.ground, {0, 4, 2, 6}, Towards::east, 0, 0.2, {});
  add_platform(world.ground, {2, 4, 4, 6}, 0.2, {});
  const TrueGeometry truth(world);
  const Nearest kerb = truth.nearest(0, 0, 0.05, 1.2, 0, true);
  EXPECT_NEAR(kerb.distance_m, 2, 1e-9);
  EXPECT_EQ(kerb.thing, -1);
  EXPECT_EQ(kerb.patch, 0);
  EXPECT_TRUE(truth.dropoff_at(5.5, 0.5));
  EXPECT_FALSE(truth.dropoff_at(5.02, 0.02));  // its corners are filled
  EXPECT_FALSE(truth.dropoff_at(2.5, 0));
  // The ramp is 10 cm high at x = 1: from there on its side is a step; its foot and its joint with the platform are none.
  EXPECT_NEAR(truth.nearest(0.5, 3.5, 0, 1, 0, true).distance_m, std::hypot(0.5, 0.5), 0.011);
  EXPECT_NEAR(truth.nearest(0, 4.6, 0, 1, 0, true).distance_m, std::hypot(1.0, 0.6), 0.02);
  EXPECT_NEAR(truth.nearest(2, 5, 0, 1, 0, true).distance_m, 1, 1e-9);
}

// The grid against a search of every triangle.
TEST(Truth, GridFindsWhatIsNearestAndIsQuick) {
  const World world = random_world(Kind::outdoor, 3);
  const TrueGeometry truth(world);
  Random random(7);
  constexpr int kQueries = 300;
  std::chrono::steady_clock::duration spent{};
  for (int i = 0; i < kQueries; ++i) {
    const double x = random.uniform(-2, 18);
    const double y = random.uniform(-2, 9);
    const auto before = std::chrono::steady_clock::now();
    const Nearest nearest = truth.nearest(x, y, 0.05, 1.2, 1, true);
    spent += std::chrono::steady_clock::now() - before;
    double best = std::numeric_limits<double>::infinity();
    for (const Thing& thing : world.things) {
      if (thing.walk || thing.expect == Expect::free) continue;
      for (const auto& t : thing.mesh.triangles) {
        best = std::min(best, distance_to_triangle(thing.mesh.vertices[t[0]].cast<double>(),
                                                   thing.mesh.vertices[t[1]].cast<double>(),
                                                   thing.mesh.vertices[t[2]].cast<double>(), x, y, 0.05, 1.2));
      }
    }
    const bool static_thing = nearest.thing >= 0 && !world.things[static_cast<std::size_t>(nearest.thing)].walk;
    if (static_thing) {
      EXPECT_NEAR(nearest.distance_m, best, 1e-9);
    } else {
      EXPECT_LE(nearest.distance_m, best);
    }
  }
  const double microseconds = std::chrono::duration<double, std::micro>(spent).count() / kQueries;
  RecordProperty("microseconds_per_query", std::to_string(microseconds));
  std::cout << "a query takes " << microseconds << " us\n";
  EXPECT_LT(microseconds, 200);  // 20 with optimisation on an idle machine; sanitizers are slow
}

TEST(FreeSpace, RoundOneWall) {
  // From (0, 0) to (4, 0) round the end of a thin wall at x = 2 that reaches far to the south and to y = 1.
  World world = world_with({wall({2, -4, 1.5707963267949, 0, 1}, 10, 0.02, 2)});
  const double radius = 0.35;
  // Two tangents to the circle round the wall's end, and the arc between them.
  const double d = std::hypot(2, 1);
  const double tangent = std::sqrt(d * d - radius * radius);
  const double bend = 2 * (std::atan2(1, 2) + std::asin(radius / d));
  EXPECT_NEAR(shortest_path_m(world, radius), 2 * tangent + radius * bend, 0.04);
  EXPECT_NEAR(shortest_path_m(world_with({}), radius), 4, 1e-9);
  world.goals = {{2.1, -2}};
  EXPECT_TRUE(std::isinf(shortest_path_m(world, radius)));  // the goal is not free
}

TEST(FreeSpace, AGapIsPassedByWhatFits) {
  World world = world_with({doorway({2, 0, 1.5707963267949, 0, 1}, 60, 1.0, 2.5)});
  world.ground.y0 = -20;
  world.ground.y1 = 20;
  EXPECT_NEAR(shortest_path_m(world, 0.45), 4, 0.05);
  EXPECT_TRUE(std::isinf(shortest_path_m(world, 0.55)));
}

}  // namespace
}  // namespace lakshya::sim

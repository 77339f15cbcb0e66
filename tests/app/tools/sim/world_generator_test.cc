#include "app/tools/sim/world_generator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <iostream>
#include <set>

#include "app/tools/sim/free_space.h"
#include "app/tools/sim/shapes.h"
#include "app/tools/sim/truth.h"
#include "tests/support/emulated.h"

namespace lakshya::sim {
namespace {

// A sanitizer makes everything ten times slower.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define LAKSHYA_SLOW 1
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define LAKSHYA_SLOW 1
#endif
#ifdef LAKSHYA_SLOW
constexpr int kSeeds = 8;
constexpr double kMostSeconds = 10;
#else
constexpr int kSeeds = 40;
constexpr double kMostSeconds = 0.5;
#endif

bool same(const World& a, const World& b) {
  if (a.things.size() != b.things.size() || a.start.yaw != b.start.yaw || a.goals != b.goals) return false;
  for (std::size_t i = 0; i < a.things.size(); ++i) {
    const Thing& s = a.things[i];
    const Thing& t = b.things[i];
    if (s.name != t.name || s.mesh.vertices != t.mesh.vertices || s.mesh.surfaces != t.mesh.surfaces) return false;
  }
  return a.ground.patches.size() == b.ground.patches.size() && a.traits == b.traits;
}

bool straight_line_is_blocked(const World& world, const TrueGeometry& truth) {
  const Eigen::Vector2d from{world.start.x, world.start.y};
  for (int i = 0; i <= 300; ++i) {
    const Eigen::Vector2d p = from + (world.goals.front() - from) * (i / 300.0);
    const double z = ground_height(world.ground, p.x(), p.y());
    if (truth.nearest(p.x(), p.y(), z + 0.05, z + kClearanceM, 0, true).distance_m < kRobotRadiusM) return true;
    if (truth.dropoff_at(p.x(), p.y())) return true;
  }
  return false;
}

void expect_course(const World& world, double least_m, double most_m) {
  SCOPED_TRACE(world.name);
  const Eigen::Vector2d from{world.start.x, world.start.y};
  const Eigen::Vector2d ahead = world.goals.front() - from;
  EXPECT_GE(obstacle_count(world) / drivable_area_m2(world), kLeastDensity);
  const double path = shortest_path_m(world, kWayRadiusM);
  EXPECT_TRUE(std::isfinite(path));
  EXPECT_GE(ahead.norm(), least_m);
  EXPECT_LE(ahead.norm(), most_m);
  EXPECT_LE(std::abs(std::remainder(std::atan2(ahead.y(), ahead.x()) - world.start.yaw, 2 * 3.14159265358979)),
            40 * 3.14159265358979 / 180);

  const TrueGeometry truth(world);
  EXPECT_GE(truth.nearest(from.x(), from.y(), 0.05, kClearanceM, 0, true).distance_m, 0.9);
  World still = world;  // who walks may come to the goal, and goes on
  std::erase_if(still.things, [](const Thing& t) { return t.walk.has_value(); });
  EXPECT_GE(TrueGeometry(still)
                .nearest(world.goals.front().x(), world.goals.front().y(), 0.05, kClearanceM, 0, true)
                .distance_m,
            0.8);
  EXPECT_TRUE(straight_line_is_blocked(world, truth));

  std::set<std::string> names;
  for (const Thing& thing : world.things)
    EXPECT_TRUE(names.insert(thing.name).second) << thing.name;
}

void expect_courses(Kind kind, double least_m, double most_m) {
  std::clock_t spent = 0;  // the processor's time: other programs do not count
  for (int seed = 0; seed < kSeeds; ++seed) {
    const std::clock_t before = std::clock();
    const World world = random_world(kind, static_cast<std::uint64_t>(seed));
    spent += std::clock() - before;
    expect_course(world, least_m, most_m);
  }
  const double seconds = static_cast<double>(spent) / CLOCKS_PER_SEC / kSeeds;
  std::cout << "a world takes " << seconds << " s\n";
  EXPECT_LT(is_emulated() ? 0 : seconds, kMostSeconds);
}

TEST(WorldGenerator, IndoorCourses) {
  expect_courses(Kind::indoor, 6.5, 13);
}

TEST(WorldGenerator, OutdoorCourses) {
  expect_courses(Kind::outdoor, 12, 16.5);
}

TEST(WorldGenerator, ASeedIsAWorld) {
  for (const Kind kind : {Kind::indoor, Kind::outdoor}) {
    const World first = random_world(kind, 11);
    EXPECT_TRUE(same(first, random_world(kind, 11)));
    for (std::uint64_t seed = 12; seed < 15; ++seed)
      EXPECT_FALSE(same(first, random_world(kind, seed)));
  }
}

}  // namespace
}  // namespace lakshya::sim

// What a world is like as a course: its ways, its area, its obstacles.
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/tools/sim/free_space.h"
#include "app/tools/sim/shapes.h"

namespace lakshya::sim {
namespace {

constexpr double kAroundM = 2;  // a way round everything needs no more
constexpr double kCells = 2e6;  // at most about so many

// Round what stands, drops off, start and goals, as far as there is ground.
Rect bounds_of(const World& world) {
  Eigen::Vector2d low{world.start.x, world.start.y};
  Eigen::Vector2d high = low;
  const auto include = [&](const Eigen::Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  };
  for (const Eigen::Vector2d& goal : world.goals)
    include(goal);
  for (const Thing& thing : world.things) {
    if (thing.walk) continue;
    for (const Eigen::Vector3f& v : thing.mesh.vertices)
      include(v.head<2>().cast<double>());
  }
  for (const GroundPatch& p : world.ground.patches) {
    if (p.kind == "path") continue;
    include({p.x0, p.y0});
    include({p.x1, p.y1});
  }
  const Ground& g = world.ground;
  return {std::max(low.x() - kAroundM, g.x0), std::max(low.y() - kAroundM, g.y0),
          std::min(high.x() + kAroundM, g.x1), std::min(high.y() + kAroundM, g.y1)};
}

bool touch(const Rect& a, const Rect& b) {
  constexpr double kJoint = 0.01;
  return a.x0 <= b.x1 + kJoint && b.x0 <= a.x1 + kJoint && a.y0 <= b.y1 + kJoint && b.y0 <= a.y1 + kJoint;
}

}  // namespace

FreeSpace free_space(const World& world, double cell_m, double reach_m) {
  const Rect area = bounds_of(world);
  const double size = std::max((area.x1 - area.x0) * (area.y1 - area.y0), 0.0);
  FreeSpace space(world.ground, area, std::max(cell_m, std::sqrt(size / kCells)), reach_m);
  for (const Thing& thing : world.things)
    space.add(thing);
  return space;
}

double shortest_path_m(const World& world, double radius_m) {
  const FreeSpace space = free_space(world, 0.025, radius_m + 0.01);
  Eigen::Vector2d at{world.start.x, world.start.y};
  double length = 0;
  for (const Eigen::Vector2d& goal : world.goals) {
    length += space.path_m(at, goal, radius_m);
    at = goal;
  }
  return length;
}

bool is_boundary(const Thing& thing) {
  return thing.kind == "wall" || thing.kind == "doorway" || thing.kind == "hedge" || thing.kind == "fence";
}

int obstacle_count(const World& world) {
  int count = static_cast<int>(std::count_if(world.things.begin(), world.things.end(), [](const Thing& t) {
    return t.expect != Expect::free && !is_boundary(t);
  }));
  const auto& patches = world.ground.patches;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!patches[i].dropoff) continue;
    const bool counted =
        std::any_of(patches.begin(), patches.begin() + static_cast<std::ptrdiff_t>(i), [&](const auto& p) {
          return p.dropoff && p.kind == patches[i].kind && touch(rect_of(p), rect_of(patches[i]));
        });
    if (!counted) ++count;
  }
  return count;
}

double drivable_area_m2(const World& world) {
  World bare = world;
  std::erase_if(bare.things, [](const Thing& t) { return !is_boundary(t); });
  bare.ground.patches.clear();
  return free_space(bare, 0.05, 0.1).area_m2({world.start.x, world.start.y}, 0.03);
}

}  // namespace lakshya::sim

// Rooms: their plan, walls, floor and light. What stands in them: course_furniture.cc.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/tools/sim/course.h"
#include "app/tools/sim/world_generator.h"

namespace lakshya::sim {
namespace {

constexpr double kWallM = 0.1;
constexpr double kPi = std::numbers::pi;
constexpr double kNoDoor = -1;

struct Look {
  Surface wall;
  Surface floor;
};

void draw_traits(World& world, Random& random) {
  const double what = random.uniform(0, 1);
  if (what < 0.15) {
    world.traits.emplace_back("low texture");
  } else if (what < 0.25) {
    world.traits.emplace_back("repetitive texture");
  }
  if (random.chance(0.1)) world.traits.emplace_back("low light");
  if (random.chance(0.06)) world.traits.emplace_back("glass");
}

Look draw_look(const World& world, Random& random) {
  Look look;
  look.wall.seed = random.seed();
  look.floor.seed = random.seed();
  if (has_trait(world, "low texture")) {
    look.wall = {Texture::plain, 0.7F, 0.1F, 1, look.wall.seed};
    look.floor = {Texture::concrete, 0.5F, 0.15F, 1, look.floor.seed};
  } else if (has_trait(world, "repetitive texture")) {
    look.wall = {Texture::wallpaper, 0.55F, 0.7F, static_cast<float>(random.uniform(0.1, 0.3)), look.wall.seed};
    look.floor = {Texture::tiles, 0.5F, 0.5F, 0.3F, look.floor.seed};
  } else {
    constexpr std::array<Surface, 3> kWalls{{{Texture::plaster, 0.65F, 0.4F, 0.8F, 1},
                                             {Texture::brick, 0.45F, 0.6F, 0.25F, 1},
                                             {Texture::concrete, 0.5F, 0.5F, 1.0F, 1}}};
    constexpr std::array<Surface, 4> kFloors{{{Texture::wood, 0.4F, 0.5F, 0.5F, 1},
                                              {Texture::carpet, 0.35F, 0.5F, 0.2F, 1},
                                              {Texture::tiles, 0.55F, 0.4F, 0.4F, 1},
                                              {Texture::concrete, 0.45F, 0.5F, 0.8F, 1}}};
    const Surface wall = kWalls[static_cast<std::size_t>(random.integer(0, 2))];
    const Surface floor = kFloors[static_cast<std::size_t>(random.integer(0, 3))];
    look.wall = {wall.texture, wall.albedo, wall.contrast, wall.scale_m, look.wall.seed};
    look.floor = {floor.texture, floor.albedo, floor.contrast, floor.scale_m, look.floor.seed};
  }
  return look;
}

// Between two points.
void add_wall(Course& course, const Look& look, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d middle = (from + to) / 2;
  const Eigen::Vector2d along = to - from;
  if (along.norm() < 0.01) return;
  Thing thing =
      wall({middle.x(), middle.y(), std::atan2(along.y(), along.x()), 0, 1}, along.norm(), kWallM, kCeilingM);
  Surface surface = look.wall;
  surface.seed = course.random().seed();
  paint(thing, surface);
  course.add_boundary(std::move(thing));
}

// A wall across the room at x, from y0 to y1, with a doorway.
void add_wall_with_door(Course& course, const Look& look, double x, double y0, double y1, double door,
                        double opening) {
  constexpr double kJamb = 0.15;
  const double half = opening / 2 + kJamb;
  Thing thing = doorway({x, door, kPi / 2, 0, 1}, 2 * half, opening, kCeilingM);
  paint(thing, look.wall);
  // Its hull would close the opening: the jambs are the walls beside it.
  course.add(std::move(thing));
  add_wall(course, look, {x, y0}, {x, door - half});
  add_wall(course, look, {x, door + half}, {x, y1});
  course.keep_clear({x, door}, 1.0);
}

void add_walls_around(Course& course, const Look& look, const Rect& r, double west_gap_y0, double west_gap_y1) {
  constexpr double kHalf = kWallM / 2;
  add_wall(course, look, {r.x0 - kWallM, r.y0 - kHalf}, {r.x1 + kWallM, r.y0 - kHalf});
  add_wall(course, look, {r.x0 - kWallM, r.y1 + kHalf}, {r.x1 + kWallM, r.y1 + kHalf});
  add_wall(course, look, {r.x1 + kHalf, r.y0}, {r.x1 + kHalf, r.y1});
  if (west_gap_y1 > west_gap_y0) {
    add_wall(course, look, {r.x0 - kHalf, r.y0}, {r.x0 - kHalf, west_gap_y0});
    add_wall(course, look, {r.x0 - kHalf, west_gap_y1}, {r.x0 - kHalf, r.y1});
  } else {
    add_wall(course, look, {r.x0 - kHalf, r.y0}, {r.x0 - kHalf, r.y1});
  }
}

void add_ceiling_and_lamps(Course& course, const Rect& r) {
  course.add(ceiling({(r.x0 + r.x1) / 2, (r.y0 + r.y1) / 2, 0, kCeilingM, 1}, r.x1 - r.x0 + 2 * kWallM,
                     r.y1 - r.y0 + 2 * kWallM));
  const int lamps = std::max(1, static_cast<int>((r.x1 - r.x0) / 3.5));
  for (int i = 0; i < lamps; ++i) {
    Lamp lamp;
    lamp.position = {r.x0 + (r.x1 - r.x0) * (i + 0.5) / lamps, (r.y0 + r.y1) / 2, kCeilingM - 0.15};
    lamp.strength = course.random().uniform(1.6, 2.4);
    course.world().light.lamps.push_back(lamp);
  }
}

struct Plan {
  std::vector<Rect> rooms;
  double door_x = kNoDoor, door_y = 0, door_m = 0;
};

Plan draw_plan(World& world, Random& random) {
  Plan plan;
  Eigen::Vector2d west;
  Eigen::Vector2d east;
  const int layout = random.integer(0, 2);
  if (layout < 2) {  // one room, or two with a doorway
    const double length = random.uniform(9.4, 13.0);
    const double width = random.uniform(4.2, 6.2);
    west = {random.uniform(1.05, 1.3), random.uniform(1.1, width - 1.1)};
    east = {length - random.uniform(1.05, 1.3), random.uniform(1.1, width - 1.1)};
    plan.rooms = {{0, 0, length, width}};
    if (layout == 1) {
      plan.door_x = length * random.uniform(0.4, 0.6);
      plan.door_y = random.uniform(1.0, width - 1.0);
      plan.door_m = random.uniform(1.05, 1.4);
      plan.rooms = {{0, 0, plan.door_x - 0.06, width}, {plan.door_x + 0.06, 0, length, width}};
    }
  } else {  // a corridor that opens into a room
    const double length = random.uniform(4.5, 5.8);
    const double width = random.uniform(2.2, 2.8);
    const Rect room{length, -random.uniform(0.5, 3.2), length + random.uniform(5.5, 7.0),
                    width + random.uniform(0.8, 2.5)};
    west = {random.uniform(1.05, 1.3), random.uniform(1.05, width - 1.05)};
    east = {room.x1 - random.uniform(1.05, 1.3), random.uniform(room.y0 + 1.1, room.y1 - 1.1)};
    plan.rooms = {{0, 0, length, width}, room};
  }
  if (random.chance(0.5)) std::swap(west, east);
  const Eigen::Vector2d ahead = east - west;
  world.start = {west.x(), west.y(), std::atan2(ahead.y(), ahead.x()) + random.uniform(-0.65, 0.65)};
  world.goals = {east};
  return plan;
}

void build_walls(Course& course, const Plan& plan, const Look& look) {
  const Rect& a = plan.rooms.front();
  const Rect& b = plan.rooms.back();
  if (plan.door_x > 0 || plan.rooms.size() == 1) {
    const Rect hall{a.x0, a.y0, b.x1, a.y1};
    add_walls_around(course, look, hall, 0, 0);
    add_ceiling_and_lamps(course, hall);
    if (plan.door_x > 0) add_wall_with_door(course, look, plan.door_x, a.y0, a.y1, plan.door_y, plan.door_m);
    return;
  }
  constexpr double kHalf = kWallM / 2;
  add_walls_around(course, look, b, a.y0, a.y1);
  add_wall(course, look, {a.x0 - kWallM, a.y0 - kHalf}, {a.x1 - kWallM, a.y0 - kHalf});
  add_wall(course, look, {a.x0 - kWallM, a.y1 + kHalf}, {a.x1 - kWallM, a.y1 + kHalf});
  add_wall(course, look, {a.x0 - kHalf, a.y0}, {a.x0 - kHalf, a.y1});
  add_ceiling_and_lamps(course, a);
  add_ceiling_and_lamps(course, b);
}

}  // namespace

bool furnish_indoor(World& world, Random& random) {
  draw_traits(world, random);
  const Look look = draw_look(world, random);
  const Plan plan = draw_plan(world, random);
  const Rect& a = plan.rooms.front();
  const Rect& b = plan.rooms.back();
  world.ground = {a.x0 - 1, std::min(a.y0, b.y0) - 1, b.x1 + 1, std::max(a.y1, b.y1) + 1, look.floor, {}};
  world.light.ambient = 0.35;
  world.light.sky = 0.6;

  Course course(world, random, plan.rooms);
  build_walls(course, plan, look);
  maybe_add_indoor_stairs(course, b);
  if (!course.begin(0.025)) return false;
  if (has_trait(world, "low light")) {
    world.light.ambient = 0.04;
    for (Lamp& lamp : world.light.lamps)
      lamp.strength *= 0.12;
  }
  furnish_rooms(course);
  if (random.chance(1 / 3.0)) {
    if (const auto walk = course.crossing_walk()) {
      const std::uint32_t seed = random.seed();
      course.add(walking_person(*walk, random.uniform(1.6, 1.85), seed));
    }
  }
  add_what_is_passed(course);
  return course.density() >= kLeastDensity && course.on_the_straight_line() >= 2;
}

}  // namespace lakshya::sim

// Rooms: walls, floor and light first, then what is on the straight way, then furniture until the room is full enough.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/tools/sim/course.h"
#include "app/tools/sim/world_generator.h"

namespace lakshya::sim {
namespace {

constexpr double kWall_m = 0.1;
constexpr double kPi = std::numbers::pi;
constexpr double kNoDoor = -1;

struct Look {
  Surface wall;
  Surface floor;
};

bool has(const World& world, std::string_view trait) {
  return std::find(world.traits.begin(), world.traits.end(), trait) != world.traits.end();
}

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
  if (has(world, "low texture")) {
    look.wall = {Texture::plain, 0.7F, 0.1F, 1, look.wall.seed};
    look.floor = {Texture::concrete, 0.5F, 0.15F, 1, look.floor.seed};
  } else if (has(world, "repetitive texture")) {
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

// A straight wall between two points of a line along an axis, with an opening about `door` (kNoDoor: none).
void add_wall(Course& course, const Look& look, Eigen::Vector2d from, Eigen::Vector2d to) {
  const Eigen::Vector2d middle = (from + to) / 2;
  const Eigen::Vector2d along = to - from;
  if (along.norm() < 0.01) return;
  Thing thing =
      wall({middle.x(), middle.y(), std::atan2(along.y(), along.x()), 0, 1}, along.norm(), kWall_m, kCeiling_m);
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
  Thing thing = doorway({x, door, kPi / 2, 0, 1}, 2 * half, opening, kCeiling_m);
  paint(thing, look.wall);
  // Its hull would close the opening: the jambs are the walls beside it.
  course.add(std::move(thing));
  add_wall(course, look, {x, y0}, {x, door - half});
  add_wall(course, look, {x, door + half}, {x, y1});
  course.keep_clear({x, door}, 1.0);
}

void add_walls_around(Course& course, const Look& look, const Rect& r, double west_gap_y0, double west_gap_y1) {
  constexpr double kHalf = kWall_m / 2;
  add_wall(course, look, {r.x0 - kWall_m, r.y0 - kHalf}, {r.x1 + kWall_m, r.y0 - kHalf});
  add_wall(course, look, {r.x0 - kWall_m, r.y1 + kHalf}, {r.x1 + kWall_m, r.y1 + kHalf});
  add_wall(course, look, {r.x1 + kHalf, r.y0}, {r.x1 + kHalf, r.y1});
  if (west_gap_y1 > west_gap_y0) {
    add_wall(course, look, {r.x0 - kHalf, r.y0}, {r.x0 - kHalf, west_gap_y0});
    add_wall(course, look, {r.x0 - kHalf, west_gap_y1}, {r.x0 - kHalf, r.y1});
  } else {
    add_wall(course, look, {r.x0 - kHalf, r.y0}, {r.x0 - kHalf, r.y1});
  }
}

void add_ceiling_and_lamps(Course& course, const Rect& r) {
  course.add(ceiling({(r.x0 + r.x1) / 2, (r.y0 + r.y1) / 2, 0, kCeiling_m, 1}, r.x1 - r.x0 + 2 * kWall_m,
                     r.y1 - r.y0 + 2 * kWall_m));
  const int lamps = std::max(1, static_cast<int>((r.x1 - r.x0) / 3.5));
  for (int i = 0; i < lamps; ++i) {
    Lamp lamp;
    lamp.position = {r.x0 + (r.x1 - r.x0) * (i + 0.5) / lamps, (r.y0 + r.y1) / 2, kCeiling_m - 0.15};
    lamp.strength = course.random().uniform(1.6, 2.4);
    course.world().light.lamps.push_back(lamp);
  }
}

Thing draw_piece(int which, const Eigen::Vector2d& at, Random& random) {
  const Spot spot{at.x(), at.y(), random.uniform(-kPi, kPi), 0, random.seed()};
  Spot low = spot;
  low.bottom_m = random.uniform(0.7, 1.1);
  const double straight = 0.5 * kPi * random.integer(0, 3) + random.uniform(-0.15, 0.15);
  Spot squared = spot;
  squared.yaw = straight;
  switch (which) {
    case 0:
    case 1:
      return box(spot, random.uniform(0.3, 0.6), random.uniform(0.25, 0.5), random.uniform(0.3, 1.0));
    case 2:
      return box(spot, random.uniform(0.25, 0.45), random.uniform(0.2, 0.35), random.uniform(0.12, 0.3));
    case 3:
    case 4:
      return chair(spot, random.uniform(0.43, 0.48));
    case 5:
      return table(squared, random.uniform(1.0, 1.5), random.uniform(0.65, 0.8), 0.72);
    case 6:
      return shelf(squared, random.uniform(0.7, 1.2), random.uniform(1.2, 1.9), random.uniform(0.5, 0.9),
                   random.uniform(0.2, 0.35));
    case 7:
      return pole(spot, random.uniform(0.03, 0.06), random.uniform(1.3, 2.4));
    case 8:
      return floor_lamp(spot, random.uniform(1.4, 1.7));
    case 9:
      return hanging_bar(low, random.uniform(0.8, 1.4), random.uniform(0.05, 0.09));
    default:
      return hanging_lamp(low, random.uniform(0.35, 0.55));
  }
}
constexpr int kPieces = 11;

// Shelves stand with their back to a wall, turned to the room.
Thing shelf_at_wall(Course& course) {
  Random& random = course.random();
  const Rect& r =
      course.rooms()[static_cast<std::size_t>(random.integer(0, static_cast<int>(course.rooms().size()) - 1))];
  constexpr double kBack = 0.19;
  Spot spot;
  spot.seed = random.seed();
  const int side = random.integer(0, 2);
  spot.x = side == 2 ? r.x1 - kBack : random.uniform(r.x0, r.x1);
  spot.y = side == 0 ? r.y0 + kBack : side == 1 ? r.y1 - kBack : random.uniform(r.y0, r.y1);
  spot.yaw = side == 0 ? kPi / 2 : side == 1 ? -kPi / 2 : kPi;
  return shelf(spot, random.uniform(0.8, 1.6), random.uniform(1.2, 1.9), random.uniform(0.5, 0.9),
               random.uniform(0.2, 0.35));
}

// A chair pushed half under the table that was placed last.
void add_chair_to_table(Course& course) {
  const int index = static_cast<int>(course.world().things.size()) - 1;
  Random& random = course.random();
  const Thing& table_thing = course.world().things.back();
  const Footprint f = footprint_of(table_thing);
  const Eigen::Vector2d a = f[0];
  const Eigen::Vector2d b = f[1];
  const Eigen::Vector2d middle = (a + b) / 2;
  const Eigen::Vector2d out = Eigen::Vector2d((b - a).y(), -(b - a).x()).normalized();
  const Eigen::Vector2d at = middle + out * random.uniform(0.05, 0.3);
  course.place(chair({at.x(), at.y(), std::atan2(-out.y(), -out.x()), 0, random.seed()}, 0.45), false, index);
}

void furnish(Course& course) {
  Random& random = course.random();
  // On the way, one after the other: each one moves the way.
  const int on_way = random.integer(4, 6);
  int first = random.integer(0, kPieces - 1);
  for (int done = 0, tries = 0; done < on_way && tries < 80; ++tries) {
    if (course.place(draw_piece((first + 4 * done) % kPieces, course.on_the_way(0.3), random), false)) ++done;
  }
  if (has(course.world(), "glass")) {
    for (int tries = 0; tries < 60; ++tries) {
      const Eigen::Vector2d at = course.on_the_way(1.0);
      if (course.place(glass_pane({at.x(), at.y(), random.uniform(0, kPi), 0, 1}, random.uniform(1.0, 1.6), 2.1),
                       false))
        break;
    }
  }
  const double enough = random.uniform(0.175, 0.24);
  for (int tries = 0; tries < 700 && course.density() < enough; ++tries) {
    const bool shelf_now = random.chance(0.12);
    Thing thing =
        shelf_now ? shelf_at_wall(course) : draw_piece(random.integer(0, kPieces - 1), course.anywhere(), random);
    const bool is_table = thing.kind == "table";
    if (course.place(std::move(thing), !shelf_now && tries < 500) && is_table && random.chance(0.5))
      add_chair_to_table(course);
  }
}

void add_what_is_passed(Course& course) {
  Random& random = course.random();
  for (int i = random.integer(1, 2); i > 0; --i) {
    const Eigen::Vector2d at = course.on_the_way(0.1);
    course.add(newspaper({at.x(), at.y(), random.uniform(-kPi, kPi), 0, random.seed()}, random.uniform(0.4, 0.8),
                         random.uniform(0.3, 0.55)));
  }
  for (int i = random.integer(0, 2); i > 0; --i) {
    const Eigen::Vector2d at = course.on_the_way(0.1);
    const Spot spot{at.x(), at.y(), random.uniform(-kPi, kPi), random.uniform(1.3, 1.9), random.seed()};
    course.add(random.chance(0.5) ? hanging_bar(spot, random.uniform(0.6, 1.0), 0.06)
                                  : hanging_lamp(spot, random.uniform(0.3, 0.5)));
  }
}

// Down along a long wall, beside the way.
void maybe_add_stairs(Course& course, const Rect& r) {
  Random& random = course.random();
  if (!random.chance(0.12)) return;
  const double length = random.uniform(1.2, 1.8);
  const double x0 = random.uniform(r.x0 + 2.5, std::max(r.x1 - 2.5 - length, r.x0 + 2.51));
  constexpr double kWide = 0.9;
  const bool north = random.chance(0.5);
  const Rect rect{x0, north ? r.y1 - 0.05 - kWide : r.y0 + 0.05, x0 + length,
                  north ? r.y1 - 0.05 : r.y0 + 0.05 + kWide};
  if (course.reserve(rect)) {
    add_stairs(course.world().ground, rect, random.chance(0.5) ? Towards::east : Towards::west, 5, 0.17,
               {Texture::concrete, 0.5F, 0.5F, 0.5F, random.seed()});
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
  constexpr double kHalf = kWall_m / 2;
  add_walls_around(course, look, b, a.y0, a.y1);
  add_wall(course, look, {a.x0 - kWall_m, a.y0 - kHalf}, {a.x1 - kWall_m, a.y0 - kHalf});
  add_wall(course, look, {a.x0 - kWall_m, a.y1 + kHalf}, {a.x1 - kWall_m, a.y1 + kHalf});
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
  maybe_add_stairs(course, b);
  if (!course.begin(0.025)) return false;
  if (has(world, "low light")) {
    world.light.ambient = 0.04;
    for (Lamp& lamp : world.light.lamps)
      lamp.strength *= 0.12;
  }
  furnish(course);
  if (random.chance(1 / 3.0)) {
    if (const auto walk = course.crossing_walk())
      course.add(walking_person(*walk, random.uniform(1.6, 1.85), random.seed()));
  }
  add_what_is_passed(course);
  return course.density() >= kLeastDensity && course.on_the_straight_line() >= 2;
}

}  // namespace lakshya::sim

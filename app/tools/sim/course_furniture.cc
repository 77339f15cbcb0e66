// Furniture: what is on the straight way first, then more until the rooms are full enough.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/tools/sim/course.h"
#include "app/tools/sim/world_generator.h"

namespace lakshya::sim {
namespace {

constexpr double kPi = std::numbers::pi;

Thing draw_piece(int which, const Eigen::Vector2d& at, Random& random) {
  const Spot spot{at.x(), at.y(), random.uniform(-kPi, kPi), 0, random.seed()};
  Spot low = spot;
  low.bottom_m = random.uniform(0.7, 1.1);
  const double straight = 0.5 * kPi * random.integer(0, 3) + random.uniform(-0.15, 0.15);
  Spot squared = spot;
  squared.yaw = straight;
  switch (which) {
    case 0:
    case 1: {
      const auto d = random.from_last({{0.3, 0.6}, {0.25, 0.5}, {0.3, 1.0}});
      return box(spot, d[0], d[1], d[2]);
    }
    case 2: {
      const auto d = random.from_last({{0.25, 0.45}, {0.2, 0.35}, {0.12, 0.3}});
      return box(spot, d[0], d[1], d[2]);
    }
    case 3:
    case 4:
      return chair(spot, random.uniform(0.43, 0.48));
    case 5: {
      const auto d = random.from_last({{1.0, 1.5}, {0.65, 0.8}});
      return table(squared, d[0], d[1], 0.72);
    }
    case 6: {
      const auto d = random.from_last({{0.7, 1.2}, {1.2, 1.9}, {0.5, 0.9}, {0.2, 0.35}});
      return shelf(squared, d[0], d[1], d[2], d[3]);
    }
    case 7: {
      const auto d = random.from_last({{0.03, 0.06}, {1.3, 2.4}});
      return pole(spot, d[0], d[1]);
    }
    case 8:
      return floor_lamp(spot, random.uniform(1.4, 1.7));
    case 9: {
      const auto d = random.from_last({{0.8, 1.4}, {0.05, 0.09}});
      return hanging_bar(low, d[0], d[1]);
    }
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
  const auto d = random.from_last({{0.8, 1.6}, {1.2, 1.9}, {0.5, 0.9}, {0.2, 0.35}});
  return shelf(spot, d[0], d[1], d[2], d[3]);
}

// A chair pushed half under the table that was placed last.
void add_chair_to_table(Course& course) {
  const int index = static_cast<int>(course.world().things.size()) - 1;
  Random& random = course.random();
  const Thing& table_thing = course.world().things.back();
  const Footprint f = footprint_of(table_thing);
  const Eigen::Vector2d& a = f[0];
  const Eigen::Vector2d& b = f[1];
  const Eigen::Vector2d middle = (a + b) / 2;
  const Eigen::Vector2d out = Eigen::Vector2d((b - a).y(), -(b - a).x()).normalized();
  const Eigen::Vector2d at = middle + out * random.uniform(0.05, 0.3);
  course.place(chair({at.x(), at.y(), std::atan2(-out.y(), -out.x()), 0, random.seed()}, 0.45), false, index);
}

}  // namespace

bool has_trait(const World& world, std::string_view trait) {
  return std::find(world.traits.begin(), world.traits.end(), trait) != world.traits.end();
}

void furnish_rooms(Course& course) {
  Random& random = course.random();
  // On the way, one after the other: each one moves the way.
  const int on_way = random.integer(4, 6);
  int first = random.integer(0, kPieces - 1);
  for (int done = 0, tries = 0; done < on_way && tries < 80; ++tries) {
    if (course.place(draw_piece((first + 4 * done) % kPieces, course.on_the_way(0.3), random), false)) ++done;
  }
  if (has_trait(course.world(), "glass")) {
    for (int tries = 0; tries < 60; ++tries) {
      const Eigen::Vector2d at = course.on_the_way(1.0);
      const auto [yaw, length] = random.from_last({{0, kPi}, {1.0, 1.6}});
      if (course.place(glass_pane({at.x(), at.y(), yaw, 0, 1}, length, 2.1), false)) break;
    }
  }
  const double enough = random.uniform(0.175, 0.24);
  for (int tries = 0; tries < 700 && course.density() < enough; ++tries) {
    const bool shelf_now = random.chance(0.12);
    const auto piece = [&] {
      const Eigen::Vector2d at = course.anywhere();
      return draw_piece(random.integer(0, kPieces - 1), at, random);
    };
    Thing thing = shelf_now ? shelf_at_wall(course) : piece();
    const bool is_table = thing.kind == "table";
    if (course.place(std::move(thing), !shelf_now && tries < 500) && is_table && random.chance(0.5))
      add_chair_to_table(course);
  }
}

void add_what_is_passed(Course& course) {
  Random& random = course.random();
  for (int i = random.integer(1, 2); i > 0; --i) {
    const Eigen::Vector2d at = course.on_the_way(0.1);
    const auto [length, width] = random.from_last({{0.4, 0.8}, {0.3, 0.55}});
    course.add(newspaper({at.x(), at.y(), random.uniform(-kPi, kPi), 0, random.seed()}, length, width));
  }
  for (int i = random.integer(0, 2); i > 0; --i) {
    const Eigen::Vector2d at = course.on_the_way(0.1);
    const Spot spot{at.x(), at.y(), random.uniform(-kPi, kPi), random.uniform(1.3, 1.9), random.seed()};
    course.add(random.chance(0.5) ? hanging_bar(spot, random.uniform(0.6, 1.0), 0.06)
                                  : hanging_lamp(spot, random.uniform(0.3, 0.5)));
  }
}

// Down along a long wall, beside the way.
void maybe_add_indoor_stairs(Course& course, const Rect& r) {
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

}  // namespace lakshya::sim

// Courses under the sky: ground and what lies beside the way first, then what is on the way, then bushes and rocks until the course
// is full enough.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/tools/sim/course.h"
#include "app/tools/sim/world_generator.h"

namespace lakshya::sim {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Surface kStone{Texture::concrete, 0.5F, 0.5F, 0.5F, 1};

Surface seeded(Surface surface, Random& random) {
  surface.seed = random.seed();
  return surface;
}

Surface draw_way(Random& random) {
  constexpr std::array<Surface, 3> kWays{{{Texture::gravel, 0.45F, 0.8F, 0.2F, 1},
                                          {Texture::asphalt, 0.3F, 0.6F, 0.3F, 1},
                                          {Texture::grass, 0.35F, 0.8F, 0.25F, 1}}};
  return seeded(kWays[static_cast<std::size_t>(random.integer(0, 2))], random);
}

void draw_light(World& world, Random& random) {
  Light& light = world.light;
  light.clouds = random.chance(0.5);
  light.ambient = 0.45;
  light.sun = random.uniform(0.4, 1.0);
  double elevation = random.uniform(25, 65) * kPi / 180;
  double azimuth = random.uniform(-kPi, kPi);
  if (random.chance(0.1)) {  // into the eyes
    world.traits.emplace_back("low sun");
    elevation = random.uniform(6, 14) * kPi / 180;
    azimuth = world.start.yaw + random.uniform(-0.6, 0.6);
  }
  light.sun_direction = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                         std::sin(elevation)};
}

void add_boundary(Course& course, const Rect& r) {
  Random& random = course.random();
  const int style = random.integer(0, 2);
  const auto side = [&](double x, double y, double yaw, double length, int what) {
    const Spot spot{x, y, yaw, 0, random.seed()};
    if (what == 0) {
      course.add_boundary(hedge(spot, length, 0.6, random.uniform(1.3, 1.8)));
    } else if (what == 1) {
      course.add_boundary(fence(spot, length, 1.25));
    } else {
      Thing thing = wall(spot, length, 0.24, random.uniform(1.4, 2.0));
      paint(thing, {Texture::brick, 0.4F, 0.6F, 0.25F, spot.seed});
      course.add_boundary(std::move(thing));
    }
  };
  const double length = r.x1 - r.x0;
  const double width = r.y1 - r.y0;
  const double middle_x = (r.x0 + r.x1) / 2;
  const double middle_y = (r.y0 + r.y1) / 2;
  constexpr double kOut = 0.3;  // half a hedge
  side(middle_x, r.y0 - kOut, 0, length + 4 * kOut, style);
  side(middle_x, r.y1 + kOut, 0, length + 4 * kOut, random.chance(0.6) ? style : random.integer(0, 2));
  side(r.x0 - kOut, middle_y, kPi / 2, width + 2 * kOut, random.integer(0, 2));
  side(r.x1 + kOut, middle_y, kPi / 2, width + 2 * kOut, random.integer(0, 2));
}

// Up, along and down again, over a part of the course's width.
bool add_ramp_over(Course& course, const Rect& r, const Surface& surface) {
  Random& random = course.random();
  const double height = random.uniform(0.1, 0.22);
  const double run = height / std::tan(random.uniform(4, 8) * kPi / 180);
  const double top = random.uniform(0.8, 1.6);
  const double width = random.uniform(1.6, 2.4);
  const double length = 2 * run + top;
  const double x0 = random.uniform(r.x0 + 2.4, std::max(r.x1 - 2.4 - length, r.x0 + 2.41));
  const double y0 = random.uniform(r.y0 + 1.2, r.y1 - 1.2 - width);
  if (!course.reserve({x0, y0, x0 + length, y0 + width}, true)) return false;
  Ground& ground = course.world().ground;
  const double y1 = y0 + width;
  add_ramp(ground, {x0, y0, x0 + run, y1}, Towards::east, 0, height, surface);
  add_platform(ground, {x0 + run, y0, x0 + run + top, y1}, height, surface);
  add_ramp(ground, {x0 + run + top, y0, x0 + length, y1}, Towards::west, 0, height, surface);
  return true;
}

// A strip along one side, flush with the boundary.
Rect beside_the_way(Random& random, const Rect& r, double length, double width) {
  const double x0 = random.uniform(r.x0 + 1.5, r.x1 - 1.5 - length);
  return random.chance(0.5) ? Rect{x0, r.y0 + 0.02, x0 + length, r.y0 + 0.02 + width}
                            : Rect{x0, r.y1 - 0.02 - width, x0 + length, r.y1 - 0.02};
}

void add_ground(Course& course, const Rect& r, const Surface& way) {
  Random& random = course.random();
  Ground& ground = course.world().ground;
  const auto tries = [&](double share, auto attempt) {
    if (!random.chance(share)) return;
    for (int i = 0; i < 20; ++i) {
      if (attempt()) return;
    }
  };
  tries(0.3, [&] { return add_ramp_over(course, r, seeded(kStone, random)); });
  tries(0.4, [&] {
    const auto [length, width] = random.from_last({{3, 5}, {0.5, 0.9}});
    const Rect rect = beside_the_way(random, r, length, width);
    if (!course.reserve(rect)) return false;
    add_kerb(ground, rect, 0.12, seeded(kStone, random));
    return true;
  });
  tries(0.2, [&] {
    const Rect rect = beside_the_way(random, r, random.uniform(1.5, 2.2), 1.1);
    if (!course.reserve(rect)) return false;
    const Surface stone = seeded(kStone, random);
    add_stairs(ground, rect, random.chance(0.5) ? Towards::east : Towards::west, 5, 0.16, stone);
    return true;
  });
  for (int i = 0; i < 2; ++i) {
    tries(0.4, [&] {
      const double x = random.uniform(r.x0 + 2, r.x1 - 2);
      const double y = random.uniform(r.y0 + 1, r.y1 - 1);
      const Rect rect{x, y, x + random.uniform(0.5, 0.8), y + random.uniform(0.5, 0.8)};
      if (!course.reserve(rect)) return false;
      const Surface surface = seeded(way, random);
      add_pothole(ground, rect, random.uniform(0.15, 0.3), surface);
      return true;
    });
  }
}

Thing draw_piece(int which, const Eigen::Vector2d& at, Random& random) {
  const Spot spot{at.x(), at.y(), random.uniform(-kPi, kPi), 0, random.seed()};
  switch (which) {
    case 0:
    case 1:
    case 2: {
      const auto d = random.from_last({{0.5, 1.0}, {0.4, 1.1}});
      return bush(spot, d[0], d[1]);
    }
    case 3:
    case 4: {
      const auto d = random.from_last({{0.35, 0.9}, {0.2, 0.6}});
      return rock(spot, d[0], d[1]);
    }
    case 5: {
      const auto d = random.from_last({{0.05, 0.12}, {1.0, 2.6}});
      return pole(spot, d[0], d[1]);
    }
    case 6: {
      const auto d = random.from_last({{0.4, 0.7}, {0.35, 0.6}, {0.25, 0.9}});
      return crate(spot, d[0], d[1], d[2]);
    }
    case 7: {
      const auto d = random.from_last({{0.3, 0.6}, {0.3, 0.5}, {0.15, 0.6}});
      return box(spot, d[0], d[1], d[2]);
    }
    case 8:
      return bench(spot, random.uniform(1.2, 1.6));
    default: {
      const auto d = random.from_last({{0.15, 0.35}, {3.0, 4.0}});
      return tree(spot, d[0], d[1]);
    }
  }
}
constexpr int kPieces = 10;

void furnish(Course& course) {
  Random& random = course.random();
  const int on_way = random.integer(5, 8);
  const int first = random.integer(0, kPieces - 1);
  for (int done = 0, tries = 0; done < on_way && tries < 80; ++tries) {
    if (course.place(draw_piece((first + 3 * done) % kPieces, course.on_the_way(0.3), random), false)) ++done;
  }
  const double enough = random.uniform(0.16, 0.2);
  for (int tries = 0; tries < 1200 && course.density() < enough; ++tries) {
    const Eigen::Vector2d at = course.anywhere();
    course.place(draw_piece(random.integer(0, kPieces - 1), at, random), tries < 800);
  }
}

}  // namespace

bool furnish_outdoor(World& world, Random& random) {
  const double length = random.uniform(12, 16) + 2.4;
  const double width = random.uniform(5.5, 7.5);
  const Rect r{0, 0, length, width};
  Eigen::Vector2d west{random.uniform(1.1, 1.3), random.uniform(1.3, width - 1.3)};
  Eigen::Vector2d east{length - random.uniform(1.1, 1.3), random.uniform(1.3, width - 1.3)};
  if (random.chance(0.5)) std::swap(west, east);
  const Eigen::Vector2d ahead = east - west;
  world.start = {west.x(), west.y(), std::atan2(ahead.y(), ahead.x()) + random.uniform(-0.65, 0.65)};
  world.goals = {east};
  world.ground = {-30, -30, length + 30, width + 30, seeded({Texture::grass, 0.35F, 0.8F, 0.25F, 1}, random), {}};
  const Surface way = draw_way(random);
  const double verge = random.uniform(0.3, 1.2);
  if (way.texture != Texture::grass) add_path(world.ground, {r.x0, r.y0 + verge, r.x1, r.y1 - verge}, way);
  draw_light(world, random);

  Course course(world, random, {r});
  add_boundary(course, r);
  add_ground(course, r, way);
  if (!course.begin(0.05)) return false;
  furnish(course);
  if (random.chance(0.4)) {
    if (const auto walk = course.crossing_walk()) {
      const std::uint32_t seed = random.seed();
      course.add(walking_person(*walk, random.uniform(1.6, 1.85), seed));
    }
  }
  for (int i = random.integer(0, 2); i > 0; --i) {
    const Eigen::Vector2d at = course.on_the_way(0.2);
    if (std::abs(ground_height(world.ground, at.x(), at.y())) > 0) continue;
    course.add(newspaper({at.x(), at.y(), random.uniform(-kPi, kPi), 0, random.seed()}, 0.6, 0.42));
  }
  return course.density() >= kLeastDensity && course.on_the_straight_line() >= 2;
}

}  // namespace lakshya::sim

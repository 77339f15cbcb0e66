// The simulated world from above.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>

#include "app/tools/picture_colors.h"
#include "app/tools/sim/walk.h"
#include "app/tools/sim_course.h"

namespace lakshya {
namespace {

using sim::Place;
using sim::Thing;

constexpr double kHeadroom = 1.2;  // m; parts of a thing that begin higher do not stand in the way
constexpr double kLifted = 0.1;    // m above the ground: it hangs

constexpr Rgb8 kWalkColor{170, 60, 130};

struct Style {
  const char* text;
  Rgb8 fill;
  Rgb8 rim;
  bool hatched;  // instead of filled
};

constexpr std::array<Style, kLooks> kStyles{{
    {"may be driven over", {255, 255, 255}, {120, 150, 180}, false},
    {"rock", {150, 140, 128}, {84, 76, 66}, false},
    {"furniture, boxes", {186, 132, 82}, {104, 66, 30}, false},
    {"bush, hedge", {104, 158, 92}, {50, 96, 44}, false},
    {"pole, post, fence", {70, 84, 112}, {34, 42, 62}, false},
    {"wall", {140, 144, 150}, {84, 88, 94}, false},
    {"other obstacle", {160, 110, 120}, {96, 56, 66}, false},
    {"glass", {168, 216, 240}, {60, 150, 200}, false},
    {"person", {214, 120, 178}, {120, 40, 92}, false},
    {"hangs low: must not be touched", {255, 255, 255}, {190, 70, 20}, true},
    {"hangs high: may be driven under", {255, 255, 255}, {150, 170, 190}, true},
}};

const Style& style_of(Look look) {
  return kStyles[static_cast<std::size_t>(look)];
}

using Triangle = std::array<Point, 3>;

bool names_one_of(const std::string& kind, std::initializer_list<std::string_view> words) {
  return std::ranges::any_of(words, [&](std::string_view word) { return kind.find(word) != std::string::npos; });
}

// Height of the lowest corner above the ground below it.
double lift_of(const Thing& thing, const sim::Ground& ground) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3f& v : thing.mesh.vertices) {
    const double floor = thing.walk ? 0 : ground_height(ground, v.x(), v.y());
    lowest = std::min(lowest, v.z() - floor);
  }
  return lowest;
}

// The lowest height of the body that each triangle belongs to: triangles that share corners are one body. A doorway's lintel and
// the cords of a lamp are bodies of their own.
std::vector<double> body_bottoms(const sim::Mesh& mesh) {
  std::vector<std::size_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i)
      i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const auto& t : mesh.triangles) {
    parent[root(t[1])] = root(t[0]);
    parent[root(t[2])] = root(t[0]);
  }
  std::vector<double> lowest(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    lowest[root(i)] = std::min(lowest[root(i)], static_cast<double>(mesh.vertices[i].z()));
  std::vector<double> bottoms;
  for (const auto& t : mesh.triangles)
    bottoms.push_back(lowest[root(t[0])]);
  return bottoms;
}

// What is below the headroom; all of it where nothing is.
std::vector<Triangle> footprint(const Thing& thing, const Place& place, double ground, const CourseView& view) {
  const double c = std::cos(place.yaw);
  const double s = std::sin(place.yaw);
  const std::vector<double> bottoms = body_bottoms(thing.mesh);
  const bool all = std::ranges::none_of(bottoms, [&](double z) { return z - ground < kHeadroom; });
  std::vector<Triangle> out;
  for (std::size_t i = 0; i < thing.mesh.triangles.size(); ++i) {
    if (!all && bottoms[i] - ground >= kHeadroom) continue;
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3f& v = thing.mesh.vertices[thing.mesh.triangles[i][k]];
      triangle[k] = view.at(place.x + c * v.x() - s * v.y(), place.y + s * v.x() + c * v.y());
    }
    out.push_back(triangle);
  }
  return out;
}

// Lines x + y = n * spacing within the triangle; those of neighbours go on in each other.
void hatch(Canvas& map, const Triangle& t, Rgb8 color) {
  constexpr double kSpacing = 6;
  const auto level = [](Point p) { return p.x + p.y; };
  const auto [low, high] = std::minmax({level(t[0]), level(t[1]), level(t[2])});
  for (double at = std::ceil(low / kSpacing) * kSpacing; at <= high; at += kSpacing) {
    std::vector<Point> ends;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point a = t[k];
      const Point b = t[(k + 1) % 3];
      const double rise = level(b) - level(a);
      const double share = rise == 0 ? -1 : (at - level(a)) / rise;
      if (share >= 0 && share <= 1) ends.push_back({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)});
    }
    if (ends.size() >= 2) map.line({ends.front(), ends.back()}, color, 1);
  }
}

// The union of the triangles with a rim: edges first, then the areas over all edges that lie inside.
void draw_footprint(Canvas& map, const std::vector<Triangle>& triangles, const Style& style) {
  for (const Triangle& t : triangles)
    map.line({t[0], t[1], t[2], t[0]}, style.rim, 3);
  for (const Triangle& t : triangles)
    map.polygon({t[0], t[1], t[2]}, style.fill);
  if (!style.hatched) return;
  for (const Triangle& t : triangles)
    hatch(map, t, style.rim);
}

void draw_walk(Canvas& map, const CourseView& view, const Thing& thing, double walked_s) {
  std::vector<Point> way;
  for (const Eigen::Vector2d& p : thing.walk->points)
    way.push_back(view.at(p.x(), p.y()));
  map.line(way, kWalkColor, 2, Stroke::dashed);
  const Place begin = place_on_walk(*thing.walk, 0);
  const double ring = std::max(6.0, 0.25 * view.scale);
  map.line(arc_points(view.at(begin.x, begin.y), ring, -3.15, 3.15), kWalkColor, 2);
  const Place end = place_on_walk(*thing.walk, walked_s);
  draw_footprint(map, footprint(thing, end, 0, view), style_of(Look::person));
}

}  // namespace

Look look_of(const Thing& thing, const sim::Ground& ground) {
  const std::string& kind = thing.kind;
  if (thing.expect == sim::Expect::glass) return Look::glass;
  const double lift = lift_of(thing, ground);
  if (thing.expect == sim::Expect::free) return lift > kLifted ? Look::hanging_high : Look::lying;
  if (thing.walk || names_one_of(kind, {"person"})) return Look::person;
  if (std::isfinite(lift) && lift > kLifted) return Look::hanging_low;
  if (names_one_of(kind, {"wall", "door"})) return Look::wall;
  if (names_one_of(kind, {"bush", "hedge", "tree", "plant"})) return Look::plant;
  if (names_one_of(kind, {"rock", "stone"})) return Look::rock;
  if (names_one_of(kind, {"pole", "post", "column", "pillar", "fence", "lamp"})) return Look::pole;
  if (names_one_of(kind, {"table", "chair", "shelf", "bench", "box", "crate", "desk", "sofa", "cupboard", "bed"}))
    return Look::furniture;
  return Look::other;
}

bool is_left_out(const Thing& thing, const sim::Ground& ground) {
  constexpr double kOverAll = 2.2;  // m above the ground
  return thing.mesh.vertices.empty() || (thing.expect == sim::Expect::free && lift_of(thing, ground) > kOverAll);
}

LegendItem legend_of(Look look) {
  const Style& style = style_of(look);
  return {style.text, [&style](Canvas& canvas, const Box& swatch) {
            const double x0 = swatch.x;
            const double y0 = swatch.y;
            const double x1 = swatch.right();
            const double y1 = swatch.bottom();
            draw_footprint(
                canvas,
                {{Point{x0, y0}, Point{x1, y0}, Point{x1, y1}}, {Point{x0, y0}, Point{x1, y1}, Point{x0, y1}}},
                style);
          }};
}

Box box_of(const Thing& thing, double walked_s, const CourseView& view) {
  if (thing.mesh.vertices.empty()) return {};
  const Place place = thing.walk ? place_on_walk(*thing.walk, walked_s) : Place{};
  const double c = std::cos(place.yaw);
  const double s = std::sin(place.yaw);
  const auto turned = [&](const Eigen::Vector3f& v) {
    return Point{place.x + c * v.x() - s * v.y(), place.y + s * v.x() + c * v.y()};
  };
  const Point first = turned(thing.mesh.vertices.front());
  Extent e{first.x, first.y, first.x, first.y};
  for (const Eigen::Vector3f& v : thing.mesh.vertices) {
    const Point p = turned(v);
    e.take(p.x, p.y);
  }
  return view.box(e.x0, e.y0, e.x1, e.y1);
}

DrawnWorld draw_world(Canvas& map, const CourseView& view, const sim::World& world, const sim::WalkTimes& walks) {
  DrawnWorld drawn;
  const sim::Ground& ground = world.ground;
  drawn.ground = draw_ground(map, view, world);
  std::vector<std::pair<Look, const Thing*>> things;
  for (const Thing& thing : world.things) {
    if (!is_left_out(thing, ground)) things.emplace_back(look_of(thing, ground), &thing);
  }
  std::ranges::stable_sort(things, {}, [](const auto& item) { return item.first; });
  for (const auto& [look, thing] : things) {
    const double walked_s = walks.of(static_cast<std::size_t>(thing - world.things.data()));
    const Box box = box_of(*thing, walked_s, view);
    if (!thing->walk && !overlap(box, {0, 0, map.width(), map.height()})) continue;
    drawn.looks.insert(look);
    if (thing->walk) {
      drawn.walks = true;
      draw_walk(map, view, *thing, walked_s);
      continue;
    }
    const Eigen::Vector3f& corner = thing->mesh.vertices.front();
    const double floor = ground_height(ground, corner.x(), corner.y());
    draw_footprint(map, footprint(*thing, {}, floor, view), style_of(look));
  }
  return drawn;
}

}  // namespace lakshya

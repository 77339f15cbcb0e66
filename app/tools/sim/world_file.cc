#include "app/tools/sim/world_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "app/core/file_bytes.h"
#include "app/core/input_text.h"
#include "app/tools/sim/shape_kinds.h"
#include "app/tools/sim/truth.h"
#include "app/tools/sim/world_yaml.h"

namespace lakshya::sim {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr std::size_t kMostThings = 500;
constexpr std::size_t kMostPatches = 200;
constexpr std::size_t kMostPoints = 100;
constexpr double kRadian = std::numbers::pi / 180;

Surface read_surface(const YamlValue& value, Surface surface) {
  const YamlMap map(value, {"texture", "albedo", "contrast", "scale_m", "seed"});
  if (map.has("texture")) {
    const std::vector<std::string_view> names(kTextureNames.begin(), kTextureNames.end());
    const std::string_view name = map.at("texture").one_of(names);
    surface.texture = static_cast<Texture>(std::find(names.begin(), names.end(), name) - names.begin());
  }
  surface.albedo = static_cast<float>(map.number("albedo", static_cast<double>(surface.albedo), 0, 1));
  surface.contrast = static_cast<float>(map.number("contrast", static_cast<double>(surface.contrast), 0, 1));
  surface.scale_m = static_cast<float>(map.number("scale_m", static_cast<double>(surface.scale_m), 0.001, 100));
  if (map.has("seed")) surface.seed = static_cast<std::uint32_t>(map.at("seed").integer(0, 1'000'000'000));
  return surface;
}

void read_ground(const YamlValue& value, Ground& ground) {
  const YamlMap map(value, {"surface", "extent"});
  if (map.has("surface")) ground.surface = read_surface(map.at("surface"), ground.surface);
  if (map.has("extent")) {
    const Rect r = map.at("extent").rect();
    ground.x0 = r.x0;
    ground.y0 = r.y0;
    ground.x1 = r.x1;
    ground.y1 = r.y1;
  }
}

Towards read_towards(const YamlValue& value) {
  const std::vector<std::string_view> names{"east", "north", "west", "south"};
  const std::string_view name = value.one_of(names);
  return static_cast<Towards>(std::find(names.begin(), names.end(), name) - names.begin());
}

void read_patch(const YamlValue& value, Ground& ground) {
  const YamlMap any(
      value, {"kind", "rect", "surface", "up", "down", "from_m", "to_m", "height_m", "depth_m", "steps", "rise_m"});
  const std::string_view kind = any.at("kind").one_of({"ramp", "platform", "stairs", "pothole", "kerb", "path"});
  const Rect rect = any.at("rect").rect();
  const Surface surface = any.has("surface") ? read_surface(any.at("surface"), ground.surface) : ground.surface;
  std::vector<std::string_view> known{"kind", "rect", "surface"};
  const auto only = [&](std::initializer_list<std::string_view> more) {
    known.insert(known.end(), more);
    return YamlMap(value, known);
  };
  if (kind == "ramp") {
    const YamlMap map = only({"up", "from_m", "to_m"});
    add_ramp(ground, rect, read_towards(map.at("up")), map.number("from_m", 0, -5, 5), map.at("to_m").number(-5, 5),
             surface);
  } else if (kind == "stairs") {
    const YamlMap map = only({"down", "steps", "rise_m"});
    const int steps = map.has("steps") ? map.at("steps").integer(1, 30) : 5;
    add_stairs(ground, rect, read_towards(map.at("down")), steps, map.number("rise_m", 0.17, 0.05, 0.5), surface);
  } else if (kind == "platform") {
    add_platform(ground, rect, only({"height_m"}).at("height_m").number(-5, 5), surface);
  } else if (kind == "pothole") {
    add_pothole(ground, rect, only({"depth_m"}).number("depth_m", 0.2, 0.02, 5), surface);
  } else if (kind == "kerb") {
    add_kerb(ground, rect, only({"height_m"}).number("height_m", 0.12, 0.02, 2), surface);
  } else {
    only({});
    add_path(ground, rect, surface);
  }
}

Walk read_walk(const YamlValue& value) {
  const YamlMap map(value, {"points", "speed_mps", "start_m", "halts_m"});
  Walk walk;
  for (const YamlValue& point : map.at("points").list(kMostPoints))
    walk.points.push_back(point.point());
  if (walk.points.size() < 2) map.at("points").refuse("fewer than two points (say from where to where)");
  walk.speed_mps = map.number("speed_mps", 1, 0, 10);
  walk.start_m = map.number("start_m", 0, 0, 1000);
  walk.halts_m = map.number("halts_m", walk.halts_m, 0, 10);
  return walk;
}

const ShapeKind& kind_named(const YamlValue& value) {
  std::vector<std::string_view> names;
  for (const ShapeKind& kind : shape_kinds())
    names.push_back(kind.kind);
  const std::string_view name = value.one_of(names);
  return shape_kinds()[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
}

Thing read_thing(const YamlValue& value) {
  if (!value.node().IsMap()) value.refuse("not a map (write \"key: value\" lines, indented below it)");
  const YAML::Node named = value.node()["kind"];
  if (!named.IsDefined()) value.refuse("kind is missing (add it)");
  const ShapeKind& kind = kind_named({named, value.source(), value.what() + ": kind", value.line()});

  std::vector<std::string_view> known{"kind", "name", "at", "yaw_deg", "bottom_m", "seed", "surface", "walk"};
  for (std::size_t i = 0; i < kind.count; ++i)
    known.push_back(kind.sizes[i].name);
  const YamlMap map(value, known);

  Spot spot;
  if (map.has("walk") == map.has("at")) value.refuse("has not one of at and walk (say where it stands, or walks)");
  if (map.has("at")) {
    const Eigen::Vector2d at = map.at("at").point();
    spot.x = at.x();
    spot.y = at.y();
    spot.yaw = map.number("yaw_deg", 0, -360, 360) * kRadian;
  } else if (map.has("yaw_deg")) {
    map.at("yaw_deg").refuse("what walks faces where it walks (remove one)");
  }
  const bool hangs = kind.kind.starts_with("hanging");
  spot.bottom_m = map.number("bottom_m", hangs ? 1 : kind.kind == "ceiling" ? kCeilingM : 0, -5, 20);
  if (map.has("seed")) spot.seed = static_cast<std::uint32_t>(map.at("seed").integer(0, 1'000'000'000));
  ShapeSizes sizes{};
  for (std::size_t i = 0; i < kind.count; ++i) {
    const ShapeSize& s = kind.sizes[i];
    sizes[i] = map.number(s.name, s.fallback, s.low, s.high);
  }
  if (kind.kind == "doorway" && sizes[1] > sizes[0] - 0.1)
    value.refuse("opening_m leaves less than 5 cm of wall beside it (make length_m larger)");
  Thing thing = kind.make(spot, sizes);
  if (map.has("surface")) paint(thing, read_surface(map.at("surface"), thing.mesh.surfaces.front()));
  if (map.has("walk")) thing.walk = read_walk(map.at("walk"));
  if (map.has("name")) thing.name = map.at("name").text();
  return thing;
}

void read_things(const YamlValue& value, World& world) {
  std::set<std::string> names;
  std::map<std::string, int> count;
  for (const YamlValue& entry : value.list(kMostThings)) {
    Thing thing = read_thing(entry);
    const int number = ++count[thing.kind];
    if (thing.name == thing.kind) thing.name += " " + std::to_string(number);
    if (!names.insert(thing.name).second)
      entry.refuse("the name " + shown(thing.name) + " is given twice (choose another)");
    world.things.push_back(std::move(thing));
  }
}

Eigen::Vector3d vector3(const YamlValue& value) {
  const auto v = value.numbers(3, -1000, 1000);
  return {v[0], v[1], v[2]};
}

void read_light(const YamlValue& value, Light& light) {
  const YamlMap map(value, {"ambient", "sun", "sun_direction", "lamps", "sky", "clouds"});
  light.ambient = map.number("ambient", light.ambient, 0, 10);
  light.sun = map.number("sun", light.sun, 0, 10);
  light.sky = map.number("sky", light.sky, 0, 2);
  if (map.has("clouds")) light.clouds = map.at("clouds").yes();
  if (map.has("sun_direction")) {
    light.sun_direction = vector3(map.at("sun_direction"));
    if (!(light.sun_direction.norm() > 1e-3)) map.at("sun_direction").refuse("has no direction (point at the sun)");
  }
  if (!map.has("lamps")) return;
  for (const YamlValue& entry : map.at("lamps").list(kMostPoints)) {
    const YamlMap lamp(entry, {"at", "strength"});
    light.lamps.push_back({vector3(lamp.at("at")), lamp.number("strength", 1, 0, 100)});
  }
}

void read_start(const YamlValue& value, World& world) {
  const YamlMap map(value, {"at", "yaw_deg"});
  const Eigen::Vector2d at = map.at("at").point();
  world.start = {at.x(), at.y(), map.number("yaw_deg", 0, -360, 360) * kRadian};
}

// Where the vehicle would stand in something. Those that walk are where they are at time 0: at the start only.
void require_free(const YamlValue& value, const TrueGeometry& truth, const World& world, const Eigen::Vector2d& at,
                  bool walkers) {
  const Ground& g = world.ground;
  if (at.x() < g.x0 || at.x() > g.x1 || at.y() < g.y0 || at.y() > g.y1)
    value.refuse("lies where there is no ground (move it, or make the ground's extent larger)");
  const double z = ground_height(g, at.x(), at.y());
  const Nearest nearest = truth.nearest(at.x(), at.y(), z + 0.02, z + kClearanceM, 0, true);
  if (nearest.distance_m < kRobotRadiusM) {
    const bool ground = nearest.thing < 0;
    const Thing* thing = ground ? nullptr : &world.things[static_cast<std::size_t>(nearest.thing)];
    if (walkers || thing == nullptr || !thing->walk) {
      value.refuse("the vehicle would touch " + (ground ? "a step of the ground" : shown(thing->name)) +
                   " there (keep 0.35 m from everything)");
    }
  }
  if (truth.dropoff_at(at.x(), at.y())) value.refuse("lies in a drop-off (move it)");
}

World read_root(const YamlValue& root, const std::string& source) {
  const YamlMap map(
      root, {"name", "indoor", "ground", "patches", "things", "light", "start", "goals", "time_limit_s", "traits"});
  World world;
  world.name = map.has("name") ? map.at("name").text() : source;
  if (map.has("indoor")) world.indoor = map.at("indoor").yes();
  if (map.has("ground")) read_ground(map.at("ground"), world.ground);
  if (map.has("patches")) {
    for (const YamlValue& entry : map.at("patches").list(kMostPatches))
      read_patch(entry, world.ground);
  }
  if (map.has("things")) read_things(map.at("things"), world);
  if (map.has("light")) read_light(map.at("light"), world.light);
  world.time_limit_s = map.number("time_limit_s", world.time_limit_s, 1, 3600);
  if (map.has("traits")) {
    for (const YamlValue& entry : map.at("traits").list(kMostPoints))
      world.traits.push_back(entry.text());
  }
  read_start(map.at("start"), world);
  const TrueGeometry truth(world);
  require_free(map.at("start"), truth, world, {world.start.x, world.start.y}, true);
  for (const YamlValue& entry : map.at("goals").list(kMostPoints)) {
    world.goals.push_back(entry.point());
    require_free(entry, truth, world, world.goals.back(), false);
  }
  if (world.goals.empty()) map.at("goals").refuse("no goal (give at least one [x, y])");
  return world;
}

}  // namespace

World read_world(const std::string& path) {
  return parse_world(read_text(path, kMaxBytes), path);
}

World parse_world(std::string_view text, const std::string& source) {
  return read_root({load_yaml(text, source), source, "world", 1}, source);
}

}  // namespace lakshya::sim

// The simulated world: what is there, true to the millimetre. Plain data, no logic but the ground's height.
//
// World frame: x east, y north, z up, metres; yaw radians counter-clockwise from east. The ground is z = 0 except where a patch
// says otherwise. Made by world_file.h (YAML) or world_generator.h (seeded).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/tools/sim/mesh.h"
#include "app/tools/sim/surface.h"

namespace lakshya::sim {

// What a vehicle should do about a thing.
enum class Expect : std::uint8_t {
  obstacle,  // must not be touched
  free,      // may be driven over or under: paper, high hanging things
  glass,     // must not be touched, and cannot be seen: reported apart
};

// A straight walk to and fro between points, on the ground: a person.
struct Walk {
  std::vector<Eigen::Vector2d> points;  // at least two; back from the last one to the first the same way
  double speed_mps = 1;
  double start_m = 0;    // how far along the way (there and back) he is at time 0
  double halts_m = 0.6;  // he stands still with a vehicle nearer than this before him (walk.h); 0: he walks into it
};

struct Thing {
  std::string name;  // unique: "table 3"
  std::string kind;  // its class: "table", "chair", "person", "newspaper", ...
  Expect expect = Expect::obstacle;
  Mesh mesh;  // in the world frame; of what walks: about his own place, facing +x, feet at z = 0
  std::optional<Walk> walk;
};

// A part of the ground with a height of its own, a rectangle along the axes: z = height_m + slope_x (x - x0) + slope_y (y - y0).
// Later patches lie over earlier ones. Walls close the steps between neighbours of different height.
struct GroundPatch {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // x0 < x1, y0 < y1
  double height_m = 0;
  double slope_x = 0, slope_y = 0;
  std::string kind;       // "ramp", "platform", "stairs", "pothole", "kerb"
  bool dropoff = false;   // a wheel must not get here
  bool obstacle = false;  // too high a step to be driven up: a kerb
  Surface surface;
};

struct Ground {
  double x0 = -50, y0 = -50, x1 = 50, y1 = 50;  // where there is any
  Surface surface;                              // of z = 0
  std::vector<GroundPatch> patches;
};

// The patch that is uppermost in the list at (x, y); null: the plain ground.
inline const GroundPatch* patch_at(const Ground& ground, double x, double y) {
  for (auto it = ground.patches.rbegin(); it != ground.patches.rend(); ++it) {
    if (x >= it->x0 && x < it->x1 && y >= it->y0 && y < it->y1) return &*it;
  }
  return nullptr;
}

inline double ground_height(const Ground& ground, double x, double y) {
  const GroundPatch* p = patch_at(ground, x, y);
  return p == nullptr ? 0 : p->height_m + p->slope_x * (x - p->x0) + p->slope_y * (y - p->y0);
}

struct Lamp {
  Eigen::Vector3d position{0, 0, 3};
  double strength = 1;  // irradiance 1 m below it, in units of `Light::sun`
};

// Irradiances: 1 on a surface of albedo 0.5 is middle grey at exposure 1.
struct Light {
  double ambient = 0.4;
  double sun = 0;                              // 0: indoors
  Eigen::Vector3d sun_direction{0.3, 0.2, 1};  // towards the sun, any length
  std::vector<Lamp> lamps;                     // the first one casts shadows where there is no sun
  double sky = 0.9;                            // radiance of the sky, 0..2
  bool clouds = false;
};

struct Place {
  double x = 0;
  double y = 0;
  double yaw = 0;
};

struct World {
  std::string name;
  std::uint64_t seed = 0;
  bool indoor = true;
  Ground ground;
  std::vector<Thing> things;
  Light light;
  Place start;
  std::vector<Eigen::Vector2d> goals;  // way points in order, at least one
  double time_limit_s = 180;
  std::vector<std::string>
      traits;  // what is hard about it: "low light", "low texture", "repetitive texture", "low sun", "glass"
};

}  // namespace lakshya::sim

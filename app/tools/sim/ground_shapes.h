// Parts of the ground that are not flat: each maker appends its patches. Rectangles along the axes, metres.
#pragma once

#include <span>
#include <vector>

#include "app/tools/sim/world.h"

namespace lakshya::sim {

// A step of more than this is no ground to drive over.
inline constexpr double kStepM = 0.10;

struct Rect {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // x0 < x1, y0 < y1
};

enum class Towards : std::uint8_t { east, north, west, south };

// z from `from_m` at the foot to `to_m` at the end that lies `up`.
void add_ramp(Ground& ground, const Rect& rect, Towards up, double from_m, double to_m, const Surface& surface);
void add_platform(Ground& ground, const Rect& rect, double height_m, const Surface& surface);
// A flight that leads down `down`, each step `rise_m` lower than the one before; a drop-off.
void add_stairs(Ground& ground, const Rect& rect, Towards down, int steps, double rise_m, const Surface& surface);
// A hole within `rect` with its corners filled; a drop-off.
void add_pothole(Ground& ground, const Rect& rect, double depth_m, const Surface& surface);
void add_kerb(Ground& ground, const Rect& rect, double height_m, const Surface& surface);
// Level, of another surface: a path through grass.
void add_path(Ground& ground, const Rect& rect, const Surface& surface);

// A place where the ground jumps by more than kStepM, between drivable ground on both sides: the side of a ramp.
struct GroundStep {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  int patch = -1;  // whose edge it is
};
std::vector<GroundStep> ground_steps(const Ground& ground);

double distance_to_rect(const Rect& rect, double x, double y);  // 0 inside
double distance_to_segment(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p);

inline Rect rect_of(const GroundPatch& patch) {
  return {patch.x0, patch.y0, patch.x1, patch.y1};
}

}  // namespace lakshya::sim

#include "app/tools/sim/ground_shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lakshya::sim {
namespace {

GroundPatch patch(const Rect& rect, double height_m, const char* kind, const Surface& surface) {
  GroundPatch p;
  p.x0 = rect.x0;
  p.y0 = rect.y0;
  p.x1 = rect.x1;
  p.y1 = rect.y1;
  p.height_m = height_m;
  p.kind = kind;
  p.surface = surface;
  return p;
}

}  // namespace

void add_ramp(Ground& ground, const Rect& rect, Towards up, double from_m, double to_m, const Surface& surface) {
  const bool along_x = up == Towards::east || up == Towards::west;
  const bool forward = up == Towards::east || up == Towards::north;
  const double slope = (to_m - from_m) / (along_x ? rect.x1 - rect.x0 : rect.y1 - rect.y0) * (forward ? 1 : -1);
  GroundPatch p = patch(rect, forward ? from_m : to_m, "ramp", surface);
  (along_x ? p.slope_x : p.slope_y) = slope;
  ground.patches.push_back(p);
}

void add_platform(Ground& ground, const Rect& rect, double height_m, const Surface& surface) {
  ground.patches.push_back(patch(rect, height_m, "platform", surface));
}

void add_stairs(Ground& ground, const Rect& rect, Towards down, int steps, double rise_m, const Surface& surface) {
  for (int i = 0; i < steps; ++i) {
    const double from = static_cast<double>(i) / steps;
    const double to = i + 1 == steps ? 1.0 : static_cast<double>(i + 1) / steps;
    Rect step = rect;
    const double length = rect.x1 - rect.x0;
    const double width = rect.y1 - rect.y0;
    if (down == Towards::east) {
      step.x0 = rect.x0 + from * length;
      step.x1 = rect.x0 + to * length;
    } else if (down == Towards::west) {
      step.x0 = rect.x1 - to * length;
      step.x1 = rect.x1 - from * length;
    } else if (down == Towards::north) {
      step.y0 = rect.y0 + from * width;
      step.y1 = rect.y0 + to * width;
    } else {
      step.y0 = rect.y1 - to * width;
      step.y1 = rect.y1 - from * width;
    }
    GroundPatch p = patch(step, -rise_m * (i + 1), "stairs", surface);
    p.dropoff = true;
    ground.patches.push_back(p);
  }
}

void add_pothole(Ground& ground, const Rect& rect, double depth_m, const Surface& surface) {
  const double cut_x = 0.15 * (rect.x1 - rect.x0);
  const double cut_y = 0.15 * (rect.y1 - rect.y0);
  for (const Rect& r : {Rect{rect.x0, rect.y0 + cut_y, rect.x1, rect.y1 - cut_y},
                        Rect{rect.x0 + cut_x, rect.y0, rect.x1 - cut_x, rect.y1}}) {
    GroundPatch p = patch(r, -depth_m, "pothole", surface);
    p.dropoff = true;
    ground.patches.push_back(p);
  }
}

void add_kerb(Ground& ground, const Rect& rect, double height_m, const Surface& surface) {
  GroundPatch p = patch(rect, height_m, "kerb", surface);
  p.obstacle = true;
  ground.patches.push_back(p);
}

void add_path(Ground& ground, const Rect& rect, const Surface& surface) {
  ground.patches.push_back(patch(rect, 0, "path", surface));
}

double distance_to_rect(const Rect& rect, double x, double y) {
  return std::hypot(std::max({rect.x0 - x, 0.0, x - rect.x1}), std::max({rect.y0 - y, 0.0, y - rect.y1}));
}

double distance_to_segment(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
  const Eigen::Vector2d along = b - a;
  const double square = along.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
  return (a + t * along - p).norm();
}

namespace {

constexpr double kAside = 1e-6;  // m: far enough from an edge to be on one side of it

bool jumps(const Ground& ground, const Eigen::Vector2d& at, const Eigen::Vector2d& across) {
  const Eigen::Vector2d in = at - kAside * across;
  const Eigen::Vector2d out = at + kAside * across;
  const GroundPatch* pi = patch_at(ground, in.x(), in.y());
  const GroundPatch* po = patch_at(ground, out.x(), out.y());
  for (const GroundPatch* p : {pi, po}) {
    if (p != nullptr && (p->dropoff || p->obstacle)) return false;  // counted as areas
  }
  return std::abs(ground_height(ground, in.x(), in.y()) - ground_height(ground, out.x(), out.y())) > kStepM;
}

// The pieces of one edge at which the ground jumps. Heights are piecewise linear along it, so between the corners of patches there
// are at most two changes from step to no step; 2 cm pieces find them.
void add_edge_steps(const Ground& ground, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                    const Eigen::Vector2d& across, int patch, std::vector<GroundStep>& steps) {
  const int pieces = std::clamp(static_cast<int>((b - a).norm() / 0.02), 1, 5000);
  int first = -1;
  for (int i = 0; i <= pieces; ++i) {
    const Eigen::Vector2d middle = a + (b - a) * ((i + 0.5) / pieces);
    const bool step = i < pieces && jumps(ground, middle, across);
    if (step && first < 0) first = i;
    if (!step && first >= 0) {
      steps.push_back({a + (b - a) * (static_cast<double>(first) / pieces),
                       a + (b - a) * (static_cast<double>(i) / pieces), patch});
      first = -1;
    }
  }
}

}  // namespace

std::vector<GroundStep> ground_steps(const Ground& ground) {
  std::vector<GroundStep> steps;
  for (std::size_t i = 0; i < ground.patches.size(); ++i) {
    const GroundPatch& p = ground.patches[i];
    const int index = static_cast<int>(i);
    const Eigen::Vector2d sw{p.x0, p.y0};
    const Eigen::Vector2d se{p.x1, p.y0};
    const Eigen::Vector2d ne{p.x1, p.y1};
    const Eigen::Vector2d nw{p.x0, p.y1};
    add_edge_steps(ground, sw, se, {0, -1}, index, steps);
    add_edge_steps(ground, se, ne, {1, 0}, index, steps);
    add_edge_steps(ground, ne, nw, {0, 1}, index, steps);
    add_edge_steps(ground, nw, sw, {-1, 0}, index, steps);
  }
  return steps;
}

}  // namespace lakshya::sim

// Triangles put together from simple bodies in a thing's own frame, then placed in the world.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "app/tools/sim/mesh.h"

namespace lakshya::sim {

// Where a thing stands: its own origin in the world, and what its texture and its irregularities start from.
struct Spot {
  double x = 0;
  double y = 0;
  double yaw = 0;       // radians
  double bottom_m = 0;  // height of the thing's own z = 0
  std::uint32_t seed = 1;
};

class MeshBuilder {
 public:
  using Point = Eigen::Vector3d;

  // What the bodies added from now on are made of.
  void surface(const Surface& surface);

  std::uint32_t vertex(const Point& point);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void triangle(const Point& a, const Point& b, const Point& c);

  // Closed bodies with the outside counter-clockwise. Corners along the axes of the own frame.
  void box(const Point& low, const Point& high);
  // Upright, round, with `sides` sides; a radius may be 0 at one end (a cone).
  void frustum(double x, double y, double z0, double z1, double radius0, double radius1, int sides);
  void cylinder(double x, double y, double z0, double z1, double radius, int sides) {
    frustum(x, y, z0, z1, radius, radius, sides);
  }
  void ellipsoid(const Point& centre, const Point& radii, int rings, int sides);
  // Rows of equally many points, closed round each row and at both ends: an ellipsoid with its points moved.
  void closed_rows(const std::vector<std::vector<Point>>& rows, const Point& south, const Point& north);

  Mesh placed(const Spot& spot) const;

 private:
  std::vector<Point> points_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::uint16_t> surface_of_;
  std::vector<Surface> surfaces_;
};

}  // namespace lakshya::sim

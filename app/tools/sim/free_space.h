// Where a disc can go in a world: how far every point of a grid is from what must not be touched, and the paths there.
//
// Counted are obstacles and glass between 0.05 m and the clearance height above the ground, drop-offs, kerbs and the sides of ramps;
// not what walks. Ramps and platforms are driven.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/tools/sim/ground_shapes.h"
#include "app/tools/sim/world.h"

namespace lakshya::sim {

inline constexpr double kLowestM = 0.05;  // what is lower is driven over

class FreeSpace {
 public:
  // `area` is cut into square cells; distances are known up to `reach_m`, and are at least that beyond.
  FreeSpace(const Ground& ground, const Rect& area, double cell_m, double reach_m);

  void add(const Thing& thing);

  // Distance at (x, y), of the cell there; 0 outside the area.
  double distance(double x, double y) const;
  bool fits(double x, double y, double radius_m) const { return distance(x, y) >= radius_m; }

  // Whether a disc gets from one point to the other, and how long its way is: on the grid, then pulled straight. Infinity: there is
  // no way, or an end is not free.
  bool connected(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius_m) const;
  double path_m(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius_m) const;
  std::vector<Eigen::Vector2d> path(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius_m) const;

  // Square metres that can be reached from a point.
  double area_m2(const Eigen::Vector2d& from, double radius_m) const;

 private:
  int cell_at(double x, double y) const;  // -1 outside
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  Eigen::Vector2d middle(int cell) const;
  std::vector<std::uint8_t> reached(int from, int to, double radius_m) const;
  std::vector<int> cells_on_the_way(int from, int to, double radius_m) const;
  bool sees(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius_m) const;
  template <class F>
  void lower(const Rect& bounds, F distance_at);

  Rect area_;
  double cell_m_;
  double reach_m_;
  int columns_;
  int rows_;
  std::vector<float> ground_m_;
  std::vector<float> distance_m_;
};

// The space of a world within what stands in it, its start and its goals.
FreeSpace free_space(const World& world, double cell_m, double reach_m);

// Length of the shortest way from start over all goals for a disc; infinity when there is none.
double shortest_path_m(const World& world, double radius_m);

// Walls, doorways, hedges and fences: what stands round a course, no obstacle on it.
bool is_boundary(const Thing& thing);

// What is to be avoided but does not stand round the course: things that stand, walk or hang low, and drop-offs (patches of one
// kind that touch are one).
int obstacle_count(const World& world);

// Square metres of ground within the boundary, round the start.
double drivable_area_m2(const World& world);

}  // namespace lakshya::sim

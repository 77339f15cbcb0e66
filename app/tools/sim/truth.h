// How far it really is to what must not be touched: from the triangles themselves, not from pictures.
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "app/tools/sim/ground_shapes.h"
#include "app/tools/sim/walk.h"
#include "app/tools/sim/world.h"

namespace lakshya::sim {

// Horizontal distance, metres, from (x, y) to the part of the triangle between two heights (both included); 0 where the point lies
// over or under that part, infinity where there is none.
double distance_to_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, double x,
                            double y, double z_low, double z_high);

struct Nearest {
  double distance_m = std::numeric_limits<double>::infinity();
  int thing = -1;  // index into World::things; -1: none, or the ground
  int patch = -1;  // index into Ground::patches where the nearest is a kerb or the side of a ramp
};

// Refers to nothing of the world afterwards. All queries are const and may come from several threads.
class TrueGeometry {
 public:
  explicit TrueGeometry(const World& world);

  // The nearest of: things with Expect::obstacle, with `glass` those with Expect::glass too, those that walk where they are
  // then; kerbs, and the sides of ramps and platforms (at any height). z_low..z_high in the world frame: the caller adds the
  // ground's height under the vehicle.
  Nearest nearest(double x, double y, double z_low, double z_high, const WalkTimes& when, bool glass) const;

  // A wheel must not be here.
  bool dropoff_at(double x, double y) const;

 private:
  // Round a triangle: looked at first, and mostly alone. Corners are floats, so that these are exact.
  struct Bounds {
    float x0, y0, x1, y1, z0, z1;
    std::uint32_t triangle;  // index
    bool glass;
  };
  struct Triangle {
    std::array<Eigen::Vector3d, 3> corners;
    Bounds bounds;
    int thing;
  };
  struct Walker {
    Walk walk;
    std::vector<Triangle> triangles;  // in his own frame
    double reach_m = 0;               // of his farthest point from his place
    int thing = -1;
    bool glass = false;
  };
  struct Query {
    double x, y, z_low, z_high;
    bool glass;
  };

  static Triangle triangle(const Mesh& mesh, std::size_t index, int thing, bool glass);
  static void visit(const Bounds& bounds, const std::vector<Triangle>& triangles, const Query& query,
                    Nearest& best);
  std::size_t bucket(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  void make_grid();
  void search_grid(const Query& query, Nearest& best) const;
  void visit_bucket(int column, int row, const Query& query, Nearest& best) const;
  void search_ground(const Query& query, Nearest& best) const;

  std::vector<Triangle> triangles_;  // of all that stands
  std::vector<Walker> walkers_;
  Ground ground_;
  std::vector<GroundStep> steps_;
  double x0_ = 0, y0_ = 0, bucket_m_ = 1;
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> first_;  // entry of each bucket, and one past the last
  std::vector<Bounds> entries_;       // bucket after bucket
};

}  // namespace lakshya::sim

// What a thing covers on the map, as its convex hull: for placing things beside each other, not for measuring.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/tools/sim/ground_shapes.h"
#include "app/tools/sim/world.h"

namespace lakshya::sim {

using Footprint = std::vector<Eigen::Vector2d>;  // convex, counter-clockwise

Footprint hull_of(std::vector<Eigen::Vector2d> points);
Footprint footprint_of(const Rect& rect);
// Of the triangles between kLowestM and 1.5 m; empty where there are none.
Footprint footprint_of(const Thing& thing);

double distance_to(const Footprint& footprint, const Eigen::Vector2d& p);  // 0 inside
double gap_between(const Footprint& a, const Footprint& b);                // 0 where they overlap
bool inside(const Footprint& footprint, const Rect& rect);

}  // namespace lakshya::sim

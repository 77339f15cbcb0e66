// Way points in the world frame (east-north, metres, yaw in radians from east, counter-clockwise):
// docs/contract.md section 1.
#pragma once

#include <cstddef>
#include <span>

namespace lakshya {

struct WayPoint {
  double east_m = 0;
  double north_m = 0;
};

struct Pose {
  double east_m = 0;
  double north_m = 0;
  double yaw = 0;  // rad
};

struct WayPointView {
  double direction = 0;  // rad, from straight ahead, counter-clockwise, in [-pi, pi]; 0 on the way point itself
  double distance_m = 0;
};

WayPointView view_way_point(const Pose& pose, const WayPoint& way_point);

// The first way point from `current` on that is farther than radius_m from the pose; way_points.size() when all
// are reached. Reached ones are never returned to.
std::size_t next_way_point(std::span<const WayPoint> way_points, std::size_t current, const Pose& pose,
                           double radius_m);

// On the WGS 84 ellipsoid, as GNSS receivers give it.
struct GeoPoint {
  double latitude_deg = 0;   // positive north
  double longitude_deg = 0;  // positive east
};

// `point` in the world frame whose origin is `start`: the way along the meridian and along the parallel half way, with the
// ellipsoid's radii of curvature there. Over 10 km and below 70 degrees of latitude less than a metre off; not for the poles.
WayPoint local_way_point(const GeoPoint& start, const GeoPoint& point);

}  // namespace lakshya

#include "app/nav/way_point.h"

#include <cmath>

#include "app/nav/sectors.h"

namespace lakshya {

WayPointView view_way_point(const Pose& pose, const WayPoint& way_point) {
  const double east = way_point.east_m - pose.east_m;
  const double north = way_point.north_m - pose.north_m;
  if (east == 0 && north == 0) return {};
  return {wrap_angle(std::atan2(north, east) - pose.yaw), std::hypot(east, north)};
}

std::size_t next_way_point(std::span<const WayPoint> way_points, std::size_t current, const Pose& pose,
                           double radius_m) {
  std::size_t next = current;
  while (next < way_points.size() && view_way_point(pose, way_points[next]).distance_m <= radius_m)
    ++next;
  return next;
}

}  // namespace lakshya

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

WayPoint local_way_point(const GeoPoint& start, const GeoPoint& point) {
  constexpr double kEquatorRadius = 6378137.0;  // WGS 84: a, and e^2 of 1/f = 298.257223563
  constexpr double kEccentricity2 = 6.69437999014e-3;
  const double middle = radians((start.latitude_deg + point.latitude_deg) / 2);
  const double w2 = 1 - kEccentricity2 * std::sin(middle) * std::sin(middle);
  const double prime_vertical = kEquatorRadius / std::sqrt(w2);
  const double meridian = prime_vertical * (1 - kEccentricity2) / w2;
  const double east = wrap_angle(radians(point.longitude_deg - start.longitude_deg));
  return {prime_vertical * std::cos(middle) * east, meridian * radians(point.latitude_deg - start.latitude_deg)};
}

}  // namespace lakshya

#include "app/tools/sim/walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lakshya::sim {

Place place_on_walk(const Walk& walk, double time_s) {
  const auto& points = walk.points;
  if (points.empty()) return {};
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += (points[i] - points[i - 1]).norm();
  if (!(length > 0)) return {points[0].x(), points[0].y(), 0};
  double gone = std::fmod(walk.start_m + walk.speed_mps * time_s, 2 * length);
  if (gone < 0) gone += 2 * length;
  const bool back = (gone >= length) != (walk.speed_mps < 0);
  double left = gone < length ? gone : 2 * length - gone;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d leg = points[i] - points[i - 1];
    const double size = leg.norm();
    if (!(size > 0)) continue;
    if (left > size && i + 1 < points.size()) {
      left -= size;
      continue;
    }
    const Eigen::Vector2d at = points[i - 1] + leg * std::min(left / size, 1.0);
    const double sign = back ? -1 : 1;
    return {at.x(), at.y(), std::atan2(sign * leg.y(), sign * leg.x())};
  }
  return {points.back().x(), points.back().y(), 0};
}

}  // namespace lakshya::sim

#include "app/tools/sim/walk.h"

#include <cmath>

namespace lakshya::sim {

Place place_on_walk(const Walk& walk, double time_s) {
  if (walk.points.empty()) return {};
  double length = 0;
  for (std::size_t i = 1; i < walk.points.size(); ++i)
    length += (walk.points[i] - walk.points[i - 1]).norm();
  if (!(length > 0)) return {walk.points.front().x(), walk.points.front().y(), 0};

  double along = std::fmod(walk.start_m + walk.speed_mps * time_s, 2 * length);
  if (along < 0) along += 2 * length;
  const bool back = along >= length;
  double rest = back ? 2 * length - along : along;
  for (std::size_t i = 1; i < walk.points.size(); ++i) {
    const Eigen::Vector2d step = walk.points[i] - walk.points[i - 1];
    const double step_length = step.norm();
    if (step_length <= 0) continue;
    // On the way back a corner belongs to the leg that comes next there, which is the one before it.
    if (rest < step_length || (back && rest <= step_length) || i + 1 == walk.points.size()) {
      const Eigen::Vector2d at = walk.points[i - 1] + step * (rest / step_length);
      const Eigen::Vector2d facing =
          back ? Eigen::Vector2d(walk.points[i - 1] - walk.points[i]) : step;  // no -0: west is +pi
      return {at.x(), at.y(), std::atan2(facing.y(), facing.x())};
    }
    rest -= step_length;
  }
  return {walk.points.back().x(), walk.points.back().y(), 0};
}

}  // namespace lakshya::sim

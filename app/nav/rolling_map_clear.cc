// What a rolling map forgets because a frame shows otherwise: docs/contract.md section 4.
#include <algorithm>
#include <cmath>
#include <utility>

#include "app/nav/rolling_map.h"
#include "app/nav/rolling_map_walk.h"
#include "kernels/base/units.h"

namespace lakshya {

bool RollingMap::sees_height(std::size_t i, double forward, double left) const {
  const double edge_m = edge_height_ + edge_forward_ * forward + edge_left_ * left;
  return edge_m >= memory_.height[i] / 1000.0 + kEdgeMarginM;
}

// Whether the disparity image can say that what is remembered there is or is not there any more.
bool RollingMap::can_look_for(std::size_t i, ImageView<const std::int16_t> disparity) const {
  return params_.sight.focal_px > 0 && disparity.data != nullptr && memory_.height[i] >= kHangingMm;
}

// What an obstacle cell loses whose floor is seen.
int RollingMap::cleared(std::size_t i, double forward, double left, ImageView<const std::int16_t> disparity) const {
  if (!can_look_for(i, disparity))
    return sees_height(i, forward, left) ? weight(forward, left, kCleared, kClearedFar) : 0;
  switch (depth_view_.at(disparity, forward, left, memory_.height[i] / 1000.0, cell_m_)) {
    case Shown::behind:
      return kCleared;
    case Shown::nothing:
      return kClearedFar;
    case Shown::outside:
    case Shown::thing:
      break;
  }
  return 0;
}

void RollingMap::see_free(std::size_t i, double forward, double left, ImageView<const std::int16_t> disparity) {
  std::uint8_t& evidence = memory_.evidence[i];
  std::uint8_t& floor = memory_.floor[i];
  floor = static_cast<std::uint8_t>(std::min(floor + kFreeCounts, kMostFree));
  if (evidence > kFree) {
    const int less = cleared(i, forward, left, disparity);
    if (less == 0) return;
    evidence = static_cast<std::uint8_t>(std::max<int>(kFree, evidence - less));
  } else {
    evidence = kFree;
  }
  if (evidence == kFree) memory_.height[i] = 0;
  memory_.seen[i] = now_;
}

// Where no floor is seen, as in the blind zone, what stood high enough to be in view and is not there any more leaves unknown ground.
void RollingMap::see_through(std::size_t i, double forward, double left, ImageView<const std::int16_t> disparity) {
  if (!can_look_for(i, disparity)) return;
  if (depth_view_.at(disparity, forward, left, memory_.height[i] / 1000.0, cell_m_) != Shown::behind) return;
  std::uint8_t& evidence = memory_.evidence[i];
  evidence = static_cast<std::uint8_t>(std::max<int>(kFree, evidence - kCleared));
  if (evidence > kFree) return;
  evidence = 0;
  memory_.height[i] = 0;
}

// Along the camera's direction, and to the left of it.
std::pair<double, double> RollingMap::from_camera(double forward, double left) const {
  const double x = forward - params_.camera.forward_m;
  const double y = left - params_.camera.left_m;
  return {x * yaw_cos_ + y * yaw_sin_, y * yaw_cos_ - x * yaw_sin_};
}

// Whether floor there would be in view, and near enough that it should be seen.
bool RollingMap::looks_at(double forward, double left) const {
  const double far_m = params_.blind_m + kDoubtM;
  const double squared = forward * forward + left * left;
  if (squared < params_.blind_m * params_.blind_m || squared > far_m * far_m) return false;
  const auto [ahead, beside] = from_camera(forward, left);
  return ahead > 0 && ahead * ahead > view_cos_ * view_cos_ * (ahead * ahead + beside * beside);
}

// Whether the frame knows anything behind a free cell, where a window over the border of what can be matched would end; a thing before
// that hides what lies there.
bool RollingMap::floor_goes_on(const NavGrid& frame, int row, int col) const {
  const double forward = (row + 0.5) * cell_m_ - params_.camera.forward_m;
  const double left = (geometry_.cols / 2.0 - col - 0.5) * cell_m_ - params_.camera.left_m;
  const double squared = forward * forward + left * left;
  const double range = std::sqrt(squared);
  const int reach = static_cast<int>(std::ceil(kBorderRows * params_.row_m * squared / cell_m_));
  if (reach == 0 || reach > kFarBorder) return true;  // far away it matters little
  for (int k = 1; k <= reach + 1; ++k) {
    const int r = static_cast<int>(std::lround(row + k * forward / range));
    const int c = static_cast<int>(std::lround(col - k * left / range));
    if (r < 0 || r >= geometry_.rows || c < 0 || c >= geometry_.cols) return true;
    const std::uint8_t type = frame.type.at(c, r);
    if (type == kCellObstacle || (type == kCellUnoccupied && k >= reach)) return true;
  }
  return false;
}

// Whether the frame has an obstacle in a neighbouring cell that is no nearer, and not in this one, which it should see as well: it is the
// same thing, and was put here by the error of a depth or of a pose. Near by its foot may be out of view.
bool RollingMap::is_beside_hit(const NavGrid& frame, int row, int col) const {
  if (!params_.trim) return false;
  const int left = geometry_.cols - 1 - 2 * col;  // half cells
  const int range2 = (2 * row + 1) * (2 * row + 1) + left * left;
  const double least = 2 * (params_.blind_m + kBesideM) / cell_m_;
  if (range2 < least * least) return false;
  for (const auto& [dr, dc] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
    const int r = row + dr;
    const int c = col + dc;
    if (r < 0 || r >= geometry_.rows || c < 0 || c >= geometry_.cols) continue;
    const int beside = geometry_.cols - 1 - 2 * c;
    if ((2 * r + 1) * (2 * r + 1) + beside * beside >= range2 && frame.type.at(c, r) == kCellObstacle) return true;
  }
  return false;
}

// Where the frame's obstacles are, for is_hidden().
void RollingMap::find_shadows(const NavGrid& frame, const Sight& sight) {
  shadow_.clear();
  for (int r = 0; r < geometry_.rows; ++r) {
    for (int c = 0; c < geometry_.cols; ++c) {
      if (frame.type.at(c, r) != kCellObstacle) continue;
      const auto [ahead, beside] = from_camera((r + 0.5) * cell_m_, (sight.half - c - 0.5) * cell_m_);
      shadow_.add(ahead, beside, cell_m_);
    }
  }
}

// Behind what the frame shows. What is remembered there from far away only was probably never seen: the error of a depth put it there,
// and from here nothing can show that it is not there.
bool RollingMap::is_hidden(double forward, double left) const {
  const auto [ahead, beside] = from_camera(forward, left);
  return shadow_.covers(ahead, beside, kHiddenM);
}

void RollingMap::lose(std::size_t i, int evidence) {
  memory_.evidence[i] = static_cast<std::uint8_t>(std::max<int>(kFree + 1, memory_.evidence[i] - evidence));
}

// Far away a matcher goes on with the floor into a wall that shows nothing. Where it was looked for from near by in vain, only a look from
// near by makes free ground of it.
bool RollingMap::is_refuted(std::size_t i, double forward, double left) const {
  const double far_m = params_.blind_m + kDoubtM;
  return looked_in_vain(i) && forward * forward + left * left > far_m * far_m;
}

// A cell without an obstacle in which the frame shows nothing.
void RollingMap::look_in_vain(std::size_t i, double forward, double left) {
  if (params_.view <= 0 || !looks_at(forward, left) || is_hidden(forward, left)) return;
  std::int16_t& times = memory_.height[i];
  if (times < kDoubts && ++times < kDoubts) return;
  memory_.evidence[i] = 0;
  memory_.seen[i] = now_;
}

void RollingMap::clear_seen_free(const NavGrid& frame, const Sight& sight,
                                 ImageView<const std::int16_t> disparity) {
  visit_below(sight, [&](std::size_t i, std::int64_t row, std::int64_t column) {
    const auto c = static_cast<int>(column >> kFraction);
    const auto r = static_cast<int>(row >> kFraction);
    const double forward = cells_of(row) * cell_m_;
    const double left = (sight.half - cells_of(column)) * cell_m_;
    const std::uint8_t type = frame.type.at(c, r);
    const std::uint8_t evidence = memory_.evidence[i];
    if (type == kCellUnoccupied && floor_goes_on(frame, r, c)) {
      if (!is_refuted(i, forward, left)) see_free(i, forward, left, disparity);
    } else if (type == kCellObstacle) {
      if (evidence == kFree) memory_.evidence[i] = 0;
      if (evidence <= kFree) memory_.height[i] = 0;
    } else if (evidence <= kFree) {
      look_in_vain(i, forward, left);
    } else if (is_beside_hit(frame, r, c)) {
      lose(i, kTrimmed);
    } else if (is_hidden(forward, left)) {
      if (evidence <= kFree + kMostFar) lose(i, kHidden);
    } else {
      see_through(i, forward, left, disparity);
    }
  });
}

}  // namespace lakshya

#include "app/nav/vfh.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace lakshya {
namespace {

// Rounding must not decide between valleys that are mirror images.
constexpr double kAngleTolerance = 1e-9;

// From the target to the opening's nearer edge; 0 inside.
double angle_to(const Opening& opening, double target) {
  const double half = opening.count * kSectorAngle / 2;
  const double middle = sector_centre(opening.first) - kSectorAngle / 2 + half;
  return std::max(0.0, angle_between(target, middle) - half);
}

// Openings come from right to left, so that the last of equals is on the left.
const Opening* nearest_valley(const Openings& valleys, double target) {
  const Opening* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Opening& valley : valleys.view()) {
    const double angle = angle_to(valley, target);
    if (angle > least + kAngleTolerance) continue;
    nearest = &valley;
    least = angle;
  }
  return nearest;
}

double nearer_end(const Interval& between, double target) {
  const double right = wrap_angle(between.middle - between.right);
  const double left = wrap_angle(between.middle + between.left);
  return angle_between(right, target) + kAngleTolerance < angle_between(left, target) ? right : left;
}

}  // namespace

PolarHistogram smoothed_histogram(std::span<const std::uint32_t, kPolarSectors> histogram, int l) {
  const std::uint64_t window = 2 * static_cast<std::uint64_t>(l) + 1;
  PolarHistogram smoothed{};
  for (int k = 0; k < kPolarSectors; ++k) {
    std::uint64_t sum = 0;
    for (int i = -l; i <= l; ++i)
      sum += static_cast<std::uint64_t>(l + 1 - std::abs(i)) * histogram[sector_index(k + i)];
    const std::uint64_t rounded = (sum + window / 2) / window;  // window is odd
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    smoothed[sector_index(k)] = static_cast<std::uint32_t>(std::min(rounded, kMost));
  }
  return smoothed;
}

std::optional<double> choose_in_valley(const Openings& valleys, const SectorMask& selectable, double target,
                                       int wide_opening_sectors) {
  const Opening* valley = nearest_valley(valleys, target);
  if (valley == nullptr) return std::nullopt;
  const Interval between = between_offsets(*valley, wide_opening_sectors);
  return wrap_angle(target_in(*valley, between, selectable, target).value_or(nearer_end(between, target)));
}

double density_speed(std::uint32_t density, int stop_density, double max_speed_mps) {
  return max_speed_mps * (1 - std::min<double>(density, stop_density) / stop_density);
}

}  // namespace lakshya

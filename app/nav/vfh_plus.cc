#include "app/nav/vfh_plus.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernels/base/units.h"

namespace lakshya {
namespace {

// Rounding must not decide between candidates that are mirror images.
constexpr double kAngleTolerance = 1e-9;

// From an opening's first to its last sector's centre.
double centre_width(const Opening& opening) {
  return (opening.count - 1) * kSectorAngle;
}

double offset_from(Border border, double width, double wide) {
  return border == Border::obstacle ? std::min(wide, width) / 2 : 0.0;
}

double view_margin(Border border) {
  return border == Border::view ? kSectorAngle / 2 : 0.0;
}

class Cheapest {
 public:
  Cheapest(const Wishes& wishes, const DirectionCosts& costs) : wishes_(wishes), costs_(costs) {}

  void offer(double direction) {
    const double candidate = wrap_angle(direction);
    const double cost = direction_cost(candidate, wishes_, costs_);
    if (best_ && !better(candidate, cost)) return;
    best_ = candidate;
    best_cost_ = cost;
  }

  std::optional<double> best() const { return best_; }

 private:
  bool better(double candidate, double cost) const {
    const double cost_gain = best_cost_ - cost;
    if (std::abs(cost_gain) > kAngleTolerance) return cost_gain > 0;
    const double target_gain = angle_between(*best_, wishes_.target) - angle_between(candidate, wishes_.target);
    if (std::abs(target_gain) > kAngleTolerance) return target_gain > 0;
    return candidate > *best_;
  }

  Wishes wishes_;
  DirectionCosts costs_;
  std::optional<double> best_;
  double best_cost_ = 0;
};

struct SideView {
  int free = 0;
  std::uint64_t load = 0;
};

}  // namespace

void turn_with_vehicle(BinaryHistogram& binary, double heading_change) {
  const double turned = wrap_angle(binary.turned + heading_change);
  const int sectors = static_cast<int>(std::lround(turned / kSectorAngle));
  binary.turned = turned - sectors * kSectorAngle;
  std::rotate(binary.blocked.begin(), binary.blocked.begin() + wrap_sector(sectors), binary.blocked.end());
}

SectorMask binary_histogram(std::span<const std::uint32_t, kPolarSectors> histogram, const SectorMask& before,
                            int low, int high) {
  SectorMask blocked = before;
  for (std::size_t k = 0; k < kPolarSectors; ++k) {
    if (std::cmp_greater(histogram[k], high)) blocked[k] = true;
    if (std::cmp_less(histogram[k], low)) blocked[k] = false;
  }
  return blocked;
}

SectorMask mask_turning_circles(const SectorMask& blocked, ImageView<const std::uint8_t> type,
                                const GridGeometry& geometry, const TurningCircles& circles) {
  if (circles.radius_m <= 0) return blocked;
  int left_limit = kSectorBehind + 1;
  int right_limit = kSectorBehind + 1;
  const double cell_m = geometry.cell_mm / 1000.0;
  for (int r = 0; r < geometry.rows; ++r) {
    const double forward = (r + 0.5) * cell_m;
    for (int c = 0; c < geometry.cols; ++c) {
      if (type.at(c, r) != kCellObstacle) continue;
      const int half_cells_left = geometry.cols - 1 - 2 * c;
      const double aside = std::abs(half_cells_left) * cell_m / 2;
      if (std::hypot(forward, aside) > circles.active_radius_m) continue;
      if (std::hypot(forward, aside - circles.radius_m) > circles.radius_m + circles.enlargement_m) continue;
      const int sector = sector_of(std::atan2(aside, forward));
      if (half_cells_left >= 0) left_limit = std::min(left_limit, sector);
      if (half_cells_left <= 0) right_limit = std::min(right_limit, sector);
    }
  }
  SectorMask masked = blocked;
  for (int k = left_limit; k <= kSectorBehind; ++k)
    masked[sector_index(k)] = true;
  for (int k = right_limit; k <= kSectorBehind; ++k)
    masked[sector_index(-k)] = true;
  return masked;
}

Openings find_openings(const SectorMask& selectable, const SectorMask& blocked) {
  Openings found;
  const auto border = [&](int sector) { return blocked[sector_index(sector)] ? Border::obstacle : Border::view; };
  int start = kSectorBehind;
  while (start < kSectorBehind + kPolarSectors && selectable[sector_index(start)])
    ++start;
  if (start == kSectorBehind + kPolarSectors) {
    found.items[0] = {.first = kSectorBehind + 1, .count = kPolarSectors};
    found.count = 1;
    return found;
  }
  for (int k = start + 1; k < start + kPolarSectors; ++k) {
    if (!selectable[sector_index(k)]) continue;
    Opening opening{.first = wrap_sector(k), .right = border(k - 1)};
    for (; selectable[sector_index(k)]; ++k)
      ++opening.count;
    opening.left = border(k);
    found.items[static_cast<std::size_t>(found.count++)] = opening;
  }
  return found;
}

bool Interval::holds(double direction) const {
  const double offset = wrap_angle(direction - middle);
  return -right - kAngleTolerance <= offset && offset <= left + kAngleTolerance;
}

Interval between_offsets(const Opening& opening, int wide_opening_sectors) {
  const double width = centre_width(opening);
  const double wide = wide_opening_sectors * kSectorAngle;
  return {wrap_angle(sector_centre(opening.first) + width / 2), width / 2 - offset_from(opening.right, width, wide),
          width / 2 - offset_from(opening.left, width, wide)};
}

std::optional<double> target_in(const Opening& opening, const Interval& between, const SectorMask& selectable,
                                double target) {
  const Interval reach{between.middle, between.right + view_margin(opening.right),
                       between.left + view_margin(opening.left)};
  if (!reach.holds(target)) return std::nullopt;
  if (selectable[sector_index(sector_of(target))]) return target;
  const double half = centre_width(opening) / 2;
  return between.middle + std::clamp(wrap_angle(target - between.middle), -half, half);
}

Candidates candidates_of(const Opening& opening, const SectorMask& selectable, double target,
                         const DirectionCosts& costs) {
  const Interval between = between_offsets(opening, costs.wide_opening_sectors);
  Candidates found{{wrap_angle(between.middle - between.right), wrap_angle(between.middle + between.left)}, 2};
  if (const auto inside = target_in(opening, between, selectable, target))
    found.items[static_cast<std::size_t>(found.count++)] = wrap_angle(*inside);
  return found;
}

double direction_cost(double c, const Wishes& wishes, const DirectionCosts& costs) {
  const double cost =
      costs.target * angle_between(c, wishes.target) + costs.heading * angle_between(c, wishes.heading);
  if (!wishes.previous) return cost;
  const double change = angle_between(c, *wishes.previous);
  return cost + costs.previous * change - (change <= kSameDirection ? costs.target * costs.commitment : 0);
}

std::optional<double> choose_direction(const Openings& openings, const SectorMask& selectable, const Wishes& wishes,
                                       const DirectionCosts& costs) {
  Cheapest cheapest(wishes, costs);
  for (const Opening& opening : openings.view()) {
    const Candidates candidates = candidates_of(opening, selectable, wishes.target, costs);
    for (const double candidate : candidates.view())
      cheapest.offer(candidate);
  }
  return cheapest.best();
}

Side more_open_side(const SectorMask& blocked, const SectorMask& seen,
                    std::span<const std::uint32_t, kPolarSectors> histogram) {
  SideView left;
  SideView right;
  const auto look = [&](SideView& side, std::size_t k) {
    side.free += seen[k] && !blocked[k] ? 1 : 0;
    side.load += histogram[k];
  };
  for (int k = 1; k < kSectorBehind; ++k) {
    look(left, sector_index(k));
    look(right, sector_index(-k));
  }
  if (left.free != right.free) return left.free > right.free ? Side::left : Side::right;
  return left.load <= right.load ? Side::left : Side::right;
}

}  // namespace lakshya

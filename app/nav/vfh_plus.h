// From polar histogram to direction: docs/contract.md section 5.
// Source: I. Ulrich and J. Borenstein, "VFH+: Reliable Obstacle Avoidance for Fast Mobile Robots", ICRA 1998:
// binary histogram (equation 7), masked histogram (equations 8 to 13), candidates and cost (equations 14 to 18).
// Beyond the paper: openings may end at the border of the view, and the candidate "target" keeps its exact angle.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "app/nav/sectors.h"
#include "kernels/base/image_view.h"
#include "kernels/base/nav_grid.h"

namespace lakshya {

// Blocked sectors as of the last frame, kept fixed to the world while the vehicle turns.
struct BinaryHistogram {
  SectorMask blocked{};  // starts free
  double turned = 0;     // rad turned since, not yet a whole sector: within half a sector either way
};

// Turns the sectors against the vehicle's own turn (rad, counter-clockwise positive) by whole sectors; what is
// left over is carried to the next call.
void turn_with_vehicle(BinaryHistogram& binary, double heading_change);

// Equation 7: above `high` blocked, below `low` free, between them as before.
SectorMask binary_histogram(std::span<const std::uint32_t, kPolarSectors> histogram, const SectorMask& before,
                            int low, int high);

struct TurningCircles {
  double radius_m = 0;         // r, of the smallest turn; 0 turns in place and masks nothing
  double enlargement_m = 0;    // r_robot + d_safe
  double active_radius_m = 0;  // r_a: cells beyond are not looked at
};

// Adds the sectors that cannot be reached. An obstacle cell to the left (right) whose centre lies within
// r + enlargement of the left (right) turning circle's centre (0, r) ((0, -r)) blocks from the sector that holds
// it outward on its side to behind; one straight ahead counts for both sides. With r = 0 that is the half-plane
// rule, which the histogram has already.
SectorMask mask_turning_circles(const SectorMask& blocked, ImageView<const std::uint8_t> type,
                                const GridGeometry& geometry, const TurningCircles& circles);

enum class Border : std::uint8_t { obstacle, view };

// A maximal run of selectable sectors, `count` from `first` counter-clockwise. A side borders on an obstacle when
// the next sector is blocked (seen or not), else on the end of what is seen.
struct Opening {
  int first = 0;
  int count = 0;
  Border right = Border::view;
  Border left = Border::view;

  double right_edge() const { return wrap_angle(sector_centre(first) - kSectorAngle / 2); }
  double left_edge() const { return wrap_angle(sector_centre(first + count - 1) + kSectorAngle / 2); }
};

struct Openings {
  std::array<Opening, kPolarSectors / 2> items{};
  int count = 0;

  std::span<const Opening> view() const { return {items.data(), static_cast<std::size_t>(count)}; }
};

// From behind counter-clockwise, that is from right to left.
Openings find_openings(const SectorMask& selectable, const SectorMask& blocked);

// Directions from `right` to `left` of a middle, rad.
struct Interval {
  double middle = 0;
  double right = 0;
  double left = 0;

  bool holds(double direction) const;
};

// What an opening leaves to choose from, measured between its first and its last sector's centre: with w the angle
// between these two, a side that borders on an obstacle is kept away from by min(s_max / 2 sectors, w / 2), a side
// that borders on the view by 0.
Interval between_offsets(const Opening& opening, int wide_opening_sectors);

// The target's direction, if `between` holds it or it lies up to half a sector (the opening's edge) outside a side
// that borders on the view; moved to the opening's nearest centre where its own sector is not selectable.
std::optional<double> target_in(const Opening& opening, const Interval& between, const SectorMask& selectable,
                                double target);

struct Wishes {
  double target = 0;                              // rad
  double heading = 0;                             // rad
  std::optional<double> previous = std::nullopt;  // rad; without one its cost term is dropped
};

struct DirectionCosts {
  double target = 5;              // mu1
  double heading = 2;             // mu2
  double previous = 2;            // mu3
  int wide_opening_sectors = 16;  // s_max
  double commitment =
      0;  // rad by which another candidate must be nearer to the target than one of the same direction as
          // the previous choice, which is within kSameDirection of it
};

inline constexpr double kSameDirection = radians(15);

// mu1 |c - target| + mu2 |c - heading| + mu3 |c - previous|, smallest differences, and the commitment's bonus.
double direction_cost(double candidate, const Wishes& wishes, const DirectionCosts& costs);

// What an opening offers: the two ends of between_offsets(), as in VFH+, and target_in().
struct Candidates {
  std::array<double, 3> items{};
  int count = 0;

  std::span<const double> view() const { return {items.data(), static_cast<std::size_t>(count)}; }
};
Candidates candidates_of(const Opening& opening, const SectorMask& selectable, double target,
                         const DirectionCosts& costs);

// The cheapest candidate of all openings, in [-pi, pi]; none without an opening.
//
// Between two obstacles a narrow opening gives its centre, a wide one s_max / 2 from each side. Equal costs: the candidate nearer
// the target, then the one on the left.
std::optional<double> choose_direction(const Openings& openings, const SectorMask& selectable, const Wishes& wishes,
                                       const DirectionCosts& costs);

enum class Side : std::uint8_t { left, right };

// Where to turn when nothing is selectable: the side with more sectors that are seen and free, behind and straight
// ahead left out; then the one with the smaller histogram sum; then left.
Side more_open_side(const SectorMask& blocked, const SectorMask& seen,
                    std::span<const std::uint32_t, kPolarSectors> histogram);

}  // namespace lakshya

// The original vector field histogram: docs/contract.md section 5.
// Source: J. Borenstein and Y. Koren, "The Vector Field Histogram - Fast Obstacle Avoidance for Mobile Robots", IEEE
// Transactions on Robotics and Automation 7(3), 1991, pp. 278-288: first data reduction (smoothing), second data
// reduction (valleys and steering), speed control. Equations are quoted below in words and symbols, since reprints
// number them differently. The weights of single cells are PolarWeight::linear of kernels/polar_histogram.
//
// Nothing here knows the vehicle's size: that is left to the smoothing, which widens every obstacle by the same angle
// at any distance. Far away this closes gaps that are wide enough, nearby it leaves open what is too narrow. VFH+
// widens by asin(size / distance) instead, which is why it is the default.
//
// Not built: the path monitor, which keeps passing an obstacle on the side once chosen and asks a global planner for
// help in a dead end.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "app/nav/vfh_plus.h"
#include "kernels/polar_histogram/polar_histogram.h"

namespace lakshya {

inline constexpr int kMaxSmoothing = 17;  // l: the window of 2 l + 1 sectors spans at most half the circle

// h'_k = (h_{k-l} + 2 h_{k-l+1} + ... + (l+1) h_k + ... + 2 h_{k+l-1} + h_{k+l}) / (2 l + 1), around the circle;
// rounded to nearest, 2^32 - 1 where it would be more. l: 0 (no smoothing) to kMaxSmoothing; 1991: 5. The paper prints
// "l" as the weight of h_k, which does not fit the row 1, 2, ... that ends there. The weights add up to (l+1)^2, so
// that even sectors become larger by (l+1)^2 / (2 l + 1), 3.3 for l = 5.
PolarHistogram smoothed_histogram(std::span<const std::uint32_t, kPolarSectors> histogram, int l);

// The steering direction, in [-pi, pi]; none without a valley. Valleys are openings (find_openings) of sectors whose
// smoothed density does not exceed the threshold. Chosen is the valley nearest to the target (equal: the one on the
// left), then in it
//  narrow (at most s_max sectors; 1991: 18):  theta = (k_n + k_f) / 2, its middle;
//  wide:  theta = (k_n + k_f) / 2 with k_n the border nearest to the target and k_f = k_n + s_max, that is s_max / 2
//         away from this border; the target itself where it is at least that far from both borders.
// The last half-sentence is how the paper is read here: it calls the free sector nearest to the target k_n, a border.
// Beyond the paper, as for VFH+: a side that is the border of the view is kept away from by 0 (between_offsets), and
// the target keeps its exact angle (target_in).
std::optional<double> choose_in_valley(const Openings& valleys, const SectorMask& selectable, double target,
                                       int wide_opening_sectors);

// V' = V_max (1 - h'' / h_m), h'' = min(h'_c, h_m), with h'_c the smoothed density in the direction of travel. h_m > 0.
// The paper's lower limit V_min is left out: whether to stop is the governor's decision.
double density_speed(std::uint32_t density, int stop_density, double max_speed_mps);

}  // namespace lakshya

// Looking ahead before choosing: docs/contract.md section 5.
// Source: I. Ulrich and J. Borenstein, "VFH*: Local Obstacle Avoidance with Look-Ahead Verification", ICRA 2000. Each candidate
// of VFH+ is followed by a step of the vehicle, there VFH+ finds its candidates again, and so on; A* finds the cheapest way of
// `depth` steps, and its first step's candidate is taken. So the vehicle does not enter what turns out to be a dead end there.
//
// As the paper has it: the costs of projected candidates (their own weights, discounted with 0.8^depth) and the heuristic, the
// cost of turning straight to the target. A candidate here is one that VFH+ offers (offer_candidates).
// Beyond the paper: a step is a turn on the spot and a straight line, which must stay `clearance_m` away from every obstacle cell;
// a way that would have to turn back has come to its end; what is unknown counts as free, since VFH+ has the last word about the first step; a way that ends in front of an obstacle is
// taken only if no other is as long; two places of one depth less than a third of a step apart are one, the cheaper; and there
// are at most kStarNodes of them, so that the time is bounded.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "app/nav/vfh_plus.h"
#include "kernels/base/image_view.h"
#include "kernels/base/nav_grid.h"

namespace lakshya {

inline constexpr int kStarNodes = 256;
inline constexpr int kStarMaxDepth = 16;
inline constexpr int kStarCells = 2048;

struct StarParams {
  double step_m = 0.6;  // > 0
  int depth = 5;        // steps, 1 to kStarMaxDepth
  double clearance_m = 0.4;
  double active_radius_m = 5;  // of the histogram's table
  int threshold = 120;         // histogram value above which a sector is blocked at a projected place
};

// Border cells of the obstacles (those with a neighbour, of four, that is none) within a radius of the turning centre, the first
// kStarCells of them from the nearest row on.
struct StarCells {
  struct Cell {
    std::int16_t row = 0;
    std::int16_t col = 0;
  };
  std::array<Cell, kStarCells> items;
  int count = 0;
};
void find_star_cells(ImageView<const std::uint8_t> type, const GridGeometry& geometry, double radius_m,
                     StarCells& cells);

// The histogram about a place `rows` cells ahead of the turning centre and `left` cells to its left, from the table that the
// turning centre's is summed with (build_polar_table); directions as seen from the vehicle as it stands. Cells farther from the
// place than the table reaches are left out.
PolarHistogram star_histogram(const StarCells& cells, const GridGeometry& geometry,
                              std::span<const PolarEntry> table, int rows, int left);

// The turning centre's histogram with another enlargement than the table's, without one: for the rare frame that needs it.
PolarHistogram star_histogram(const StarCells& cells, const GridGeometry& geometry, double active_radius_m,
                              double enlargement_m);

struct StarMap {
  ImageView<const std::uint8_t> type;
  GridGeometry geometry;
  std::span<const PolarEntry> table;
};

// The direction of the first step of the cheapest way, one of what `openings` offer; none without an opening. `target_m`: how far
// the target is; ways end there.
std::optional<double> choose_by_look_ahead(const StarMap& map, const Openings& openings,
                                           const SectorMask& selectable, const Wishes& wishes, double target_m,
                                           const DirectionCosts& costs, const StarParams& params);

}  // namespace lakshya

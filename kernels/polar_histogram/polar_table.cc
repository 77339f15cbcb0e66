#include <algorithm>
#include <cstdlib>

#include "kernels/polar_histogram/polar_histogram.h"

namespace lakshya {
namespace {

// Cell centres lie on half millimetres when a cell has an odd width, so lengths here are twice the millimetres.
struct Point {
  std::int64_t forward = 0;
  std::int64_t left = 0;
};

struct Reach {
  std::int64_t active = 0;
  std::int64_t enlargement = 0;
  PolarWeight weight = PolarWeight::squared;
};

constexpr std::int64_t kUnit = std::int64_t{1} << 30;

// round(2^30 sin(5 k degrees)), k = 0 to 18.
constexpr std::array<std::int64_t, 19> kQuarterSine = {0,          93582766,   186453311,  277904834, 367241333,
                                                       453782903,  536870912,  615873009,  690187940, 759250125,
                                                       822533958,  879557810,  929887697,  973140576, 1008987269,
                                                       1037154959, 1057429273, 1069655912, 1073741824};

constexpr std::int64_t sine(int sector) {
  const int k = sector % kPolarSectors;
  if (k > 36) return -sine(k - 36);
  return kQuarterSine[static_cast<std::size_t>(k > 18 ? 36 - k : k)];
}

constexpr std::int64_t cosine(int sector) {
  return sine(sector + 18);
}

std::int64_t dot(const Point& p, int sector) {
  return p.forward * cosine(sector) + p.left * sine(sector);
}
std::int64_t cross(const Point& p, int sector) {
  return p.forward * sine(sector) - p.left * cosine(sector);
}

bool reaches_sector(const Point& p, int sector, std::int64_t enlargement) {
  return dot(p, sector) >= 0 && std::abs(cross(p, sector)) <= enlargement * kUnit;
}

int sector_holding(const Point& p) {
  int best = 0;
  for (int k = 1; k < kPolarSectors; ++k)
    if (dot(p, k) > dot(p, best)) best = k;
  return best;
}

std::int64_t square_distance(const Point& p) {
  return p.forward * p.forward + p.left * p.left;
}

std::uint16_t squared_weight(std::int64_t square, std::int64_t active) {
  const std::int64_t square_active = active * active;
  return static_cast<std::uint16_t>((2LL * kPolarMaxWeight * (square_active - square) + square_active) /
                                    (2 * square_active));
}

constexpr std::uint64_t squared(std::uint64_t x) {
  return x * x;
}

// The largest w with w <= 1000 (1 - d / r_a) + 1/2, that is 2000 d <= (2001 - 2 w) r_a; both sides squared, so that
// no root is needed. The squares stay below 2^64 for every r_a that is allowed.
std::uint16_t linear_weight(std::int64_t square, std::int64_t active) {
  constexpr std::uint32_t kTwice = 2U * kPolarMaxWeight;
  const std::uint64_t wanted = squared(kTwice) * static_cast<std::uint64_t>(square);
  std::uint32_t weight = 0;
  for (std::uint32_t bit = 512; bit > 0; bit /= 2) {
    const std::uint32_t larger = weight + bit;
    if (larger > kPolarMaxWeight) continue;
    if (wanted <= squared((kTwice + 1 - 2 * larger) * static_cast<std::uint64_t>(active))) weight = larger;
  }
  return static_cast<std::uint16_t>(weight);
}

std::uint16_t weight_at(std::int64_t square, const Reach& reach) {
  return reach.weight == PolarWeight::linear ? linear_weight(square, reach.active)
                                             : squared_weight(square, reach.active);
}

PolarEntry entry_at(const Point& p, const Reach& reach) {
  const std::int64_t square = square_distance(p);
  if (square > reach.active * reach.active) return {};
  const int middle = sector_holding(p);
  int right = 0;
  int left = 0;
  while (reaches_sector(p, middle + left + 1, reach.enlargement))
    ++left;
  while (reaches_sector(p, middle + kPolarSectors - right - 1, reach.enlargement))
    ++right;
  return {weight_at(square, reach), static_cast<std::uint8_t>((middle + kPolarSectors - right) % kPolarSectors),
          static_cast<std::uint8_t>(right + 1 + left)};
}

PolarEntry mirrored(const PolarEntry& e) {
  if (e.count == 0) return e;
  const int last = e.first + e.count - 1;
  return {e.weight, static_cast<std::uint8_t>((2 * kPolarSectors - last) % kPolarSectors), e.count};
}

bool usable(const PolarParams& p) {
  return 1 <= p.active_radius_mm && p.active_radius_mm <= kPolarMaxActiveRadiusMm && 0 <= p.enlargement_mm &&
         p.enlargement_mm <= kPolarMaxActiveRadiusMm;
}

bool in_range(int value, int limit) {
  return 1 <= value && value <= limit;
}

}  // namespace

std::size_t polar_table_entries(const GridGeometry& g) {
  if (!in_range(g.rows, kPolarMaxSide) || !in_range(g.cols, kPolarMaxSide) || !in_range(g.cell_mm, kPolarMaxCellMm))
    return 0;
  return static_cast<std::size_t>(g.rows) * static_cast<std::size_t>(g.cols);
}

PolarWindow polar_window(const GridGeometry& g, const PolarParams& p) {
  if (polar_table_entries(g) == 0 || !usable(p)) return {};
  // Cell centres at (2 r + 1) / 2 cells forward and (cols - 1 - 2 c) / 2 cells to the left, none beyond r_a.
  const int half_cells = 2 * p.active_radius_mm / g.cell_mm;
  const int col_begin = std::max(0, (g.cols - half_cells) / 2);
  return {0, std::min(g.rows, (half_cells + 1) / 2), col_begin, g.cols - col_begin};
}

Status build_polar_table(const GridGeometry& g, const PolarParams& params, std::span<PolarEntry> table) {
  const std::size_t entries = polar_table_entries(g);
  if (entries == 0 || !usable(params)) return Status::bad_argument;
  if (table.size() != entries) return Status::size_mismatch;

  const Reach reach{2LL * params.active_radius_mm, 2LL * params.enlargement_mm, params.weight};
  for (int r = 0; r < g.rows; ++r) {
    const auto row = table.subspan(static_cast<std::size_t>(r) * static_cast<std::size_t>(g.cols));
    for (int c = 0; 2 * c < g.cols; ++c) {
      const Point centre{(2LL * r + 1) * g.cell_mm, (g.cols - 1LL - 2LL * c) * g.cell_mm};
      const PolarEntry entry = entry_at(centre, reach);
      row[static_cast<std::size_t>(g.cols - 1 - c)] = mirrored(entry);
      row[static_cast<std::size_t>(c)] = entry;
    }
  }
  return Status::ok;
}

}  // namespace lakshya

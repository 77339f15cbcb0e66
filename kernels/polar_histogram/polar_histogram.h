// Polar obstacle histogram about the turning centre: docs/contract.md section 5.
// Sources: I. Ulrich and J. Borenstein, "VFH+: Reliable Obstacle Avoidance for Fast Mobile Robots", ICRA 1998,
// section 2 (the primary polar histogram, equations 1 to 6); for PolarWeight::linear J. Borenstein and Y. Koren, "The
// Vector Field Histogram - Fast Obstacle Avoidance for Mobile Robots", IEEE Transactions on Robotics and Automation
// 7(3), 1991, section on the first data reduction (m = c^2 (a - b d), summed per sector).
//
// 72 sectors of 5 degrees, counter-clockwise; sector k is centred on 5 k degrees from straight ahead, so that
// sector 18 is left, 36 behind, 71 is 5 degrees to the right. Turning centre: the grid's origin, the near edge of
// row 0, half way across.
//
// A cell whose centre lies at distance d <= r_a and bearing beta adds
//   squared: weight = round(1000 (1 - d^2 / r_a^2))                 (c = 1, a - b r_a^2 = 0; half rounds up)
//   linear:  weight = round(1000 (1 - d / r_a))                     (c = 1, a - b r_a = 0; half rounds up)
// to every sector whose centre lies in [beta - gamma, beta + gamma], sin(gamma) = enlargement / d; for
// d <= enlargement to the half-plane, [beta - 90, beta + 90] degrees; always to the sector that holds beta. The
// histogram of 1991 has no enlargement: with 0 a cell adds to the sector that holds beta and to no other.
// Both rules are one integer test: the sector's centre ray points towards the cell (dot >= 0) and passes it within
// `enlargement` (|cross| <= enlargement), with sines rounded to 2^-30. Tables are therefore equal on every machine,
// and mirrored about straight ahead.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "kernels/base/image_view.h"
#include "kernels/base/nav_grid.h"
#include "kernels/base/status.h"

namespace lakshya {

inline constexpr int kPolarSectors = 72;
inline constexpr int kPolarSectorDegrees = 5;
inline constexpr std::uint16_t kPolarMaxWeight = 1000;

// Limits within which no sum overflows: 2000 x 2000 cells of weight 1000 stay below 2^32.
inline constexpr int kPolarMaxSide = 2000;  // cells
inline constexpr std::int32_t kPolarMaxCellMm = 10'000;
inline constexpr std::int32_t kPolarMaxActiveRadiusMm = 1'000'000;

enum class PolarWeight : std::uint8_t { squared, linear };

struct PolarParams {
  std::int32_t active_radius_mm = 5000;  // r_a, 1 to kPolarMaxActiveRadiusMm
  std::int32_t enlargement_mm = 450;     // r_robot + d_safe, 0 to kPolarMaxActiveRadiusMm
  PolarWeight weight = PolarWeight::squared;
};

// What one obstacle cell adds: `weight` to `count` sectors from `first` counter-clockwise. Zeros beyond r_a.
struct PolarEntry {
  std::uint16_t weight = 0;  // 0 to kPolarMaxWeight
  std::uint8_t first = 0;    // 0 to kPolarSectors - 1
  std::uint8_t count = 0;    // 1 to 37 within r_a
  friend bool operator==(const PolarEntry&, const PolarEntry&) = default;
};

// Rows and columns, half-open, outside which every entry is zero. The default is the whole grid.
struct PolarWindow {
  int row_begin = 0;
  int row_end = std::numeric_limits<int>::max();
  int col_begin = 0;
  int col_end = std::numeric_limits<int>::max();
};

using PolarHistogram = std::array<std::uint32_t, kPolarSectors>;

// rows x cols, row by row; 0 when the geometry is outside the limits above.
std::size_t polar_table_entries(const GridGeometry& geometry);

// The part of the grid that r_a reaches. Geometry and params as for build_polar_table.
PolarWindow polar_window(const GridGeometry& geometry, const PolarParams& params);

// Fills the caller's table. bad_argument: geometry or params outside the limits; size_mismatch: the table does
// not have polar_table_entries(geometry) entries.
Status build_polar_table(const GridGeometry& geometry, const PolarParams& params, std::span<PolarEntry> table);

// Sums the entries of the cells of type kCellObstacle inside the window (clipped to the grid); every other type
// adds nothing. The histogram is overwritten. `type` is rows x cols; size_mismatch: the table is not of its size.
Status polar_histogram_ref(ImageView<const std::uint8_t> type, std::span<const PolarEntry> table,
                           std::span<std::uint32_t, kPolarSectors> histogram, const PolarWindow& window = {});
Status polar_histogram_simd(ImageView<const std::uint8_t> type, std::span<const PolarEntry> table,
                            std::span<std::uint32_t, kPolarSectors> histogram, const PolarWindow& window = {});

}  // namespace lakshya

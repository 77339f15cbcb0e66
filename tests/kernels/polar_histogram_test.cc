#include "kernels/polar_histogram/polar_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "kernels/base/units.h"
#include "tests/support/each_isa.h"
#include "tests/support/test_image.h"

namespace lakshya {
namespace {

// 10 rows, 11 columns: column 5 lies straight ahead.
constexpr GridGeometry kOdd{.rows = 10, .cols = 11, .cell_mm = 100};
constexpr PolarParams kNear{.active_radius_mm = 1000, .enlargement_mm = 100};

std::vector<PolarEntry> table_of(const GridGeometry& geometry, const PolarParams& params) {
  std::vector<PolarEntry> table(polar_table_entries(geometry));
  EXPECT_EQ(build_polar_table(geometry, params, table), Status::ok);
  return table;
}

const PolarEntry& at(const std::vector<PolarEntry>& table, const GridGeometry& g, int r, int c) {
  return table[static_cast<std::size_t>(r) * static_cast<std::size_t>(g.cols) + static_cast<std::size_t>(c)];
}

PolarEntry entry(int weight, int first, int count) {
  return {static_cast<std::uint16_t>(weight), static_cast<std::uint8_t>(first), static_cast<std::uint8_t>(count)};
}

void expect_entry(const PolarEntry& actual, const PolarEntry& expected) {
  EXPECT_EQ(actual.weight, expected.weight);
  EXPECT_EQ(actual.first, expected.first);
  EXPECT_EQ(actual.count, expected.count);
}

TEST(PolarTable, HandComputedEntries) {
  const auto table = table_of(kOdd, kNear);
  // 450 ahead: 1000 (1 - 0.2025) = 797.5; asin(100 / 450) = 12.8 deg, sectors -10 to 10 deg.
  expect_entry(at(table, kOdd, 4, 5), entry(798, 70, 5));
  // 50 ahead, inside the enlargement: the half-plane from -90 to 90 deg.
  expect_entry(at(table, kOdd, 0, 5), entry(998, 54, 37));
  // 450 ahead, 500 left: 48.01 deg, d^2 = 452500, asin(100 / 672.7) = 8.55 deg, sectors 40 to 55 deg.
  expect_entry(at(table, kOdd, 4, 0), entry(548, 8, 4));
  // The same to the right: sectors -55 to -40 deg.
  expect_entry(at(table, kOdd, 4, 10), entry(548, 61, 4));
  // 950 ahead, 400 left: 1030.8 away, outside.
  expect_entry(at(table, kOdd, 9, 1), entry(0, 0, 0));
  // 950 ahead: 1000 (1 - 0.9025) = 97.5; asin(100 / 950) = 6.04 deg.
  expect_entry(at(table, kOdd, 9, 5), entry(98, 71, 3));
}

TEST(PolarTable, WithoutEnlargementOneSectorHoldsTheCell) {
  const auto table = table_of(kOdd, {.active_radius_mm = 1000, .enlargement_mm = 0});
  expect_entry(at(table, kOdd, 4, 0), entry(548, 10, 1));   // 48.01 deg
  expect_entry(at(table, kOdd, 4, 10), entry(548, 62, 1));  // -48.01 deg
  expect_entry(at(table, kOdd, 4, 5), entry(798, 0, 1));
}

TEST(PolarTable, HandComputedLinearWeights) {
  const auto table = table_of(kOdd, {1000, 0, PolarWeight::linear});
  expect_entry(at(table, kOdd, 0, 5), entry(950, 0, 1));   // 50 ahead
  expect_entry(at(table, kOdd, 4, 5), entry(550, 0, 1));   // 450 ahead
  expect_entry(at(table, kOdd, 4, 0), entry(327, 10, 1));  // 672.7 away: 327.3
  expect_entry(at(table, kOdd, 4, 10), entry(327, 62, 1));
  expect_entry(at(table, kOdd, 9, 1), entry(0, 0, 0));  // 1030.8 away
  // 1001 of 2000 away: 499.5, half rounds up.
  const GridGeometry fine{.rows = 501, .cols = 1, .cell_mm = 2};
  expect_entry(at(table_of(fine, {2000, 0, PolarWeight::linear}), fine, 500, 0), entry(500, 0, 1));
  // The cell that ends the active radius, and the limits: 2000 cells of 500 mm in 1 km.
  const GridGeometry large{.rows = 2000, .cols = 1, .cell_mm = 500};
  const auto far = table_of(large, {kPolarMaxActiveRadiusMm, 0, PolarWeight::linear});
  for (int r = 0; r < large.rows; ++r)
    ASSERT_EQ(at(far, large, r, 0).weight, (4 * 1000 - (2 * r + 1) + 2) / 4);  // d / r_a = (2 r + 1) / 4000
}

TEST(PolarTable, HalfPlaneBesideTheVehicle) {
  // 50 ahead, 100 left: 63.4 deg, inside the enlargement of 200: -26.6 to 153.4 deg, centres -25 to 150.
  const auto table = table_of(kOdd, {.active_radius_mm = 1000, .enlargement_mm = 200});
  expect_entry(at(table, kOdd, 0, 4), entry(988, 67, 36));
}

// The definition in floating point, which decides all but the sectors on the very edge.
struct Definition {
  double beta;  // degrees
  double gamma;
  double weight;

  bool sure_in(int k) const { return std::abs(off(k)) < gamma - 1e-6; }
  bool sure_out(int k) const { return std::abs(off(k)) > gamma + 1e-6; }
  double off(int k) const { return std::remainder(k * 5.0 - beta, 360.0); }
};

Definition define(const GridGeometry& g, const PolarParams& p, int r, int c) {
  const double forward = (r + 0.5) * g.cell_mm;
  const double left = (g.cols / 2.0 - c - 0.5) * g.cell_mm;
  const double d = std::hypot(forward, left);
  const double deg = 180 / std::numbers::pi;
  return {std::atan2(left, forward) * deg, d <= p.enlargement_mm ? 90.0 : std::asin(p.enlargement_mm / d) * deg,
          1000 * (1 - d * d / p.active_radius_mm / p.active_radius_mm)};
}

bool covers(const PolarEntry& e, int sector) {
  return (sector - e.first + kPolarSectors) % kPolarSectors < e.count;
}

void expect_follows(const PolarEntry& e, const Definition& wanted) {
  if (wanted.weight < -1e-6) {
    expect_entry(e, entry(0, 0, 0));
    return;
  }
  EXPECT_NEAR(e.weight, wanted.weight, 0.5 + 1e-6);
  for (int k = 0; k < kPolarSectors; ++k) {
    const bool nearest = std::abs(wanted.off(k)) < 2.5;
    if (nearest || wanted.sure_in(k)) {
      EXPECT_TRUE(covers(e, k)) << wanted.beta << " " << k;
    } else if (wanted.sure_out(k)) {
      EXPECT_FALSE(covers(e, k)) << wanted.beta << " " << k;
    }
  }
}

TEST(PolarTable, FollowsTheDefinitionForRandomGrids) {
  std::mt19937 random(5);
  const auto draw = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low));
  };
  for (int world = 0; world < 40; ++world) {
    const GridGeometry g{draw(1, 30), draw(1, 31), draw(1, 200)};
    const PolarParams p{draw(1, 4000), draw(0, 900)};
    const auto table = table_of(g, p);
    for (int r = 0; r < g.rows; ++r) {
      for (int c = 0; c < g.cols; ++c)
        expect_follows(at(table, g, r, c), define(g, p, r, c));
    }
  }
}

TEST(PolarTable, MirroredAboutStraightAhead) {
  for (const int cols : {1, 2, 40, 41}) {
    const GridGeometry g{.rows = 30, .cols = cols, .cell_mm = 70};
    const auto table = table_of(g, {.active_radius_mm = 1900, .enlargement_mm = 333});
    for (int r = 0; r < g.rows; ++r) {
      for (int c = 0; c < cols; ++c) {
        const PolarEntry& e = at(table, g, r, c);
        const PolarEntry& m = at(table, g, r, cols - 1 - c);
        EXPECT_EQ(e.weight, m.weight);
        for (int k = 0; k < kPolarSectors; ++k)
          ASSERT_EQ(covers(e, k), covers(m, (kPolarSectors - k) % kPolarSectors));
      }
    }
  }
}

TEST(PolarTable, LargerEnlargementCoversMore) {
  const auto narrow = table_of(kOdd, {.active_radius_mm = 1000, .enlargement_mm = 100});
  const auto wide = table_of(kOdd, {.active_radius_mm = 1000, .enlargement_mm = 300});
  for (std::size_t i = 0; i < narrow.size(); ++i) {
    for (int k = 0; k < kPolarSectors; ++k)
      EXPECT_LE(covers(narrow[i], k), covers(wide[i], k));
  }
}

TEST(PolarTable, Refusals) {
  EXPECT_EQ(polar_table_entries(kOdd), 110U);
  EXPECT_EQ(polar_table_entries({.rows = 0, .cols = 1, .cell_mm = 1}), 0U);
  EXPECT_EQ(polar_table_entries({.rows = 1, .cols = -1, .cell_mm = 1}), 0U);
  EXPECT_EQ(polar_table_entries({.rows = 1, .cols = 1, .cell_mm = 0}), 0U);
  EXPECT_EQ(polar_table_entries({.rows = 2001, .cols = 1, .cell_mm = 1}), 0U);
  EXPECT_EQ(polar_table_entries({.rows = 1, .cols = 2001, .cell_mm = 1}), 0U);
  EXPECT_EQ(polar_table_entries({.rows = 1, .cols = 1, .cell_mm = 10'001}), 0U);

  std::vector<PolarEntry> table(110);
  EXPECT_EQ(build_polar_table({.rows = 0, .cols = 1, .cell_mm = 1}, kNear, {}), Status::bad_argument);
  EXPECT_EQ(build_polar_table(kOdd, {.active_radius_mm = 0, .enlargement_mm = 1}, table), Status::bad_argument);
  EXPECT_EQ(build_polar_table(kOdd, {.active_radius_mm = 1'000'001, .enlargement_mm = 1}, table),
            Status::bad_argument);
  EXPECT_EQ(build_polar_table(kOdd, {.active_radius_mm = 1, .enlargement_mm = -1}, table), Status::bad_argument);
  EXPECT_EQ(build_polar_table(kOdd, {.active_radius_mm = 1, .enlargement_mm = 1'000'001}, table),
            Status::bad_argument);
  table.pop_back();
  EXPECT_EQ(build_polar_table(kOdd, kNear, table), Status::size_mismatch);
}

TEST(PolarTable, LargestLengthsDoNotOverflow) {
  const GridGeometry g{.rows = 101, .cols = 101, .cell_mm = kPolarMaxCellMm};
  const auto table =
      table_of(g, {.active_radius_mm = kPolarMaxActiveRadiusMm, .enlargement_mm = kPolarMaxActiveRadiusMm});
  expect_entry(at(table, g, 0, 50), entry(1000, 54, 37));  // 5 m of 1000 m ahead
  expect_entry(at(table, g, 100, 0), entry(0, 0, 0));      // 1005 m ahead, 500 m left
}

TEST(PolarWindow, HoldsExactlyTheEntriesWithinReach) {
  for (const auto& [g, radius] : {std::pair{kOdd, 1000},
                                  {kOdd, 399},
                                  {kOdd, 450},
                                  {kOdd, 49},
                                  {kOdd, 5000},
                                  {GridGeometry{20, 30, 70}, 701},
                                  {GridGeometry{20, 30, 70}, 1}}) {
    const PolarParams p{radius, 100};
    const PolarWindow w = polar_window(g, p);
    const auto table = table_of(g, p);
    int rows = 0;
    int left_most = g.cols;
    for (int r = 0; r < g.rows; ++r) {
      for (int c = 0; c < g.cols; ++c) {
        if (at(table, g, r, c).count == 0) continue;
        EXPECT_TRUE(r < w.row_end && w.col_begin <= c && c < w.col_end) << r << " " << c;
        rows = r + 1;
        left_most = std::min(left_most, c);
      }
    }
    EXPECT_EQ(w.row_begin, 0);
    EXPECT_EQ(w.row_end, rows);
    EXPECT_EQ(w.col_end, g.cols - w.col_begin);
    EXPECT_TRUE(rows == 0 || left_most - w.col_begin <= 1);  // no centre lies exactly beside the turning centre
  }
}

class PolarHistogramTest : public ::testing::Test {
 protected:
  PolarHistogramTest() : table_(table_of(kOdd, kNear)), cells_(130, kCellUnoccupied) {}

  // Padded rows: what lies in the padding must not count.
  ImageView<std::uint8_t> type() { return {cells_.data(), 11, 10, 13}; }

  std::vector<PolarEntry> table_;
  std::vector<std::uint8_t> cells_;
  PolarHistogram histogram_{};
};

TEST_F(PolarHistogramTest, SumsObstaclesOnly) {
  cells_[11] = kCellObstacle;
  type().at(5, 4) = kCellObstacle;  // 798 to sectors 70..2
  type().at(5, 9) = kCellObstacle;  // 98 to sectors 71..1
  type().at(0, 4) = kCellUnknown;
  histogram_.fill(7);
  ASSERT_EQ(polar_histogram_ref(type(), table_, histogram_), Status::ok);
  PolarHistogram expected{};
  expected[70] = expected[2] = 798;
  expected[71] = expected[0] = expected[1] = 896;
  EXPECT_EQ(histogram_, expected);
}

TEST_F(PolarHistogramTest, TheWindowChangesNothing) {
  const PolarParams p{.active_radius_mm = 420, .enlargement_mm = 100};
  table_ = table_of(kOdd, p);
  std::mt19937 random(3);
  for (std::uint8_t& cell : cells_)
    cell = static_cast<std::uint8_t>(random() % 3);
  PolarHistogram windowed{};
  ASSERT_EQ(polar_histogram_ref(type(), table_, histogram_), Status::ok);
  ASSERT_EQ(polar_histogram_ref(type(), table_, windowed, polar_window(kOdd, p)), Status::ok);
  EXPECT_EQ(histogram_, windowed);
}

TEST_F(PolarHistogramTest, RowsAndColumnsOutsideTheWindowAreSkipped) {
  type().at(5, 4) = kCellObstacle;
  for (const PolarWindow& w : {PolarWindow{5, 10, 0, 11}, {0, 4, 0, 11}, {0, 10, 6, 11}, {0, 10, 0, 5}}) {
    ASSERT_EQ(polar_histogram_ref(type(), table_, histogram_, w), Status::ok);
    EXPECT_EQ(histogram_, PolarHistogram{});
  }
  ASSERT_EQ(polar_histogram_ref(type(), table_, histogram_, {-5, 5, -5, 6}), Status::ok);
  EXPECT_EQ(histogram_[0], 798U);
}

TEST_F(PolarHistogramTest, Refusals) {
  table_.pop_back();
  EXPECT_EQ(polar_histogram_ref(type(), table_, histogram_), Status::size_mismatch);
  EXPECT_EQ(polar_histogram_ref({cells_.data(), -1, 10}, table_, histogram_), Status::bad_argument);
  EXPECT_EQ(polar_histogram_ref({cells_.data(), 2001, 10}, table_, histogram_), Status::bad_argument);
  histogram_.fill(7);
  EXPECT_EQ(polar_histogram_ref({}, {}, histogram_), Status::ok);
  EXPECT_EQ(histogram_, PolarHistogram{});
}

TEST(PolarHistogramSimd, EqualsTheReference) {
  std::mt19937 random(17);
  test::for_each_isa([&](const char* isa) {
    for (const int width : test::awkward_widths()) {
      constexpr int kRows = 6;
      test::PaddedImage<std::uint8_t> type(width, kRows, 3, std::uint8_t{kCellObstacle});
      std::vector<PolarEntry> table(static_cast<std::size_t>(width) * kRows);
      for (PolarEntry& e : table) {
        e = {static_cast<std::uint16_t>(random() % 1001), static_cast<std::uint8_t>(random() % kPolarSectors),
             static_cast<std::uint8_t>(random() % 38)};
      }
      for (const int share : {1, 3, 60}) {
        for (int r = 0; r < kRows; ++r) {
          for (int c = 0; c < width; ++c)
            type.view().at(c, r) =
                static_cast<std::uint8_t>(static_cast<int>(random() % 64) < share ? 0 : 1 + random() % 2);
        }
        for (const PolarWindow& w : {PolarWindow{}, {1, 5, 2, width - 1}, {-3, 90, -2, 900}, {4, 2, 5, 1}}) {
          PolarHistogram expected{};
          PolarHistogram found{};
          found.fill(7);
          ASSERT_EQ(polar_histogram_ref(type.view(), table, expected, w), Status::ok);
          ASSERT_EQ(polar_histogram_simd(type.view(), table, found, w), Status::ok);
          ASSERT_EQ(found, expected) << isa << " width " << width;
        }
      }
    }
  });
}

TEST_F(PolarHistogramTest, SimdRefusesTheSame) {
  EXPECT_EQ(polar_histogram_simd({cells_.data(), -1, 10}, table_, histogram_), Status::bad_argument);
  EXPECT_EQ(polar_histogram_simd({cells_.data(), 2001, 10}, table_, histogram_), Status::bad_argument);
  table_.pop_back();
  EXPECT_EQ(polar_histogram_simd(type(), table_, histogram_), Status::size_mismatch);
}

TEST(PolarHistogramLimits, TheLargestSumFits) {
  const std::size_t cells = std::size_t{kPolarMaxSide} * kPolarMaxSide;
  const std::vector<std::uint8_t> type(cells, kCellObstacle);
  const std::vector<PolarEntry> table(cells, PolarEntry{kPolarMaxWeight, 71, 2});
  PolarHistogram histogram{};
  ASSERT_EQ(polar_histogram_ref({type.data(), kPolarMaxSide, kPolarMaxSide}, table, histogram), Status::ok);
  EXPECT_EQ(histogram[71], 4'000'000'000U);
  PolarHistogram simd{};
  ASSERT_EQ(polar_histogram_simd({type.data(), kPolarMaxSide, kPolarMaxSide}, table, simd), Status::ok);
  EXPECT_EQ(simd, histogram);
  EXPECT_EQ(histogram[0], 4'000'000'000U);
  EXPECT_EQ(histogram[1], 0U);
}

}  // namespace
}  // namespace lakshya

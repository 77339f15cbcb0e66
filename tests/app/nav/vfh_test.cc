#include "app/nav/vfh.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <random>

namespace lakshya {
namespace {

// Sectors first to last, negative ones to the right.
SectorMask span(int first, int last) {
  SectorMask mask{};
  for (int k = first; k <= last; ++k)
    mask[sector_index(k)] = true;
  return mask;
}

SectorMask both(const SectorMask& a, const SectorMask& b) {
  SectorMask mask{};
  for (std::size_t k = 0; k < mask.size(); ++k)
    mask[k] = a[k] || b[k];
  return mask;
}

SectorMask mirrored(const SectorMask& a) {
  SectorMask mask{};
  for (int k = 0; k < kPolarSectors; ++k)
    mask[sector_index(-k)] = a[sector_index(k)];
  return mask;
}

constexpr int kWide = 18;

// Everything that is not free is an obstacle.
std::optional<double> choose_deg(const SectorMask& free, double target_deg, int wide = kWide) {
  SectorMask blocked{};
  for (std::size_t k = 0; k < free.size(); ++k)
    blocked[k] = !free[k];
  const auto chosen = choose_in_valley(find_openings(free, blocked), free, radians(target_deg), wide);
  return chosen ? std::optional(degrees(*chosen)) : std::nullopt;
}

void expect_deg(const SectorMask& free, double target_deg, double direction_deg) {
  const auto chosen = choose_deg(free, target_deg);
  ASSERT_TRUE(chosen.has_value());
  EXPECT_NEAR(*chosen, direction_deg, 1e-9) << "target " << target_deg;
}

TEST(SmoothedHistogram, OneSectorSpreadsAsATriangle) {
  PolarHistogram histogram{};
  histogram[3] = 1100;
  const PolarHistogram smoothed = smoothed_histogram(histogram, 5);
  const PolarHistogram expected = [] {
    PolarHistogram h{};
    h[3] = 600;
    h[2] = h[4] = 500;
    h[1] = h[5] = 400;
    h[0] = h[6] = 300;
    h[71] = h[7] = 200;
    h[70] = h[8] = 100;
    return h;
  }();
  EXPECT_EQ(smoothed, expected);
}

TEST(SmoothedHistogram, NeighboursAddUpAndRoundToNearest) {
  PolarHistogram histogram{};
  histogram[0] = 10;
  histogram[2] = 4;
  // l = 1: (h_{k-1} + 2 h_k + h_{k+1}) / 3.
  const PolarHistogram smoothed = smoothed_histogram(histogram, 1);
  EXPECT_EQ(smoothed[71], 3U);  // 10 / 3
  EXPECT_EQ(smoothed[0], 7U);   // 20 / 3
  EXPECT_EQ(smoothed[1], 5U);   // 14 / 3
  EXPECT_EQ(smoothed[2], 3U);   // 8 / 3
  EXPECT_EQ(smoothed[3], 1U);   // 4 / 3
  EXPECT_EQ(smoothed[4], 0U);
  EXPECT_EQ(smoothed_histogram(histogram, 0), histogram);
}

TEST(SmoothedHistogram, EvenSectorsGrowAndSaturate) {
  PolarHistogram histogram{};
  histogram.fill(11);
  PolarHistogram expected{};
  expected.fill(36);
  EXPECT_EQ(smoothed_histogram(histogram, 5), expected);
  histogram.fill(std::numeric_limits<std::uint32_t>::max());
  EXPECT_EQ(smoothed_histogram(histogram, 5), histogram);
  EXPECT_EQ(smoothed_histogram(histogram, kMaxSmoothing), histogram);
}

TEST(Valley, ANarrowOneIsTakenInItsMiddle) {
  const SectorMask free = span(4, 10);
  for (const double target : {-60.0, 0.0, 20.0, 35.0, 50.0, 120.0})
    expect_deg(free, target, 35);
  expect_deg(span(4, 4), 0, 20);
  expect_deg(span(-9, 9), 30, 0);  // 19 sectors span s_max = 18: k_f = k_n + 18 is the other border
}

TEST(Valley, AWideOneIsTakenHalfOfSMaxFromItsNearBorder) {
  const SectorMask free = span(2, 32);  // 10 to 160 deg
  expect_deg(free, -20, 10 + 45);       // k_n = 2, k_f = 20: sector 11
  expect_deg(free, 20, 10 + 45);
  expect_deg(free, 170, 160 - 45);
  expect_deg(free, -170, 160 - 45);  // the far end is the nearer one around the back
}

TEST(Valley, TheTargetItselfWhereThereIsRoomOnBothSides) {
  const SectorMask free = span(-30, 30);
  for (const double target : {-105.0, -33.3, 0.0, 0.1, 77.0, 105.0})
    expect_deg(free, target, target);
  expect_deg(free, 105.5, 105);
  SectorMask all{};
  all.fill(true);
  for (const double target : {-179.0, 3.0, 180.0})
    EXPECT_NEAR(std::remainder(*choose_deg(all, target) - target, 360), 0, 1e-9);
}

TEST(Valley, TheNearestToTheTargetIsSelected) {
  const SectorMask free = both(span(-12, -6), span(4, 40));
  expect_deg(free, -10, -45);  // its edge at -27.5 deg is 17.5 deg away, the other's at 17.5 is 27.5 away
  expect_deg(free, 0, 20 + 45);
  expect_deg(free, 180, 200 - 45);  // wide, up to 200 deg: the target is inside, too near its left border
}

TEST(Valley, WithoutAValleyThereIsNoDirection) {
  EXPECT_EQ(choose_deg({}, 0), std::nullopt);
}

TEST(Valley, MirroredValleysGiveMirroredDirections) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(-180, 180);
  for (int world = 0; world < 2000; ++world) {
    SectorMask free{};
    bool now = false;
    for (std::size_t k = 0; k < free.size(); ++k) {
      if (random() % 7 == 0) now = !now;
      free[k] = now;
    }
    const double target = angle(random);
    const int wide = static_cast<int>(random() % 25) + 1;
    const auto a = choose_deg(free, target, wide);
    const auto b = choose_deg(mirrored(free), -target, wide);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    ASSERT_NEAR(std::remainder(*a + *b, 360), 0, 1e-9) << world;
  }
}

TEST(Valley, EquallyNearTheLeftOneIsTaken) {
  expect_deg(both(span(-10, -6), span(6, 10)), 0, 40);
}

// Free from -45 to 45 deg, nothing seen beyond: nothing to keep away from.
TEST(Valley, TheBorderOfTheViewIsNoObstacle) {
  const SectorMask free = span(-9, 9);
  const Openings valleys = find_openings(free, {});
  const auto choose = [&](double target_deg) {
    return degrees(*choose_in_valley(valleys, free, radians(target_deg), kWide));
  };
  EXPECT_NEAR(choose(30), 30, 1e-9);
  EXPECT_NEAR(choose(-46), -46, 1e-9);  // within the border's sector
  EXPECT_NEAR(choose(80), 45, 1e-9);
  // An obstacle from 10 deg to the left: as far from it as the valley is narrow, half of its width.
  const Openings one_sided = find_openings(span(-9, 1), span(2, 9));
  EXPECT_NEAR(degrees(*choose_in_valley(one_sided, span(-9, 1), 0, kWide)), -20, 1e-9);
  EXPECT_NEAR(degrees(*choose_in_valley(one_sided, span(-9, 1), radians(-40), kWide)), -40, 1e-9);
}

TEST(DensitySpeed, FallsInProportionToTheDensityAhead) {
  EXPECT_EQ(density_speed(0, 1000, 7), 7);
  EXPECT_NEAR(density_speed(250, 1000, 7), 5.25, 1e-12);
  EXPECT_EQ(density_speed(1000, 1000, 7), 0);
  EXPECT_EQ(density_speed(4'000'000'000U, 1000, 7), 0);
}

}  // namespace
}  // namespace lakshya

#include "kernels/ground/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "tests/support/each_isa.h"
#include "tests/support/test_image.h"
#include "tests/support/test_prune_model.h"

namespace lakshya {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr std::int64_t kPixels = std::int64_t{kWidth} * kHeight;

PruneGeometry camera() {
  PruneGeometry g;
  g.focal_px = 320;
  g.baseline_m = 0.125;
  g.center_u = 160;
  g.center_v = 120;
  g.height_m = 0.5;
  return g;
}

using Model = test::TestPruneModel;

// Row v of some image.
void add_row(const PruneModel& mount, int v, const std::vector<std::int16_t>& row, GroundHistogram& h) {
  const ImageView<const std::int16_t> image(row.data(), static_cast<int>(row.size()), v + 1, 0);
  ASSERT_EQ(ground_residuals_ref(mount, image, {v, v + 1}, h), Status::ok);
}

GroundHistogram residuals(const PruneModel& mount, const std::vector<std::vector<std::int16_t>>& image) {
  GroundHistogram h{};
  for (std::size_t v = 0; v < image.size(); ++v)
    add_row(mount, static_cast<int>(v), image[v], h);
  return h;
}

// What a camera of another pitch sees of an empty floor, with noise, and a wall of the given disparity above it.
std::vector<std::vector<std::int16_t>> floor_and_wall(double pitch, double wall, double noise) {
  PruneGeometry g = camera();
  g.pitch = pitch;
  const Model truth(g);
  std::mt19937 random(51);
  std::normal_distribution<double> scatter(0, noise);
  std::vector<std::vector<std::int16_t>> image(kHeight, std::vector<std::int16_t>(kWidth, -3));
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const double floor = static_cast<double>(truth.prune.floor.at(u, v)) / 65536;
      const double d = std::max(floor, wall) + scatter(random);
      image[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)] =
          static_cast<std::int16_t>(std::max(std::lround(d * 16), 0L));
    }
  }
  return image;
}

TEST(Ground, ResidualsByHand) {
  const Model m(camera());
  GroundHistogram h{};
  // v = 200: d_f = 20 px. Not counted: no disparity, too far, a residual out of reach.
  add_row(m.prune, 200, std::vector<std::int16_t>{20 * 16, 20 * 16 + 3, 18 * 16, -4, 0, 16, 50 * 16}, h);
  EXPECT_EQ(h[kGroundReach], 1U);
  EXPECT_EQ(h[kGroundReach + 3], 1U);
  EXPECT_EQ(h[kGroundReach - 32], 1U);
  std::uint32_t total = 0;
  for (const std::uint32_t n : h)
    total += n;
  EXPECT_EQ(total, 3U);
  // Above the horizon there is no floor.
  add_row(m.prune, 100, std::vector<std::int16_t>{5 * 16}, h);
  EXPECT_EQ(h[kGroundReach], 1U);
}

TEST(Ground, FindsThePitchErrorOfAFloorBeforeAWall) {
  const Model mount(camera());
  for (const double degrees : {-1.2, -0.5, 0.0, 0.4, 1.0}) {
    const double pitch = degrees * 3.14159265 / 180;
    const GroundHistogram h = residuals(mount.prune, floor_and_wall(pitch, 8, 0.2));
    const double expected16 = 320 * 0.125 / 0.5 * pitch * 16;
    EXPECT_NEAR(ground_offset(h, 64, kPixels), expected16, 1.5) << degrees;
  }
}

TEST(Ground, StaysWithinItsRange) {
  const Model mount(camera());
  const GroundHistogram h = residuals(mount.prune, floor_and_wall(0.02, 8, 0.2));  // 25.6 sixteenths
  EXPECT_NEAR(ground_offset(h, 64, kPixels), 26, 1.5);
  EXPECT_LE(std::abs(ground_offset(h, 10, kPixels)), 10);
  EXPECT_EQ(ground_offset(h, 0, kPixels), 0);
}

TEST(Ground, AWallAloneMovesNothing) {
  const Model mount(camera());
  const GroundHistogram h = residuals(mount.prune, floor_and_wall(0, 31, 0.1));
  EXPECT_EQ(ground_offset(h, 64, kPixels), 0);
}

TEST(Ground, TooFewPixelsMoveNothing) {
  GroundHistogram h{};
  h[kGroundReach + 20] = 99;
  EXPECT_EQ(ground_offset(h, 64, 5000), 0);
  EXPECT_EQ(ground_offset(h, 64, 4950), 20);  // 2 %
  EXPECT_EQ(ground_offset(GroundHistogram{}, 64, 0), 0);
}

TEST(Ground, TheMeanOfTheWindowRoundsHalfUp) {
  GroundHistogram h{};
  h[kGroundReach + 4] = 100;
  h[kGroundReach + 5] = 100;
  EXPECT_EQ(ground_offset(h, 64, 200), 5);
  GroundHistogram mirrored{};
  mirrored[kGroundReach - 4] = 100;
  mirrored[kGroundReach - 5] = 100;
  EXPECT_EQ(ground_offset(mirrored, 64, 200), -4);
}

TEST(Ground, TheScatterOfTheFloorIsThatOfItsNoise) {
  const Model mount(camera());
  for (const double noise : {0.25, 0.5, 0.8, 1.2}) {
    const GroundHistogram h = residuals(mount.prune, floor_and_wall(0, 8, noise));
    EXPECT_NEAR(ground_scatter(h, 0, kPixels), 16 * noise, 2 + noise) << noise;
  }
  const GroundHistogram sharp = residuals(mount.prune, floor_and_wall(0, 8, 0));
  EXPECT_LE(ground_scatter(sharp, 0, kPixels), 2);
}

TEST(Ground, WhatStandsOrLiesLowerIsNoScatter) {
  const Model mount(camera());
  std::vector<std::vector<std::int16_t>> image = floor_and_wall(0, 8, 0.3);
  const std::int32_t alone = ground_scatter(residuals(mount.prune, image), 0, kPixels);
  for (std::size_t v = 180; v < kHeight; ++v) {  // a box on a third of the width, a step down on another
    for (std::size_t u = 0; u < kWidth / 3; ++u)
      image[v][u] = static_cast<std::int16_t>(image[v][u] + 40);
    for (std::size_t u = 2 * kWidth / 3; u < kWidth; ++u)
      image[v][u] = static_cast<std::int16_t>(image[v][u] - 2 * static_cast<int>(v - 170));
  }
  EXPECT_NEAR(ground_scatter(residuals(mount.prune, image), 0, kPixels), alone, 1);
}

TEST(Ground, NoPileHasNoScatterAndNoneIsWiderThanTheMost) {
  EXPECT_EQ(ground_scatter(GroundHistogram{}, 0, 0), 0);
  GroundHistogram h{};
  h[kGroundReach + 5] = 99;
  EXPECT_EQ(ground_scatter(h, 5, 5000), 0);
  h.fill(100);
  EXPECT_EQ(ground_scatter(h, 0, 5000), kGroundScatterMost);
  EXPECT_EQ(ground_scatter(h, kGroundReach, 5000), kGroundWindow);  // the histogram ends there
}

TEST(WidenFloor, MovesOnlyTheBoundsOfTheNoise) {
  const Model model(camera());
  const PruneModel wide = widen_floor(model.prune, 3 << 15);
  EXPECT_EQ(wide.drop_absolute.at(7, 200), model.prune.drop_absolute.at(7, 200) - (3 << 15));
  EXPECT_EQ(wide.floor_absolute.at(7, 200), model.prune.floor_absolute.at(7, 200) + (3 << 15));
  EXPECT_EQ(wide.drop_relative.at(7, 200), model.prune.drop_relative.at(7, 200));
  EXPECT_EQ(wide.floor.at(7, 200), model.prune.floor.at(7, 200));
  EXPECT_EQ(wide.ceiling.at(7, 200), model.prune.ceiling.at(7, 200));
  // d_f = 20 px, sigma 0.25 px, k 3: 22 px stand out of the floor, but not where it scatters.
  EXPECT_EQ(classify_pixel(model.prune, 160, 200, 22 * 16 + 8), PixelClass::obstacle);
  EXPECT_EQ(classify_pixel(wide, 160, 200, 22 * 16 + 8), PixelClass::floor);
}

TEST(ShiftFloor, EqualsAModelOfThatPitchForSmallAngles) {
  PruneGeometry g = camera();
  const Model level(g);
  g.pitch = 0.01;
  const Model pitched(g);
  const PruneModel shifted = shift_floor(level.prune, static_cast<std::int64_t>(320 * 0.125 / 0.5 * 0.01 * 65536));
  for (int v = 0; v < kHeight; v += 7) {
    for (const auto bound : {&PruneModel::floor, &PruneModel::drop_relative, &PruneModel::drop_absolute,
                             &PruneModel::floor_relative, &PruneModel::floor_absolute, &PruneModel::ceiling}) {
      const double a = static_cast<double>((shifted.*bound).at(50, v)) / 65536;
      const double b = static_cast<double>((pitched.prune.*bound).at(50, v)) / 65536;
      ASSERT_NEAR(a, b, 0.01) << v;
    }
  }
}

// Cameras of every kind: level and rolled, floors that leave the search range, limits out of 16 bits.
PruneGeometry any_camera(std::mt19937& random, int width) {
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  PruneGeometry g = camera();
  g.focal_px = between(50, 1200);
  g.baseline_m = between(0.02, 1.5);
  g.center_u = between(0, width);
  g.center_v = between(-20, 40);
  g.height_m = between(0.05, 2);
  g.pitch = between(-1, 1);
  if (random() % 2 == 0) g.roll = between(-1, 1);
  g.max_depth_m = between(0.1, 60);
  g.max_disparity_px = between(16, 2040);
  return g;
}

TEST(GroundSimd, EqualsTheReference) {
  std::mt19937 random(7);
  test::for_each_isa([&](const char* isa) {
    std::uint64_t counted = 0;
    for (int width : test::awkward_widths()) {
      if (width == 203) width = 611;  // more than a piece
      for (int trial = 0; trial < 12; ++trial) {
        constexpr int kRows = 9;
        const Model m(any_camera(random, width));
        test::PaddedImage<std::int16_t> image(width, kRows);
        test::fill_random(image.view(), random, -8, trial % 3 == 0 ? 32767 : 1500);
        for (int v = 0; v < kRows && trial % 2 == 0; ++v) {
          for (int u = 0; u < width; ++u) {  // near the floor
            const std::int64_t d =
                (m.prune.floor.at(u, v) >> kDisparityToQ16) + static_cast<int>(random() % 600) - 300;
            image.view().at(u, v) = static_cast<std::int16_t>(std::clamp<std::int64_t>(d, -8, 32767));
          }
        }
        GroundHistogram expected{};
        GroundHistogram found{};
        ASSERT_EQ(ground_residuals_ref(m.prune, image.view(), {0, kRows}, expected), Status::ok);
        for (const Rows rows : {Rows{0, 2}, Rows{2, 2}, Rows{2, kRows}})
          ASSERT_EQ(ground_residuals_simd(m.prune, image.view(), rows, found), Status::ok);
        ASSERT_EQ(found, expected) << isa << " width " << width << " trial " << trial;
        counted += std::accumulate(found.begin(), found.end(), std::uint64_t{0});
      }
    }
    EXPECT_GT(counted, 3000U);
  });
}

TEST(GroundSimd, ARowThatDoesNotFitIsTheReferences) {
  Model m(camera());
  m.prune.floor.per_u = std::int64_t{1} << 33;  // 2 px in column 1 of Q16 is far out of 32 bits in column 64
  m.prune.floor.constant = 20 << 16;
  m.prune.floor.per_v = 0;
  const test::PaddedImage<std::int16_t> image(70, 2, 3, std::int16_t{20 * 16});
  GroundHistogram expected{};
  GroundHistogram found{};
  ASSERT_EQ(ground_residuals_ref(m.prune, image.view(), {0, 2}, expected), Status::ok);
  ASSERT_EQ(ground_residuals_simd(m.prune, image.view(), {0, 2}, found), Status::ok);
  EXPECT_EQ(found, expected);
}

TEST(GroundSimd, RefusesRowsOutside) {
  const Model m(camera());
  const test::PaddedImage<std::int16_t> image(4, 3);
  GroundHistogram h{};
  EXPECT_EQ(ground_residuals_simd(m.prune, image.view(), {0, 4}, h), Status::bad_argument);
  EXPECT_EQ(ground_residuals_ref(m.prune, image.view(), {0, 4}, h), Status::bad_argument);
}

}  // namespace
}  // namespace lakshya

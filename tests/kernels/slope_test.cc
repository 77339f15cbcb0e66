#include "kernels/slope/slope.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/test_image.h"
#include "tests/support/test_prune_model.h"

namespace lakshya {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr double kDegree = std::numbers::pi / 180;

PruneGeometry camera() {
  PruneGeometry g;
  g.focal_px = 190;
  g.baseline_m = 0.12;
  g.center_u = 160;
  g.center_v = 120;
  g.height_m = 1.05;
  g.pitch = 15 * kDegree;
  return g;
}

using Model = test::TestPruneModel;
using Disparity = test::PaddedImage<std::int16_t>;
// Ground from place to place, in a straight line each: distance ahead and height, m. Two in a row at one distance: a step.
using Profile = std::vector<std::pair<double, double>>;

// Where a ray that leaves the camera at height `from` and falls by `fall` per metre meets the profile, m ahead.
double meets(const Profile& profile, double from, double fall) {
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const auto [x0, z0] = profile[i - 1];
    const auto [x1, z1] = profile[i];
    const double above0 = from - fall * x0 - z0;
    const double above1 = from - fall * x1 - z1;
    if (above0 >= 0 && above1 <= 0) return x0 + (x1 - x0) * above0 / std::max(above0 - above1, 1e-12);
  }
  return 0;
}

// Of ground that is the same for the whole width.
Disparity disparity_of(const Profile& profile, double noise_px = 0.2) {
  const PruneGeometry g = camera();
  std::mt19937 random(7);
  std::normal_distribution<double> scatter(0, noise_px);
  Disparity image(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    const double angle = g.pitch + std::atan((v - g.center_v) / g.focal_px);
    const double x = angle > 0 ? meets(profile, g.height_m, std::tan(angle)) : 0;
    for (int u = 0; u < kWidth; ++u) {
      // Along the optical axis.
      const double depth = x * (std::cos(g.pitch) + std::tan(angle) * std::sin(g.pitch));
      const double d = x > 0 ? g.focal_px * g.baseline_m / depth + scatter(random) : -1;
      image.view().at(u, v) = static_cast<std::int16_t>(d > 0 ? std::lround(16 * d) : long{kNotUnique});
    }
  }
  return image;
}

Slopes slopes_of(const Profile& profile) {
  const Model m(camera());
  Disparity image = disparity_of(profile);
  Slopes slopes{};
  EXPECT_EQ(find_slopes(m.prune, {}, image.view(), slopes), Status::ok);
  return slopes;
}

bool is_found(const Profile& profile) {
  const Slopes slopes = slopes_of(profile);
  return std::all_of(slopes.begin(), slopes.end(), std::mem_fn(&SlopeStrip::found));
}

bool any_found(const Profile& profile) {
  const Slopes slopes = slopes_of(profile);
  return std::any_of(slopes.begin(), slopes.end(), std::mem_fn(&SlopeStrip::found));
}

// Pixels between two distances on the level floor that are not floor once the image is levelled, in percent.
double not_floor(const Profile& profile, double from, double to) {
  const Model m(camera());
  Disparity image = disparity_of(profile);
  Disparity levelled(kWidth, kHeight);
  const Slopes slopes = slopes_of(profile);
  EXPECT_EQ(level_strip(m.prune, {}, slopes, image.view(), 4, levelled.view()), Status::ok);
  int all = 0;
  int others = 0;
  for (int v = 0; v < kHeight; ++v) {
    const std::int16_t d = image.view().at(144, v);
    if (d <= 0) continue;
    const double forward = reproject_pixel(m.prune, 144, v, d).forward_mm / 1000.0;
    if (forward < from || forward > to) continue;
    for (int u = 128; u < 160; ++u) {
      ++all;
      others += classify_pixel(m.prune, u, v, levelled.view().at(u, v)) != PixelClass::floor;
    }
  }
  EXPECT_GT(all, 0);
  return 100.0 * others / std::max(all, 1);
}

double rise(double degrees, double way) {
  return std::tan(degrees * kDegree) * way;
}

TEST(Slope, LevelFloorIsNone) {
  EXPECT_FALSE(any_found({{0, 0}, {30, 0}}));
}

TEST(Slope, ARampUpIsFloor) {
  for (const double degrees : {4.0, 8.0}) {
    const Profile ramp{{0, 0}, {1.5, 0}, {3, rise(degrees, 1.5)}, {30, rise(degrees, 1.5)}};
    EXPECT_TRUE(is_found(ramp)) << degrees;
    EXPECT_LT(not_floor(ramp, 1.5, 2.9), 5) << degrees;
  }
}

TEST(Slope, ARampDownIsFloor) {
  for (const double degrees : {4.0, 8.0}) {
    const Profile ramp{{0, 0}, {1.2, 0}, {3, -rise(degrees, 1.8)}, {30, -rise(degrees, 1.8)}};
    EXPECT_TRUE(is_found(ramp)) << degrees;
    EXPECT_LT(not_floor(ramp, 1.2, 2.8), 5) << degrees;
  }
}

// What the image shows of things that are not driven must stay as it is, where the vehicle could still stop for it.
TEST(Slope, AKerbAPotholeAndStairsStay) {
  const auto stairs = [] {
    Profile p{{0, 0}, {1.6, 0}};
    for (int k = 0; k < 5; ++k) {
      p.emplace_back(1.6 + 0.3 * k, -0.16 * (k + 1));
      p.emplace_back(1.6 + 0.3 * (k + 1), -0.16 * (k + 1));
    }
    p.emplace_back(30, -0.8);
    return p;
  };
  const std::vector<std::pair<const char*, Profile>> things{
      {"kerb", {{0, 0}, {1.6, 0}, {1.6, 0.12}, {30, 0.12}}},
      {"pothole", {{0, 0}, {1.5, 0}, {1.5, -0.2}, {2.2, -0.2}, {2.2, 0}, {30, 0}}},
      {"stairs", stairs()},
      {"wall", {{0, 0}, {1.6, 0}, {1.6, 1}, {30, 1}}},
      {"low box", {{0, 0}, {1.6, 0}, {1.6, 0.15}, {1.9, 0.15}, {1.9, 0}, {30, 0}}},
      {"steep bank", {{0, 0}, {1.5, 0}, {2.5, rise(25, 1)}, {30, rise(25, 1)}}}};
  for (const auto& [name, profile] : things) {
    const Model m(camera());
    Disparity image = disparity_of(profile);
    Disparity levelled(kWidth, kHeight);
    const Slopes slopes = slopes_of(profile);
    int others = 0;
    int stay = 0;
    for (int strip = 0; strip < kSlopeStrips; ++strip)
      ASSERT_EQ(level_strip(m.prune, {}, slopes, image.view(), strip, levelled.view()), Status::ok);
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const std::int16_t d = image.view().at(u, v);
        if (d <= 0) continue;
        const PixelClass seen = classify_pixel(m.prune, u, v, d);
        if (seen == PixelClass::floor || reproject_pixel(m.prune, u, v, d).forward_mm > 2000) continue;
        ++others;
        stay += levelled.view().at(u, v) == d;
      }
    }
    EXPECT_GT(others, 500) << name;
    EXPECT_GT(stay, others * (name == std::string_view("steep bank") ? 80 : 95) / 100)
        << name;  // its foot is no steeper
  }
}

TEST(Slope, AKerbBeforeWhichTheVehicleStandsIsNoSlope) {
  EXPECT_FALSE(any_found({{0, 0}, {0.9, 0}, {0.9, 0.12}, {30, 0.12}}));
  EXPECT_FALSE(any_found({{0, 0}, {0.9, 0}, {0.9, -0.16}, {30, -0.16}}));
}

// On a short ramp nothing is seen but the platform behind it; the image before has shown the ramp.
TEST(Slope, WhatWasFollowedNeedNotComeFromTheFloor) {
  const Model m(camera());
  const Profile platform{{0, 0}, {0.9, 0}, {0.9, 0.12}, {30, 0.12}};
  Disparity image = disparity_of(platform);
  Slopes slopes = slopes_of({{0, 0}, {1.2, 0}, {2, 0.12}, {30, 0.12}});
  ASSERT_EQ(find_slopes(m.prune, {}, image.view(), slopes), Status::ok);
  EXPECT_TRUE(slopes[4].found());
  ASSERT_EQ(find_slopes(m.prune, {.steepest_percent = 0}, image.view(), slopes), Status::ok);
  ASSERT_EQ(find_slopes(m.prune, {}, image.view(), slopes), Status::ok);
  EXPECT_FALSE(slopes[4].found());
}

TEST(Slope, ARampThatBeginsBeforeTheImageDoes) {
  EXPECT_TRUE(is_found({{0, 0}, {0.4, 0}, {3, rise(8, 2.6)}, {30, rise(8, 2.6)}}));
  EXPECT_TRUE(is_found({{0, 0}, {0.4, 0}, {3, -rise(8, 2.6)}, {30, -rise(8, 2.6)}}));
}

TEST(Slope, ALongRampLeavesNothingBehindItsMeasuredPart) {
  const Profile ramp{{0, 0}, {2, 0}, {12, rise(8, 10)}, {30, rise(8, 10)}};
  EXPECT_TRUE(slopes_of(ramp)[4].goes_on);
  const Model m(camera());
  Disparity image = disparity_of(ramp);
  Disparity levelled(kWidth, kHeight);
  ASSERT_EQ(level_strip(m.prune, {}, slopes_of(ramp), image.view(), 4, levelled.view()), Status::ok);
  int obstacles = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 128; u < 160; ++u) {
      const std::int16_t d = levelled.view().at(u, v);
      obstacles += d > 0 && classify_pixel(m.prune, u, v, d) == PixelClass::obstacle;
    }
  }
  EXPECT_LT(obstacles, 20);
}

// Pixels of a strip that show ground 0.1 m high or more and no farther than 2 m, and those of them that are floor once the image is
// levelled.
std::pair<int, int> raised(Disparity& image, const Slopes& slopes, int strip) {
  const Model m(camera());
  Disparity levelled(kWidth, kHeight);
  EXPECT_EQ(level_strip(m.prune, {}, slopes, image.view(), strip, levelled.view()), Status::ok);
  int all = 0;
  int floor = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = kWidth * strip / kSlopeStrips; u < kWidth * (strip + 1) / kSlopeStrips; ++u) {
      const std::int16_t d = image.view().at(u, v);
      if (d <= 0) continue;
      const ObstaclePoint p = reproject_pixel(m.prune, u, v, d);
      if (p.height_mm < 100 || p.forward_mm > 2000) continue;
      ++all;
      floor += classify_pixel(m.prune, u, v, levelled.view().at(u, v)) == PixelClass::floor;
    }
  }
  return {all, floor};
}

// A ramp covers the left half of the image, level floor the right one: the vehicle would drive down over its side.
TEST(Slope, TheSideOfARampStays) {
  const Model m(camera());
  Disparity image = disparity_of({{0, 0}, {0.8, 0}, {2, rise(8, 1.2)}, {30, rise(8, 1.2)}});
  Disparity floor = disparity_of({{0, 0}, {30, 0}});
  for (int v = 0; v < kHeight; ++v) {
    for (int u = kWidth / 2; u < kWidth; ++u)
      image.view().at(u, v) = floor.view().at(u, v);
  }
  Slopes slopes{};
  ASSERT_EQ(find_slopes(m.prune, {}, image.view(), slopes), Status::ok);
  ASSERT_TRUE(slopes[4].found());
  const auto [beside, beside_floor] = raised(image, slopes, 4);
  ASSERT_GT(beside, 200);
  EXPECT_LT(beside_floor, beside / 4);
  const auto [inside, inside_floor] = raised(image, slopes, 2);
  EXPECT_GT(inside_floor, inside * 9 / 10);
  // It is low and would be taken for something to drive over, were it not a drop-off.
  Disparity levelled(kWidth, kHeight);
  ASSERT_EQ(level_strip(m.prune, {}, slopes, image.view(), 4, levelled.view()), Status::ok);
  int drop = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = kWidth * 4 / 10; u < kWidth / 2; ++u) {
      const std::int16_t d = levelled.view().at(u, v);
      drop += d > 0 && classify_pixel(m.prune, u, v, d) == PixelClass::drop_off;
    }
  }
  EXPECT_GT(drop, beside / 2);
}

// From a platform the image shows lower ground beside it; only where there is nothing else it may be the end of the ramp.
TEST(Slope, LowerGroundBesideAPlatformIsNotFollowed) {
  const Model m(camera());
  Disparity image = disparity_of({{0, 0}, {30, 0}});
  Disparity lower = disparity_of({{0, -0.12}, {30, -0.12}});
  Slopes slopes = slopes_of({{0, 0}, {1.2, 0}, {2, -0.12}, {30, -0.12}});
  ASSERT_EQ(find_slopes(m.prune, {}, lower.view(), slopes), Status::ok);
  EXPECT_TRUE(slopes[7].found());
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth / 2; ++u)
      lower.view().at(u, v) = image.view().at(u, v);
  }
  ASSERT_EQ(find_slopes(m.prune, {}, lower.view(), slopes), Status::ok);
  EXPECT_FALSE(slopes[7].found());
}

// A platform that ends 0.13 m above the floor, as seen from its ramp's foot.
TEST(Slope, TheFarEndOfAPlatformStays) {
  const Model m(camera());
  Disparity image = disparity_of({{0, 0}, {0.4, 0}, {1.4, 0.13}, {1.8, 0.13}, {1.8, 0}, {30, 0}});
  Slopes slopes{};
  ASSERT_EQ(find_slopes(m.prune, {}, image.view(), slopes), Status::ok);
  ASSERT_TRUE(slopes[4].found());
  int left = 0;
  int edge = 0;
  for (int v = 0; v < kHeight; ++v) {
    const std::int16_t d = image.view().at(144, v);
    if (d <= 0) continue;
    const ObstaclePoint p = reproject_pixel(m.prune, 144, v, d);
    if (p.height_mm < 100 || p.forward_mm < 1650 || p.forward_mm > 1780) continue;
    ++edge;
    const int bin = v * kSlopeBins / kHeight;
    left += bin < slopes[4].first || slopes[4].edge[static_cast<std::size_t>(bin)] ? 1 : 0;
  }
  ASSERT_GT(edge, 3);
  EXPECT_GE(left, edge * 3 / 4);
}

TEST(Slope, AThingOnARampStays) {
  const Profile ramp{{0, 0}, {1.5, 0}, {3.5, rise(8, 2)}, {30, rise(8, 2)}};
  const Model m(camera());
  Disparity image = disparity_of(ramp);
  // A post in the middle strip, 2.2 m ahead of the camera.
  const auto post = static_cast<std::int16_t>(std::lround(16 * camera().focal_px * camera().baseline_m / 2.2));
  int rows = 0;
  for (int v = 60; v < kHeight; ++v) {
    if (image.view().at(144, v) > post) break;
    for (int u = 142; u < 147; ++u)
      image.view().at(u, v) = post;
    ++rows;
  }
  Slopes slopes{};
  Disparity levelled(kWidth, kHeight);
  ASSERT_EQ(find_slopes(m.prune, {}, image.view(), slopes), Status::ok);
  EXPECT_TRUE(slopes[4].found());
  ASSERT_EQ(level_strip(m.prune, {}, slopes, image.view(), 4, levelled.view()), Status::ok);
  int stay = 0;
  for (int v = 60; v < 60 + rows; ++v)
    stay += levelled.view().at(144, v) == post;
  EXPECT_GT(stay, rows * 4 / 5);
}

TEST(Slope, NoneIsLookedForWhereTheSteepestIsZero) {
  const Model m(camera());
  Disparity image = disparity_of({{0, 0}, {1.5, 0}, {3, rise(8, 1.5)}, {30, rise(8, 1.5)}});
  Slopes slopes{};
  EXPECT_EQ(find_slopes(m.prune, {.steepest_percent = 0}, image.view(), slopes), Status::ok);
  for (const SlopeStrip& slope : slopes)
    EXPECT_FALSE(slope.found());
}

TEST(Slope, RefusesWhatDoesNotFit) {
  const Model m(camera());
  Slopes slopes{};
  Disparity narrow(kSlopeStrips - 1, kHeight);
  Disparity low(kWidth, kSlopeBins - 1);
  Disparity image(kWidth, kHeight);
  Disparity other(kWidth, kHeight - 1);
  EXPECT_EQ(find_slopes(m.prune, {}, narrow.view(), slopes), Status::size_mismatch);
  EXPECT_EQ(find_slopes(m.prune, {}, low.view(), slopes), Status::size_mismatch);
  EXPECT_EQ(level_strip(m.prune, {}, slopes, image.view(), 0, other.view()), Status::size_mismatch);
  EXPECT_EQ(level_strip(m.prune, {}, slopes, image.view(), kSlopeStrips, image.view()), Status::bad_argument);
  EXPECT_EQ(level_strip(m.prune, {}, slopes, image.view(), -1, image.view()), Status::bad_argument);
}

}  // namespace
}  // namespace lakshya

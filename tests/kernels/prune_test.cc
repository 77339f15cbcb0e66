#include "kernels/prune/prune.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/test_prune_model.h"

namespace lakshya {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// f = 320 px, B = 0.125 m, H = 0.5 m, level: d_f = 0.25 (v - 240) px (exact in Q16), z = 40 m px / d.
PruneGeometry level_camera() {
  PruneGeometry g;
  g.focal_px = 320;
  g.baseline_m = 0.125;
  g.center_u = 320;
  g.center_v = 240;
  g.height_m = 0.5;
  g.max_depth_m = 10;
  g.clearance_m = 1.2;
  g.floor_tolerance_m = 0.05;
  g.disparity_sigma_px = 0;
  g.pitch_sigma = 0;
  g.max_disparity_px = 64;
  return g;
}

using Model = test::TestPruneModel;

PixelClass classify(const PruneGeometry& g, int u, int v, double d) {
  const Model m(g);
  return classify_pixel(m.prune, u, v, static_cast<std::int16_t>(std::lround(d * 16)));
}

TEST(Prune, FarDisparitiesAreDropped) {
  const PruneGeometry g = level_camera();
  EXPECT_EQ(classify(g, 320, 240, 0), PixelClass::too_far);
  EXPECT_EQ(classify(g, 320, 240, 3.9375), PixelClass::too_far);
  EXPECT_EQ(classify(g, 320, 240, 4), PixelClass::obstacle);  // z = 10 m exactly is inside
}

TEST(Prune, FloorWithinItsTolerance) {
  const PruneGeometry g = level_camera();
  // v = 320: d_f = 20 px, z = 2 m. tau 0.05: floor up to 20 * 0.5/0.45 = 22.2 px, drop-off below 20 * 0.5/0.55
  // = 18.18.
  EXPECT_EQ(classify(g, 100, 320, 20), PixelClass::floor);
  EXPECT_EQ(classify(g, 100, 320, 22.1875), PixelClass::floor);
  EXPECT_EQ(classify(g, 100, 320, 22.25), PixelClass::obstacle);
  EXPECT_EQ(classify(g, 100, 320, 18.1875), PixelClass::floor);
  EXPECT_EQ(classify(g, 100, 320, 18.125), PixelClass::drop_off);
}

TEST(Prune, DisparityNoiseWidensTheFloor) {
  PruneGeometry g = level_camera();
  g.floor_tolerance_m = 0.001;
  g.disparity_sigma_px = 0.5;
  g.sigma_factor = 2;  // +-1 px
  EXPECT_EQ(classify(g, 320, 320, 21), PixelClass::floor);
  EXPECT_EQ(classify(g, 320, 320, 21.0625), PixelClass::obstacle);
  EXPECT_EQ(classify(g, 320, 320, 19), PixelClass::floor);
  EXPECT_EQ(classify(g, 320, 320, 18.9375), PixelClass::drop_off);
  g.disparity_sigma_px = 0.3;
  g.pitch_sigma = 0.005;  // f B sigma / H = 0.4 px; hypot = 0.5
  EXPECT_EQ(classify(g, 320, 320, 21), PixelClass::floor);
  EXPECT_EQ(classify(g, 320, 320, 21.0625), PixelClass::obstacle);
}

TEST(Prune, CeilingAboveTheCamera) {
  const PruneGeometry g = level_camera();
  // C - H = 0.7: at v = 160, d_f = -20, ceiling below d = 20 * 0.5/0.7 = 14.29 px.
  EXPECT_EQ(classify(g, 320, 160, 14.25), PixelClass::ceiling);
  EXPECT_EQ(classify(g, 320, 160, 14.3125), PixelClass::obstacle);
  EXPECT_EQ(classify(g, 320, 240, 5), PixelClass::obstacle);
}

TEST(Prune, CeilingAtTheCamera) {
  PruneGeometry g = level_camera();
  g.clearance_m = 0.5;
  EXPECT_EQ(classify(g, 320, 239, 5), PixelClass::ceiling);
  EXPECT_EQ(classify(g, 320, 240, 5), PixelClass::obstacle);
  EXPECT_EQ(classify(g, 320, 241, 5), PixelClass::obstacle);
}

TEST(Prune, CeilingBelowTheCamera) {
  PruneGeometry g = level_camera();
  g.clearance_m = 0.3;
  // H - C = 0.2: at v = 280, d_f = 10, above the clearance when d > 10 * 0.5/0.2 = 25.
  EXPECT_EQ(classify(g, 320, 280, 25), PixelClass::obstacle);
  EXPECT_EQ(classify(g, 320, 280, 25.0625), PixelClass::ceiling);
  EXPECT_EQ(classify(g, 320, 200, 5), PixelClass::ceiling);
}

TEST(Prune, WhereTheFloorCannotBeMatchedNothingIsConcluded) {
  PruneGeometry g = level_camera();
  g.max_disparity_px = 32;
  EXPECT_EQ(classify(g, 320, 368, 31), PixelClass::floor);         // d_f = 32
  EXPECT_EQ(classify(g, 320, 369, 20), PixelClass::no_disparity);  // d_f = 32.25
}

TEST(Prune, CoordinatesOfKnownPixels) {
  PruneGeometry g = level_camera();
  Model m(g);
  ObstaclePoint p = reproject_pixel(m.prune, 320, 240, 20 * 16);  // straight ahead at 2 m
  EXPECT_EQ(p.forward_mm, 2000);
  EXPECT_EQ(p.left_mm, 0);
  EXPECT_EQ(p.height_mm, 500);
  p = reproject_pixel(m.prune, 416, 288, 20 * 16);  // X = 0.6, Y = 0.3
  EXPECT_EQ(p.forward_mm, 2000);
  EXPECT_EQ(p.left_mm, -600);
  EXPECT_EQ(p.height_mm, 200);
  g.forward_m = 0.3;
  g.left_m = 0.1;
  g.yaw = 90 * kDegree;  // looks to the left
  m = Model(g);
  p = reproject_pixel(m.prune, 416, 288, 20 * 16);
  EXPECT_EQ(p.forward_mm, 300 + 600);
  EXPECT_EQ(p.left_mm, 100 + 2000);
}

PruneGeometry random_geometry(std::mt19937& random) {
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  PruneGeometry g;
  g.focal_px = between(300, 1000);
  g.baseline_m = between(0.05, 0.6);
  g.center_u = between(300, 340);
  g.center_v = between(220, 260);
  g.height_m = between(0.2, 2.0);
  g.pitch = between(-10, 30) * kDegree;
  g.roll = between(-10, 10) * kDegree;
  g.yaw = between(-40, 40) * kDegree;
  g.forward_m = between(-0.5, 0.5);
  g.left_m = between(-0.3, 0.3);
  g.clearance_m = between(0.3, 2.5);
  g.floor_tolerance_m = 0.05;
  g.max_disparity_px = 128;
  return g;
}

struct Body {
  double forward, left, height;
};

// Full 3-D reprojection with rotation matrices: camera axes in the body frame, after yaw, pitch and roll.
Body reproject_exactly(const PruneGeometry& g, int u, int v, double d) {
  const double z = g.focal_px * g.baseline_m / d;
  const double x = (u - g.center_u) * z / g.focal_px;
  const double y = (v - g.center_v) * z / g.focal_px;
  const double across = std::cos(g.roll) * x - std::sin(g.roll) * y;  // to the right, level
  const double down = std::sin(g.roll) * x + std::cos(g.roll) * y;    // before pitch
  const double ahead = std::cos(g.pitch) * z - std::sin(g.pitch) * down;
  const double sunk = std::sin(g.pitch) * z + std::cos(g.pitch) * down;
  return {std::cos(g.yaw) * ahead + std::sin(g.yaw) * across + g.forward_m,
          std::sin(g.yaw) * ahead - std::cos(g.yaw) * across + g.left_m, g.height_m - sunk};
}

TEST(PruneProperty, DisparitySpaceEqualsFullReprojectionForRandomPoses) {
  std::mt19937 random(11);
  int points = 0;
  for (int pose = 0; pose < 200; ++pose) {
    const PruneGeometry g = random_geometry(random);
    const Model m(g);
    for (int i = 0; i < 200; ++i) {
      const int u = std::uniform_int_distribution(0, 639)(random);
      const int v = std::uniform_int_distribution(0, 479)(random);
      const auto d16 = static_cast<std::int16_t>(std::uniform_int_distribution(16, 128 * 16)(random));
      const Body exact = reproject_exactly(g, u, v, d16 / 16.0);
      if (g.focal_px * g.baseline_m / (d16 / 16.0) > g.max_depth_m) continue;
      const ObstaclePoint p = reproject_pixel(m.prune, u, v, d16);
      // Depth is rounded to 1 mm and each direction to 2^-16 of it; heights also carry the rounded plane.
      ASSERT_NEAR(p.forward_mm, exact.forward * 1000, 2.5);
      ASSERT_NEAR(p.left_mm, exact.left * 1000, 2.5);
      const double plane_rounding_mm = g.height_m * 1000 * 16 / d16 * 640 / 65536;
      ASSERT_NEAR(p.height_mm, exact.height * 1000, 1.5 + plane_rounding_mm);
      ++points;
    }
  }
  EXPECT_GT(points, 20000);
}

// What a pixel is, from its point in space.
PixelClass classify_exactly(const PruneGeometry& g, const Body& p, double floor_disparity, double d) {
  const double sigma = std::hypot(g.disparity_sigma_px, g.focal_px * g.baseline_m * g.pitch_sigma / g.height_m);
  const double margin = g.sigma_factor * sigma;
  if (g.focal_px * g.baseline_m / d > g.max_depth_m) return PixelClass::too_far;
  if (floor_disparity > g.max_disparity_px) return PixelClass::no_disparity;
  if (floor_disparity > 0) {
    if (p.height < -g.floor_tolerance_m && d < floor_disparity - margin) return PixelClass::drop_off;
    if (p.height <= g.floor_tolerance_m || d <= floor_disparity + margin) return PixelClass::floor;
  }
  return p.height > g.clearance_m ? PixelClass::ceiling : PixelClass::obstacle;
}

TEST(PruneProperty, ClassesAgreeWithHeightsInSpace) {
  std::mt19937 random(12);
  int seen[kPixelClasses] = {};
  int different = 0;
  int points = 0;
  for (int pose = 0; pose < 300; ++pose) {
    const PruneGeometry g = random_geometry(random);
    const Model m(g);
    for (int i = 0; i < 300; ++i) {
      const int u = std::uniform_int_distribution(0, 639)(random);
      const int v = std::uniform_int_distribution(0, 479)(random);
      const double floor = static_cast<double>(m.prune.floor.at(u, v)) / 65536;
      // Half of the disparities near the floor's own, where the decisions are.
      double d = std::uniform_real_distribution(0.5, 127.0)(random);
      if (i % 2 == 0 && floor > 1 && floor < 120) d = floor + std::uniform_real_distribution(-3.0, 3.0)(random);
      const auto d16 = static_cast<std::int16_t>(std::max(std::lround(d * 16), 1L));
      d = d16 / 16.0;
      const PixelClass exact = classify_exactly(g, reproject_exactly(g, u, v, d), floor, d);
      const PixelClass fast = classify_pixel(m.prune, u, v, d16);
      ++seen[static_cast<int>(fast)];
      ++points;
      if (exact != fast) ++different;
    }
  }
  for (int c = 0; c < kPixelClasses; ++c)
    EXPECT_GT(seen[c], 500) << "class " << c << " hardly tried";
  // Only points within the rounding of a bound (Q16 px) may fall on the other side.
  EXPECT_LE(different, points / 2000);
}

TEST(PruneProperty, TheWorldMirrors) {
  std::mt19937 random(13);
  for (int pose = 0; pose < 50; ++pose) {
    PruneGeometry g = random_geometry(random);
    g.center_u = 319.5;
    PruneGeometry mirrored = g;
    mirrored.roll = -g.roll;
    mirrored.yaw = -g.yaw;
    mirrored.left_m = -g.left_m;
    const Model a(g);
    const Model b(mirrored);
    for (int i = 0; i < 100; ++i) {
      const int u = std::uniform_int_distribution(0, 639)(random);
      const int v = std::uniform_int_distribution(0, 479)(random);
      const auto d16 = static_cast<std::int16_t>(std::uniform_int_distribution(64, 2048)(random));
      const ObstaclePoint p = reproject_pixel(a.prune, u, v, d16);
      const ObstaclePoint q = reproject_pixel(b.prune, 639 - u, v, d16);
      ASSERT_NEAR(p.forward_mm, q.forward_mm, 1);
      ASSERT_NEAR(p.left_mm, -q.left_mm, 1);
    }
  }
}

class PruneRow : public ::testing::Test {
 protected:
  explicit PruneRow() : model_(level_camera()) {
    row_.obstacles = obstacles_;
    row_.floor = floor_;
    row_.below = below_;
  }
  Status run(int v, const std::vector<std::int16_t>& d) {
    classes_.assign(d.size(), PixelClass::too_far);
    return reproject_prune_row_ref(model_.prune, v, d, row_, counts_, classes_);
  }
  Model model_;
  std::vector<ObstaclePoint> obstacles_ = std::vector<ObstaclePoint>(8);
  std::vector<GroundStrip> floor_ = std::vector<GroundStrip>(8);
  std::vector<GroundStrip> below_ = std::vector<GroundStrip>(8);
  std::vector<PixelClass> classes_;
  PrunedRow row_;
  PixelCounts counts_;
};

TEST_F(PruneRow, SortsCountsAndReprojects) {
  ASSERT_EQ(run(320, {-1, -4, 0, 20 * 16, 40 * 16, 10 * 16, 40 * 16}), Status::ok);
  EXPECT_EQ(row_.obstacle_count, 2U);
  EXPECT_EQ(row_.floor_count, 1U);
  EXPECT_EQ(row_.below_count, 1U);
  EXPECT_EQ(counts_.by_class[static_cast<int>(PixelClass::no_disparity)], 2U);
  EXPECT_EQ(counts_.by_class[static_cast<int>(PixelClass::too_far)], 1U);
  EXPECT_EQ(counts_.by_reason[0], 1U);
  EXPECT_EQ(counts_.by_reason[3], 1U);
  EXPECT_EQ(row_.obstacles[0].forward_mm, 1000);
  EXPECT_EQ(row_.obstacles[0].height_mm, 250);
  EXPECT_EQ(row_.obstacles[0].left_mm, 988);  // 316 / 320 m = 987.5 mm
  EXPECT_EQ(classes_[3], PixelClass::floor);
  EXPECT_EQ(classes_[5], PixelClass::drop_off);
}

TEST_F(PruneRow, AFloorPixelCoversTheGroundBetweenItsEdges) {
  // v = 256: d_f = 4 px, z = 10 m; at v + 1/2 the floor is at 40/4.125 = 9.697 m, at v - 1/2 beyond the 10 m limit.
  ASSERT_EQ(run(256, {4 * 16}), Status::ok);
  ASSERT_EQ(row_.floor_count, 1U);
  const GroundStrip& s = row_.floor[0];
  EXPECT_EQ(s.near_forward_mm, 9697);
  EXPECT_EQ(s.far_forward_mm, 10000);
  EXPECT_NEAR(s.near_left_mm, s.near_forward_mm, 1);
}

TEST_F(PruneRow, WorksWithoutAClassImageAndAddsToTheCounts) {
  const std::vector<std::int16_t> d = {40 * 16, 40 * 16};
  ASSERT_EQ(reproject_prune_row_ref(model_.prune, 320, d, row_, counts_, {}), Status::ok);
  ASSERT_EQ(reproject_prune_row_ref(model_.prune, 320, d, row_, counts_, {}), Status::ok);
  EXPECT_EQ(counts_.by_class[static_cast<int>(PixelClass::obstacle)], 4U);
  EXPECT_EQ(row_.obstacle_count, 2U);
}

TEST_F(PruneRow, AnUnknownCodeCountsAsNotSearched) {
  ASSERT_EQ(run(320, {-16, -32768, -6}), Status::ok);
  EXPECT_EQ(counts_.by_reason[0], 2U);
  EXPECT_EQ(counts_.by_reason[5], 1U);
}

TEST_F(PruneRow, RefusesShortArrays) {
  EXPECT_EQ(run(0, std::vector<std::int16_t>(9)), Status::scratch_too_small);
  std::vector<PixelClass> wrong(3);
  const std::vector<std::int16_t> d(2);
  EXPECT_EQ(reproject_prune_row_ref(model_.prune, 0, d, row_, counts_, wrong), Status::size_mismatch);
}

TEST(PruneModelTest, RefusesAbsurdGeometry) {
  std::vector<std::int32_t> table(4096);
  PruneModel m;
  PruneGeometry g = level_camera();
  g.floor_tolerance_m = g.height_m;
  EXPECT_EQ(build_prune_model(g, table, table, m), Status::bad_argument);
  g = level_camera();
  g.focal_px = 0;
  EXPECT_EQ(build_prune_model(g, table, table, m), Status::bad_argument);
  g = level_camera();
  g.pitch = 1.5;
  EXPECT_EQ(build_prune_model(g, table, table, m), Status::bad_argument);
  g = level_camera();
  EXPECT_EQ(build_prune_model(g, std::span(table).first(std::size_t{64} * 16), table, m),
            Status::scratch_too_small);
}

}  // namespace
}  // namespace lakshya

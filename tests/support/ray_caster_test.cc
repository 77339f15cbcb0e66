#include "tests/support/ray_caster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/test_prune_model.h"

namespace lakshya::test {
namespace {

constexpr std::uint8_t kGround = 1;
constexpr std::uint8_t kThing = 2;
constexpr double kDegree = std::numbers::pi / 180;

// f B = 16 px m.
CameraRig small_rig() {
  CameraRig rig;
  rig.width = 160;
  rig.height = 120;
  rig.focal_px = 128;
  rig.baseline_m = 0.125;
  return rig;
}

Rectangle ground() {
  return {{-50, -50, 0}, {1, 0, 0}, {0, 1, 0}, 200, 100, kGround, {.seed = 5}};
}

// Fills the view at `forward` metres.
Rectangle wall(double forward) {
  return {{forward, -20, -20}, {0, 1, 0}, {0, 0, 1}, 40, 40, kThing, {.seed = 9}};
}

std::vector<std::uint8_t> grays(const Image<std::uint8_t>& image) {
  const auto view = image.view();
  return {view.data, view.data + static_cast<std::ptrdiff_t>(view.width) * view.height};
}

double spread(const ImageView<const std::uint8_t>& image, int u0, int v0, int width, int height) {
  double sum = 0;
  double squares = 0;
  for (int v = v0; v < v0 + height; ++v) {
    for (int u = u0; u < u0 + width; ++u) {
      sum += image.at(u, v);
      squares += image.at(u, v) * image.at(u, v);
    }
  }
  const double n = width * height;
  return std::sqrt(squares / n - sum / n * sum / n);
}

TEST(RayCaster, AWallStraightAheadHasTheDisparityOfItsDistance) {
  const RenderedPair pair = render_pair({wall(2.5)}, small_rig());
  for (int v = 0; v < 120; v += 7) {
    for (int u = 0; u < 160; u += 7) {
      EXPECT_NEAR(pair.left.depth.view().at(u, v), 2.5, 1e-6);
      EXPECT_NEAR(pair.disparity.view().at(u, v), 6.4, 1e-5);
      EXPECT_EQ(pair.disparity16.view().at(u, v), 102);  // 102.4
      EXPECT_EQ(pair.left.object.view().at(u, v), kThing);
    }
  }
}

TEST(RayCaster, WholeDisparitiesShiftTheImageExactly) {
  const RenderedPair pair = render_pair({wall(2.0)}, small_rig());  // 8 px
  for (int v = 0; v < 120; ++v) {
    for (int u = 8; u < 160; ++u)
      ASSERT_NEAR(pair.left.gray.view().at(u, v), pair.right.gray.view().at(u - 8, v), 1) << u << "," << v;
  }
}

// d_f = (B/H) (n_x (u-c_u) + n_y (v-c_v) + n_z f): docs/contract.md section 3.
TEST(RayCaster, TheFloorsDisparityIsTheContractsAffineFormula) {
  for (const auto& [pitch, roll] : {std::pair{0.0, 0.0}, {8.0, 0.0}, {-3.0, 5.0}, {12.0, -7.0}}) {
    CameraRig rig = small_rig();
    rig.pitch_deg = pitch;
    rig.roll_deg = roll;
    const RenderedPair pair = render_pair({ground()}, rig);
    const double p = pitch * kDegree;
    const double r = roll * kDegree;
    int seen = 0;
    for (int v = 0; v < rig.height; ++v) {
      for (int u = 0; u < rig.width; ++u) {
        const double d = rig.baseline_m / rig.height_m *
                         (std::cos(p) * std::sin(r) * (u - rig.center_u()) +
                          std::cos(p) * std::cos(r) * (v - rig.center_v()) + std::sin(p) * rig.focal_px);
        if (d < 1) continue;  // beyond 16 m the made floor may end
        ++seen;
        ASSERT_NEAR(pair.disparity.view().at(u, v), d, 1e-4) << u << "," << v << " pitch " << pitch;
      }
    }
    EXPECT_GT(seen, 5000);
  }
}

// The pruning kernel's coordinates come from the same contract by another way.
TEST(RayCaster, TheKernelPutsEveryPixelBackOntoTheSurfaceItShows) {
  CameraRig rig = small_rig();
  rig.pitch_deg = 9;
  rig.roll_deg = 4;
  Surfaces scene{ground()};
  add_cuboid(scene, {{2.5, 0.2, 0}, {0.4, 0.5, 0.6}, 0.5}, kThing, {});
  const RenderedPair pair = render_pair(scene, rig);
  const TestPruneModel model({.focal_px = rig.focal_px,
                              .baseline_m = rig.baseline_m,
                              .center_u = rig.center_u(),
                              .center_v = rig.center_v(),
                              .height_m = rig.height_m,
                              .pitch = rig.pitch_deg * kDegree,
                              .roll = rig.roll_deg * kDegree});
  const CameraAxes axes = camera_axes(rig);
  for (int v = 0; v < rig.height; v += 3) {
    for (int u = 0; u < rig.width; u += 3) {
      const double depth = pair.left.depth.view().at(u, v);
      if (depth > 4) continue;
      const Vec3 truth = Vec3{0, 0, rig.height_m} + depth * pixel_ray(rig, axes, u, v);
      const ObstaclePoint p = reproject_pixel(model.prune, u, v, pair.disparity16.view().at(u, v));
      const double tolerance_mm = 4 + 1000 * depth * depth / 16 / 32 * 1.5;  // half a sixteenth of a pixel
      EXPECT_NEAR(p.forward_mm, 1000 * truth.x, tolerance_mm) << u << "," << v;
      EXPECT_NEAR(p.left_mm, 1000 * truth.y, tolerance_mm) << u << "," << v;
      EXPECT_NEAR(p.height_mm, 1000 * truth.z, tolerance_mm) << u << "," << v;
    }
  }
}

TEST(RayCaster, TheNearestSurfaceHidesWhatIsBehindIt) {
  Surfaces scene{wall(4), ground()};
  add_cuboid(scene, {{2.1, 0, 0.4}, {0.2, 0.5, 0.4}, 0}, kThing + 1, {});
  const CameraRig rig = small_rig();
  const RenderedPair pair = render_pair(scene, rig);
  // The box's front is 2 m ahead: 0.25 m to each side are 16 px about column 79.5, and 0.2 m up and down 12.8 px.
  const auto object = pair.left.object.view();
  EXPECT_EQ(object.at(79, 60), kThing + 1);
  EXPECT_FLOAT_EQ(pair.left.depth.view().at(79, 60), 2);
  EXPECT_EQ(object.at(64, 60), kThing + 1);
  EXPECT_EQ(object.at(63, 60), kThing);
  EXPECT_EQ(object.at(95, 60), kThing + 1);
  EXPECT_EQ(object.at(96, 60), kThing);
  EXPECT_EQ(object.at(79, 47), kThing + 1);
  EXPECT_EQ(object.at(79, 46), kThing);
  EXPECT_EQ(object.at(79, 119), kGround);
  EXPECT_FLOAT_EQ(pair.left.depth.view().at(79, 30), 4);
}

TEST(RayCaster, ATurnedBoxShowsItsCornerFirst) {
  Surfaces scene;
  add_cuboid(scene, {{3, 0, 0}, {0.6, 0.6, 2}, 45 * kDegree}, kThing, {});
  CameraRig rig = small_rig();
  rig.width = 161;  // the middle column looks straight ahead
  const RenderedPair pair = render_pair(scene, rig);
  const double corner = 3 - 0.3 * std::numbers::sqrt2;
  EXPECT_NEAR(pair.left.depth.view().at(80, 60), corner, 1e-6);
  // A ray's slope m meets the side x = corner + |y| at depth x with y = m x.
  const double slope = 10 / rig.focal_px;
  EXPECT_NEAR(pair.left.depth.view().at(70, 60), corner / (1 - slope), 1e-6);
  EXPECT_NEAR(pair.left.depth.view().at(90, 60), corner / (1 - slope), 1e-6);
  EXPECT_EQ(pair.left.object.view().at(0, 60), 0);
  EXPECT_EQ(pair.disparity16.view().at(0, 60), 0);
}

// Where both cameras see a surface point, the left image is the right one moved by the truth.
TEST(RayCaster, TheLeftImageWarpedByTheTruthIsTheRightOne) {
  CameraRig rig = small_rig();
  rig.pitch_deg = 8;
  rig.roll_deg = 2;
  Surfaces scene{ground(), wall(6)};
  add_cuboid(scene, {{2.5, 0.3, 0}, {0.4, 0.5, 0.6}, 0.5}, kThing + 1, {});
  const RenderedPair pair = render_pair(scene, rig);
  int compared = 0;
  int apart = 0;
  double sum = 0;
  for (int v = 0; v < rig.height; ++v) {
    for (int u = 0; u < rig.width; ++u) {
      const double at = u - static_cast<double>(pair.disparity.view().at(u, v));
      const int left = static_cast<int>(std::floor(at));
      if (left < 0 || left + 1 >= rig.width) continue;
      const float depth = pair.left.depth.view().at(u, v);
      const auto shows_it = [&](int column) {
        return std::abs(pair.right.depth.view().at(column, v) - depth) < 0.02F * depth;
      };
      if (!shows_it(left) || !shows_it(left + 1)) continue;
      const double s = at - left;
      const double warped =
          (1 - s) * pair.right.gray.view().at(left, v) + s * pair.right.gray.view().at(left + 1, v);
      const double difference = std::abs(warped - pair.left.gray.view().at(u, v));
      ++compared;
      sum += difference;
      if (difference > 24) ++apart;
    }
  }
  EXPECT_GT(compared, 14000);
  EXPECT_LT(sum / compared, 3.0);   // linear interpolation flattens the finest lattice
  EXPECT_LT(apart, compared / 50);  // silhouettes, where 2 x 2 rays mix two surfaces
}

TEST(RayCaster, ThereIsContrastToMatchNearAndFar) {
  for (const double forward : {0.8, 2.0, 5.0, 12.0, 30.0}) {
    const RenderedPair pair = render_pair({wall(forward)}, small_rig());
    for (const int u : {0, 60, 120})
      EXPECT_GT(spread(pair.left.gray.view(), u, 40, 40, 40), 12) << forward << " m";
  }
}

TEST(RayCaster, TheSameSceneGivesTheSameImages) {
  Surfaces scene{ground(), wall(6)};
  const RenderedPair one = render_pair(scene, small_rig());
  const RenderedPair two = render_pair(scene, small_rig());
  EXPECT_EQ(grays(one.left.gray), grays(two.left.gray));
  EXPECT_EQ(grays(one.right.gray), grays(two.right.gray));
  scene[1].texture.seed = 77;
  EXPECT_NE(grays(render_pair(scene, small_rig()).left.gray), grays(one.left.gray));
}

}  // namespace
}  // namespace lakshya::test

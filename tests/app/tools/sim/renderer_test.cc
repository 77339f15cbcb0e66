#include "app/tools/sim/renderer.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "app/core/image.h"
#include "app/tools/sim/rig.h"
#include "app/tools/sim/walk.h"
#include "tests/support/sim_shapes.h"

namespace lakshya::sim {
namespace {

using Eigen::Vector3d;
using test::box_mesh;
using test::patch_of;
using test::thing_of;

constexpr int kWidth = 161;  // neither a whole number of packets
constexpr int kHeight = 121;
constexpr double kCameraHeight = 0.6;

RayTable table_of(bool distorted, int width = kWidth, int height = kHeight) {
  SimRig rig;
  rig.width = width;
  rig.height = height;
  rig.distorted = distorted;
  return RayTable(rig_calibration(rig).left, width, height);
}

CameraPose pose_of(double pitch = 0.2, double yaw = 0, double roll = 0) {
  return {camera_rotation(yaw, pitch, roll), {0, 0, kCameraHeight}};
}

struct Seen {
  Image<float> depth;
  Image<std::int16_t> thing;
};

Seen depth_of(const World& world, const RayTable& table, const CameraPose& pose, bool sees_glass = false,
              double time = 0) {
  Renderer renderer(world);
  renderer.set_time(time);
  Seen seen{Image<float>(table.width(), table.height()), Image<std::int16_t>(table.width(), table.height())};
  renderer.depth(table, pose, sees_glass, seen.depth.view(), seen.thing.view());
  return seen;
}

Vector3d way_of(const RayTable& table, const CameraPose& pose, int u, int v) {
  const int i = v * table.width() + u;
  return pose.world_from_camera * Vector3d(table.x()[i], table.y()[i], 1);
}

World empty_world() {
  World w;
  w.ground.surface = test::surface_of(Texture::asphalt);
  return w;
}

TEST(Renderer, FloorIsWhereThePlaneIs) {
  const World world = empty_world();
  for (const bool distorted : {false, true}) {
    const RayTable table = table_of(distorted);
    const CameraPose pose = pose_of(0.3, 0.5, 0.1);
    const Seen seen = depth_of(world, table, pose);
    int floor = 0;
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const Vector3d way = way_of(table, pose, u, v);
        const double z = -kCameraHeight / way.z();
        if (way.z() < 0 && (z * way).head<2>().cwiseAbs().maxCoeff() < 49.9) {
          ++floor;
          ASSERT_NEAR(seen.depth.view().at(u, v), z, 1e-4 * z) << u << ' ' << v;
          ASSERT_EQ(seen.thing.view().at(u, v), -1);
        } else if (way.z() > 0) {
          ASSERT_TRUE(std::isinf(seen.depth.view().at(u, v)));
          ASSERT_EQ(seen.thing.view().at(u, v), -2);
        }
      }
    }
    EXPECT_GT(floor, kWidth * kHeight / 3);
  }
}

TEST(Renderer, BoxHasItsFrontFace) {
  World world = empty_world();
  world.things.push_back(thing_of("far", box_mesh({9, 3, 0}, {1, 1, 1})));
  world.things.push_back(thing_of("box", box_mesh({2.5, 0.2, 0}, {1, 0.8, 1.5})));
  const RayTable table = table_of(true);
  const CameraPose pose = pose_of(0.1);
  const Seen seen = depth_of(world, table, pose);
  int front = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const Vector3d way = way_of(table, pose, u, v);
      const double z = 2 / way.x();
      const Vector3d at = pose.position + z * way;
      if (std::abs(at.y() - 0.2) > 0.399 || at.z() < 0.001 || at.z() > 1.499) continue;
      ++front;
      ASSERT_NEAR(seen.depth.view().at(u, v), z, 1e-4 * z);
      ASSERT_EQ(seen.thing.view().at(u, v), 1);
    }
  }
  EXPECT_GT(front, 500);
}

TEST(Renderer, PrismOfManySidesIsACylinder) {
  World world = empty_world();
  constexpr double kRadius = 0.2;
  world.things.push_back(thing_of("pole", test::prism_mesh({2, 0.3, 0}, kRadius, 2, 256)));
  const RayTable table = table_of(false);
  const CameraPose pose = pose_of(0);
  const Seen seen = depth_of(world, table, pose);
  int hits = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      if (seen.thing.view().at(u, v) != 0) continue;
      ++hits;
      const Eigen::Vector2d at =
          (pose.position + static_cast<double>(seen.depth.view().at(u, v)) * way_of(table, pose, u, v)).head<2>();
      ASSERT_NEAR((at - Eigen::Vector2d(2, 0.3)).norm(), kRadius, 2e-5);
    }
  }
  EXPECT_GT(hits, 500);
}

TEST(Renderer, RampPotholeAndKerbHaveTheirHeights) {
  World world = empty_world();
  world.ground.patches = {patch_of(1.5, -2, 3, 0, 0, 0.2), patch_of(3, -2, 5, 0, 0.3),
                          patch_of(1.2, 0.1, 2.2, 0.9, -0.2), patch_of(0, 1.2, 20, 3, 0.12)};
  const RayTable table = table_of(true);
  const CameraPose pose = pose_of(0.4);
  const Seen seen = depth_of(world, table, pose);
  int on_patches = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      if (std::isinf(seen.depth.view().at(u, v))) continue;
      const double z = seen.depth.view().at(u, v);
      const Vector3d at = pose.position + z * way_of(table, pose, u, v);
      // On the ground's surface, or on a wall between two heights: where the height jumps within a millimetre.
      double low = std::numeric_limits<double>::infinity();
      double high = -low;
      for (const double dx : {-1e-3, 0.0, 1e-3}) {
        for (const double dy : {-1e-3, 0.0, 1e-3}) {
          const double h = ground_height(world.ground, at.x() + dx, at.y() + dy);
          low = std::min(low, h);
          high = std::max(high, h);
        }
      }
      ASSERT_GT(at.z(), low - 1e-4 * z) << u << ' ' << v;
      ASSERT_LT(at.z(), high + 1e-4 * z) << u << ' ' << v;
      if (patch_at(world.ground, at.x(), at.y()) != nullptr) ++on_patches;
    }
  }
  EXPECT_GT(on_patches, 3000);
}

TEST(Renderer, WalkerIsWhereHisWalkIs) {
  World world = empty_world();
  Thing man = thing_of("man", box_mesh({0, 0, 0}, {0.3, 0.4, 1.7}));
  man.walk = Walk{{{3, -1}, {3, 1}}, 1, 0};
  world.things.push_back(man);
  Renderer renderer(world);
  for (const double time : {0.0, 0.7, 1.5, 2.6}) {
    renderer.set_time(time);
    const Place place = place_on_walk(*man.walk, time);
    // He faces along y: his 0.4 m lie along x.
    EXPECT_NEAR(renderer.range({0, place.y, 1}, {1, 0, 0}, false), 3 - 0.2, 1e-4);
    EXPECT_TRUE(std::isinf(renderer.range({0, place.y + 0.16, 1}, {1, 0, 0}, false)));
    EXPECT_NEAR(renderer.range({0, place.y - 0.14, 1}, {2, 0, 0}, false), 3 - 0.2, 1e-4);
  }
}

TEST(Renderer, GlassIsSeenOnRequestOnly) {
  World world = empty_world();
  world.things.push_back(thing_of("wall", box_mesh({4, 0, 0}, {0.2, 9, 5})));
  world.things.push_back(thing_of("pane", box_mesh({2, 0, 0}, {0.02, 9, 5}), Expect::glass));
  const Renderer renderer(world);
  EXPECT_NEAR(renderer.range({0, 0, 1}, {1, 0, 0}, false), 3.9, 1e-5);
  EXPECT_NEAR(renderer.range({0, 0, 1}, {1, 0, 0}, true), 1.99, 1e-5);
  const RayTable table = table_of(false);
  EXPECT_EQ(depth_of(world, table, pose_of(0), false).thing.view().at(80, 30), 0);
  EXPECT_EQ(depth_of(world, table, pose_of(0), true).thing.view().at(80, 30), 1);
}

TEST(Renderer, ShadowsAreDarker) {
  World world = empty_world();
  world.ground.surface = {Texture::plain, 0.5F, 0, 1, 1};
  world.things.push_back(thing_of("roof", box_mesh({2, 1, 1.5}, {1, 1, 0.1})));
  world.light.ambient = 0.4;
  world.light.sun = 1;
  world.light.sun_direction = {0, 0, 1};
  const Renderer renderer(world);
  CameraModel model;
  model.fx = model.fy = 1000;
  const RayTable one(model, 1, 1);
  const auto floor_at = [&](double x, double y) {
    Image<float> out(1, 1);
    CameraPose pose;
    pose.position = {x, y, 1};
    pose.world_from_camera << 1, 0, 0, 0, -1, 0, 0, 0, -1;  // straight down
    renderer.radiance(one, pose, out.view());
    return out.view().at(0, 0);
  };
  EXPECT_NEAR(floor_at(0.5, 0), 0.5 * 1.4, 1e-3);
  EXPECT_NEAR(floor_at(2, 1), 0.5 * 0.4, 1e-3);
  EXPECT_EQ(renderer.sun_at({2, 1, 1}), 0);
  EXPECT_EQ(renderer.sun_at({0, 0, 1}), 1);
}

World furnished() {
  World world = empty_world();
  world.things.push_back(thing_of("box", box_mesh({2.5, 0.4, 0}, {0.6, 0.6, 0.8}, 0.4)));
  world.things.push_back(thing_of("wall", box_mesh({5, 0, 0}, {0.2, 9, 3}, 0, test::surface_of(Texture::plaster))));
  world.light.lamps = {{{1, 0, 3}, 3}, {{4, 1, 3}, 2}};
  return world;
}

TEST(Renderer, ThreadsDoNotMatter) {
  const World world = furnished();
  const Renderer renderer(world);
  const RayTable table = table_of(true);
  const int threads = omp_get_max_threads();
  std::vector<float> first;
  for (const int n : {1, 2, 3}) {
    omp_set_num_threads(n);
    Image<float> out(kWidth, kHeight);
    renderer.radiance(table, pose_of(), out.view());
    const std::vector<float> pixels(out.view().data, out.view().data + kWidth * kHeight);
    if (first.empty()) first = pixels;
    EXPECT_EQ(pixels, first) << n;
  }
  omp_set_num_threads(threads);
}

TEST(Renderer, RightPictureWarpedByDepthIsTheLeftOne) {
  const World world = furnished();
  const Renderer renderer(world);
  SimRig rig;
  rig.width = 320;
  rig.height = 240;
  rig.distorted = false;
  const StereoCalibration calibration = rig_calibration(rig);
  const RayTable table(calibration.left, rig.width, rig.height);
  const CameraPose pose = pose_of();
  Image<float> left(320, 240);
  Image<float> right(320, 240);
  renderer.radiance(table, pose, left.view());
  renderer.radiance(table, right_pose(calibration, pose), right.view());
  const Seen seen = depth_of(world, table, pose);
  std::vector<float> warped;
  std::vector<float> still;
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {
      const double x = u - calibration.left.fx * rig.baseline_m / static_cast<double>(seen.depth.view().at(u, v));
      const int i = static_cast<int>(std::floor(x));
      if (i < 0 || i > 318) continue;
      const float t = static_cast<float>(x - i);
      const float r = (1 - t) * right.view().at(i, v) + t * right.view().at(i + 1, v);
      warped.push_back(std::abs(r - left.view().at(u, v)));
      still.push_back(std::abs(right.view().at(u, v) - left.view().at(u, v)));
    }
  }
  const auto median = [](std::vector<float>& x) {
    std::nth_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2), x.end());
    return x[x.size() / 2];
  };
  EXPECT_LT(median(warped), 0.35F * median(still));
}

}  // namespace
}  // namespace lakshya::sim

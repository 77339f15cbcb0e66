#include "app/tools/sim/ground_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "tests/support/sim_shapes.h"

namespace lakshya::sim {
namespace {

using test::patch_of;

double level_area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d u = (mesh.vertices[b] - mesh.vertices[a]).cast<double>();
    const Eigen::Vector3d v = (mesh.vertices[c] - mesh.vertices[a]).cast<double>();
    sum += std::abs(u.cross(v).z()) / 2;
  }
  return sum;
}

// Edges of the mesh that belong to an odd number of triangles and are not on the ground's border.
int open_edges(const Mesh& mesh, const Ground& ground) {
  using Point = std::array<float, 3>;
  std::map<std::array<Point, 2>, int> uses;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3f& p = mesh.vertices[t[k]];
      const Eigen::Vector3f& q = mesh.vertices[t[(k + 1) % 3]];
      const Point a{p.x(), p.y(), p.z()};
      const Point b{q.x(), q.y(), q.z()};
      ++uses[a < b ? std::array<Point, 2>{a, b} : std::array<Point, 2>{b, a}];
    }
  }
  int open = 0;
  for (const auto& [edge, count] : uses) {
    const auto on_border = [&](std::size_t axis, double at) {
      return edge[0][axis] == static_cast<float>(at) && edge[1][axis] == static_cast<float>(at);
    };
    const bool upright = edge[0][0] == edge[1][0] && edge[0][1] == edge[1][1];
    if (count % 2 == 1 && !upright && !on_border(0, ground.x0) && !on_border(0, ground.x1) &&
        !on_border(1, ground.y0) && !on_border(1, ground.y1)) {
      ++open;
    }
  }
  return open;
}

TEST(GroundMesh, PlainGroundIsTwoTriangles) {
  const Mesh mesh = ground_mesh(Ground{});
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_NEAR(level_area(mesh), 1e4, 1e-3);
}

TEST(GroundMesh, IsTiledOnceAndClosed) {
  Ground ground;
  ground.patches = {patch_of(1, -1, 3, 1, -0.2),     // pothole
                    patch_of(4, -1, 6, 1, 0, 0.25),  // ramp
                    patch_of(6, -1, 8, 1, 0.5),      // platform
                    patch_of(7, 0, 9, 2, 0.1),       // over its corner
                    patch_of(45, 45, 60, 60, 0.3)};  // beyond the border
  const Mesh mesh = ground_mesh(ground);
  EXPECT_NEAR(level_area(mesh), 1e4, 1e-2);
  EXPECT_EQ(open_edges(mesh, ground), 0);
  ASSERT_EQ(mesh.surface.size(), mesh.triangles.size());
  ASSERT_EQ(mesh.surfaces.size(), ground.patches.size() + 1);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3d u = (mesh.vertices[b] - mesh.vertices[a]).cast<double>();
    const Eigen::Vector3d v = (mesh.vertices[c] - mesh.vertices[a]).cast<double>();
    if (std::abs(u.cross(v).z()) < 1e-9) continue;  // a wall
    const Eigen::Vector3d middle = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]).cast<double>() / 3;
    EXPECT_NEAR(middle.z(), ground_height(ground, middle.x(), middle.y()), 1e-5);
  }
}

// Where two planes cross along an edge the wall's two triangles meet the cells' edges in their middle.
TEST(GroundMesh, WallOfCrossingPlanesFillsTheGap) {
  Ground ground;
  ground.patches = {patch_of(0, -1, 4, 1, -0.2, 0.1)};
  const Mesh mesh = ground_mesh(ground);
  double wall = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d u = (mesh.vertices[b] - mesh.vertices[a]).cast<double>();
    const Eigen::Vector3d v = (mesh.vertices[c] - mesh.vertices[a]).cast<double>();
    wall += std::abs(u.cross(v).y()) / 2;
    if (std::abs(u.cross(v).z()) > 1e-9) wall -= std::abs(u.cross(v).y()) / 2;
  }
  EXPECT_NEAR(wall, 2 * (2 * 0.2 / 2 + 2 * 0.2 / 2), 1e-6);
}

}  // namespace
}  // namespace lakshya::sim

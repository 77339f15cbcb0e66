// Small worlds for the simulator's tests.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

#include "app/tools/sim/world.h"

namespace lakshya::test {

inline sim::Surface surface_of(sim::Texture texture, std::uint32_t seed = 1) {
  return {texture, 0.5F, 0.8F, 0.5F, seed};
}

// An upright box; `base` is the centre of its underside.
inline sim::Mesh box_mesh(const Eigen::Vector3d& base, const Eigen::Vector3d& size, double yaw = 0,
                          const sim::Surface& surface = surface_of(sim::Texture::cardboard)) {
  sim::Mesh m;
  m.surfaces.push_back(surface);
  const Eigen::AngleAxisd turn(yaw, Eigen::Vector3d::UnitZ());
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d p((k & 1) != 0 ? size.x() / 2 : -size.x() / 2,
                            (k & 2) != 0 ? size.y() / 2 : -size.y() / 2, (k & 4) != 0 ? size.z() : 0);
    m.vertices.push_back((base + turn * p).cast<float>());
  }
  constexpr std::uint32_t kFaces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                          {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  for (const auto& f : kFaces) {
    m.triangles.push_back({f[0], f[1], f[2]});
    m.triangles.push_back({f[0], f[2], f[3]});
    m.surface.insert(m.surface.end(), {0, 0});
  }
  return m;
}

// The mantle of an upright prism of `sides` sides whose corners lie on a circle.
inline sim::Mesh prism_mesh(const Eigen::Vector3d& base, double radius, double height, int sides) {
  sim::Mesh m;
  m.surfaces.push_back(surface_of(sim::Texture::wood));
  for (int k = 0; k < sides; ++k) {
    const double a = 2 * std::numbers::pi * k / sides;
    const Eigen::Vector3d foot = base + radius * Eigen::Vector3d(std::cos(a), std::sin(a), 0);
    m.vertices.push_back(foot.cast<float>());
    m.vertices.push_back((foot + Eigen::Vector3d(0, 0, height)).cast<float>());
    const auto i = static_cast<std::uint32_t>(2 * k);
    const auto j = static_cast<std::uint32_t>(2 * ((k + 1) % sides));
    m.triangles.push_back({i, j, i + 1});
    m.triangles.push_back({j, j + 1, i + 1});
    m.surface.insert(m.surface.end(), {0, 0});
  }
  return m;
}

inline sim::Thing thing_of(std::string name, sim::Mesh mesh, sim::Expect expect = sim::Expect::obstacle) {
  sim::Thing t;
  t.name = std::move(name);
  t.expect = expect;
  t.mesh = std::move(mesh);
  return t;
}

inline sim::GroundPatch patch_of(double x0, double y0, double x1, double y1, double height, double slope_x = 0) {
  sim::GroundPatch p;
  p.x0 = x0;
  p.y0 = y0;
  p.x1 = x1;
  p.y1 = y1;
  p.height_m = height;
  p.slope_x = slope_x;
  p.surface = surface_of(sim::Texture::concrete);
  return p;
}

}  // namespace lakshya::test

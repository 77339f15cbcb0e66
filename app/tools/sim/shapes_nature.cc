#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/tools/sim/random.h"
#include "app/tools/sim/shapes.h"
#include "app/tools/sim/shapes_parts.h"

namespace lakshya::sim {
namespace {

using Point = MeshBuilder::Point;

Point unit_vector(Random& random) {
  const double z = random.uniform(-1, 1);
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// A leaf or a twig with leaves about `at`, of `size` from middle to corner.
void leaf(MeshBuilder& m, Random& random, const Point& at, double size) {
  const Point a = unit_vector(random);
  const Point b = a.cross(unit_vector(random)).normalized();
  const Point c = -0.5 * (a + b) + 0.3 * unit_vector(random);
  m.triangle(at + size * a, at + size * b, at + size * c);
}

}  // namespace

// Leaves fill an ellipsoid that touches the ground, denser towards its skin; none reaches out of it.
Thing bush(const Spot& spot, double diameter, double height) {
  Random random(spot.seed);
  MeshBuilder m;
  m.surface({Texture::wood, 0.2F, 0.6F, 0.2F, spot.seed});
  for (int i = 0; i < 5; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.uniform(0, 0.8)) / 5;
    const double reach = 0.15 * diameter;
    m.frustum(reach * std::cos(angle), reach * std::sin(angle), 0, 0.7 * height, 0.015, 0.008, 6);
  }
  const double size = std::clamp(0.09 * diameter, 0.05, 0.1);
  const Point radii{std::max(diameter / 2 - size, 0.02), std::max(diameter / 2 - size, 0.02),
                    std::max(height / 2 - size, 0.02)};
  const Point middle{0, 0, height / 2};
  const double skin = 4 * std::numbers::pi * (diameter / 2) * (height / 2);
  const int leaves = std::clamp(static_cast<int>(2.2 * skin / (size * size)), 150, 700);
  for (int tone = 0; tone < 2; ++tone) {
    m.surface(
        {Texture::leaves, tone == 0 ? 0.25F : 0.4F, 0.8F, 0.15F, spot.seed + static_cast<std::uint32_t>(tone)});
    for (int i = 0; i < leaves / 2; ++i) {
      const double depth = std::cbrt(random.uniform(0.25, 1));
      leaf(m, random, middle + depth * radii.cwiseProduct(unit_vector(random)), size);
    }
  }
  return made("bush", m, spot, Expect::obstacle);
}

Thing tree(const Spot& spot, double trunk_diameter, double height) {
  Random random(spot.seed);
  MeshBuilder m;
  m.surface({Texture::wood, 0.25F, 0.8F, 0.3F, spot.seed});
  m.frustum(0, 0, 0, 0.8 * height, trunk_diameter / 2, trunk_diameter / 5, 14);
  const double crown = std::max(kClearanceM + 0.4, 0.45 * height);
  const Point middle{0, 0, (crown + height) / 2};
  const Point radii{0.3 * height, 0.3 * height, (height - crown) / 2 - 0.1};
  m.surface({Texture::leaves, 0.3F, 0.8F, 0.2F, spot.seed + 1});
  constexpr int kLeaves = 350;
  for (int i = 0; i < kLeaves; ++i)
    leaf(m, random, middle + std::cbrt(random.uniform(0.2, 1)) * radii.cwiseProduct(unit_vector(random)), 0.1);
  return made("tree", m, spot, Expect::obstacle);
}

// An ellipsoid with its points moved inwards by up to a fifth, cut off flat at the ground.
Thing rock(const Spot& spot, double diameter, double height) {
  Random random(spot.seed);
  constexpr int kRings = 5;
  constexpr int kSides = 12;
  MeshBuilder m;
  m.surface({Texture::concrete, 0.4F, 0.8F, 0.3F, spot.seed});
  std::vector<std::vector<Point>> rows;
  for (int r = 0; r < kRings; ++r) {
    const double polar = std::numbers::pi / 2 * r / kRings;
    auto& row = rows.emplace_back();
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSides;
      const double radius = diameter / 2 * std::cos(polar) * random.uniform(0.8, 1);
      row.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height * std::sin(polar));
    }
  }
  m.closed_rows(rows, {0, 0, 0}, {0, 0, height});
  return made("rock", m, spot, Expect::obstacle);
}

// A closed body with a rough skin: every point of its faces is moved inwards by up to 6 cm.
Thing hedge(const Spot& spot, double length, double thickness, double height) {
  Random random(spot.seed);
  MeshBuilder m;
  m.surface({Texture::leaves, 0.3F, 0.9F, 0.25F, spot.seed});
  const int sections = std::clamp(static_cast<int>(length / 0.2), 1, 100);
  const double rough = std::min(0.06, thickness / 4);
  std::vector<std::vector<Point>> rows;  // along x, each round the hedge
  for (int i = 0; i <= sections; ++i) {
    const double x = length * (static_cast<double>(i) / sections - 0.5);
    auto& row = rows.emplace_back();
    for (const auto& [side, up] :
         {std::pair{1.0, 0.0}, std::pair{1.0, 0.33}, std::pair{1.0, 0.67}, std::pair{1.0, 1.0},
          std::pair{-1.0, 1.0}, std::pair{-1.0, 0.67}, std::pair{-1.0, 0.33}, std::pair{-1.0, 0.0}}) {
      const double y = side * (thickness / 2 - random.uniform(0, rough));
      row.emplace_back(x, y, up * height - (up == 1 ? random.uniform(0, rough) : 0));
    }
  }
  m.closed_rows(rows, {-length / 2, 0, height / 2}, {length / 2, 0, height / 2});
  return made("hedge", m, spot, Expect::obstacle);
}

Thing fence(const Spot& spot, double length, double height) {
  MeshBuilder m;
  m.surface({Texture::wood, 0.4F, 0.6F, 0.3F, spot.seed});
  const int fields = std::clamp(static_cast<int>(std::ceil(length / 1.8)), 1, 100);
  constexpr double kPost = 0.05;
  for (int i = 0; i <= fields; ++i) {
    const double x = -length / 2 + kPost + (length - 2 * kPost) * i / fields;
    m.box({x - kPost, -kPost, 0}, {x + kPost, kPost, height});
  }
  m.surface({Texture::wood, 0.5F, 0.6F, 0.4F, spot.seed + 1});
  constexpr int kBoards = 4;
  for (int i = 0; i < kBoards; ++i) {
    const double z = height * (0.12 + 0.25 * i);
    m.box({-length / 2, -0.015, z}, {length / 2, 0.015, z + 0.12 * height});
  }
  return made("fence", m, spot, Expect::obstacle);
}

}  // namespace lakshya::sim

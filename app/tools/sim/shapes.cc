#include "app/tools/sim/shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/tools/sim/random.h"
#include "app/tools/sim/shapes_parts.h"

namespace lakshya::sim {

Thing made(const char* kind, const MeshBuilder& builder, const Spot& spot, Expect expect) {
  return {kind, kind, expect, builder.placed(spot), std::nullopt};
}

void paint(Thing& thing, const Surface& surface) {
  thing.mesh.surfaces = {surface};
  std::fill(thing.mesh.surface.begin(), thing.mesh.surface.end(), std::uint16_t{0});
}

namespace {

void centred_box(MeshBuilder& m, double length, double width, double z0, double z1) {
  m.box({-length / 2, -width / 2, z0}, {length / 2, width / 2, z1});
}

}  // namespace

Thing box(const Spot& spot, double length, double width, double height) {
  Random random(spot.seed);
  MeshBuilder m;
  const auto albedo = static_cast<float>(random.uniform(0.35, 0.6));
  m.surface({Texture::cardboard, albedo, 0.5F, 0.4F, spot.seed});
  centred_box(m, length, width, 0, height);
  return made("box", m, spot, spot.bottom_m >= kClearanceM ? Expect::free : Expect::obstacle);
}

Thing crate(const Spot& spot, double length, double width, double height) {
  MeshBuilder m;
  m.surface({Texture::wood, 0.4F, 0.7F, 0.3F, spot.seed});
  centred_box(m, length, width, 0, height);
  return made("crate", m, spot, spot.bottom_m >= kClearanceM ? Expect::free : Expect::obstacle);
}

Thing wall(const Spot& spot, double length, double thickness, double height) {
  MeshBuilder m;
  m.surface({Texture::plaster, 0.6F, 0.4F, 0.8F, spot.seed});
  centred_box(m, length, thickness, 0, height);
  return made("wall", m, spot, Expect::obstacle);
}

Thing pole(const Spot& spot, double diameter, double height) {
  MeshBuilder m;
  m.surface({Texture::metal, 0.45F, 0.25F, 0.3F, spot.seed});
  m.cylinder(0, 0, 0, height, diameter / 2, 12);
  return made("pole", m, spot, Expect::obstacle);
}

Thing column(const Spot& spot, double diameter, double height) {
  MeshBuilder m;
  m.surface({Texture::concrete, 0.5F, 0.5F, 0.5F, spot.seed});
  m.cylinder(0, 0, 0, height, diameter / 2, 24);
  return made("column", m, spot, Expect::obstacle);
}

Thing floor_lamp(const Spot& spot, double height) {
  MeshBuilder m;
  m.surface({Texture::metal, 0.2F, 0.2F, 0.2F, spot.seed});
  m.cylinder(0, 0, 0, 0.03, 0.14, 16);
  m.cylinder(0, 0, 0.03, height - 0.3, 0.0125, 12);
  m.surface({Texture::cloth, 0.7F, 0.3F, 0.2F, spot.seed + 1});
  m.frustum(0, 0, height - 0.3, height, 0.2, 0.13, 16);
  return made("lamp", m, spot, Expect::obstacle);
}

namespace {

void cord(MeshBuilder& m, double x, double z0, double bottom_m) {
  const double ceiling = std::max(kCeilingM - bottom_m, z0 + 0.1);
  m.surface({Texture::plain, 0.1F, 0, 1, 1});
  m.cylinder(x, 0, z0, ceiling, 0.005, 6);
}

}  // namespace

Thing hanging_bar(const Spot& spot, double length, double thickness) {
  MeshBuilder m;
  m.surface({Texture::wood, 0.45F, 0.6F, 0.3F, spot.seed});
  centred_box(m, length, thickness, 0, thickness);
  for (const double side : {-1.0, 1.0})
    cord(m, side * (length / 2 - 0.05), thickness, spot.bottom_m);
  return made("hanging bar", m, spot, spot.bottom_m >= kClearanceM ? Expect::free : Expect::obstacle);
}

Thing hanging_lamp(const Spot& spot, double diameter) {
  MeshBuilder m;
  m.surface({Texture::metal, 0.6F, 0.3F, 0.2F, spot.seed});
  m.frustum(0, 0, 0, 0.22, diameter / 2, diameter / 6, 18);
  cord(m, 0, 0.22, spot.bottom_m);
  return made("hanging lamp", m, spot, spot.bottom_m >= kClearanceM ? Expect::free : Expect::obstacle);
}

// Two sheets' worth of gently waved surface, a hand's breadth from wave to wave. The edge lies 4 mm up: the sheets below.
Thing newspaper(const Spot& spot, double length, double width) {
  Random random(spot.seed);
  MeshBuilder m;
  m.surface({Texture::paper, 0.65F, 0.8F, 0.25F, spot.seed});
  constexpr int kCells = 6;
  std::vector<std::uint32_t> index;
  for (int i = 0; i <= kCells; ++i) {
    for (int j = 0; j <= kCells; ++j) {
      const double z = random.uniform(0.004, 0.008);
      index.push_back(m.vertex(
          {length * (static_cast<double>(i) / kCells - 0.5), width * (static_cast<double>(j) / kCells - 0.5), z}));
    }
  }
  constexpr std::size_t kRow = kCells + 1;
  for (std::size_t i = 0; i < kCells; ++i) {
    for (std::size_t j = 0; j < kCells; ++j) {
      const std::size_t a = i * kRow + j;
      m.triangle(index[a], index[a + kRow], index[a + kRow + 1]);
      m.triangle(index[a], index[a + kRow + 1], index[a + 1]);
    }
  }
  return made("newspaper", m, spot, Expect::free);
}

Thing doorway(const Spot& spot, double length, double opening, double height) {
  MeshBuilder m;
  m.surface({Texture::plaster, 0.6F, 0.4F, 0.8F, spot.seed});
  constexpr double kHalf = 0.06;
  const double head = std::min(2.0, height);
  m.box({-length / 2, -kHalf, 0}, {-opening / 2, kHalf, height});
  m.box({opening / 2, -kHalf, 0}, {length / 2, kHalf, height});
  if (height > head) m.box({-opening / 2, -kHalf, head}, {opening / 2, kHalf, height});
  return made("doorway", m, spot, Expect::obstacle);
}

Thing ceiling(const Spot& spot, double length, double width) {
  MeshBuilder m;
  m.surface({Texture::plaster, 0.8F, 0.3F, 0.6F, spot.seed});
  centred_box(m, length, width, 0, 0.1);
  return made("ceiling", m, spot, Expect::free);
}

Thing glass_pane(const Spot& spot, double length, double height) {
  MeshBuilder m;
  m.surface({Texture::plain, 0.9F, 0, 1, spot.seed});
  const double frame = std::max(2.0, height - 0.06);
  centred_box(m, length, 0.01, 0, std::min(frame, height));
  if (height > frame) {
    m.surface({Texture::metal, 0.3F, 0.3F, 0.3F, spot.seed});
    centred_box(m, length, 0.04, frame, height);
  }
  return made("glass pane", m, spot, Expect::glass);
}

}  // namespace lakshya::sim

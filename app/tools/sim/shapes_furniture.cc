#include <array>

#include "app/tools/sim/shapes.h"
#include "app/tools/sim/shapes_parts.h"

namespace lakshya::sim {
namespace {

// Four square legs at the corners of length x width.
void legs(MeshBuilder& m, double length, double width, double thickness, double top) {
  for (const double sx : {-1.0, 1.0}) {
    for (const double sy : {-1.0, 1.0}) {
      const double x = sx * (length - thickness) / 2;
      const double y = sy * (width - thickness) / 2;
      m.box({x - thickness / 2, y - thickness / 2, 0}, {x + thickness / 2, y + thickness / 2, top});
    }
  }
}

}  // namespace

Thing chair(const Spot& spot, double seat_height) {
  constexpr double kSide = 0.42;
  constexpr double kLeg = 0.035;
  MeshBuilder m;
  m.surface({Texture::wood, 0.35F, 0.5F, 0.3F, spot.seed});
  legs(m, kSide, kSide, kLeg, seat_height - 0.04);
  for (const double sy : {-1.0, 1.0}) {  // the back's posts
    const double y = sy * (kSide - kLeg) / 2;
    m.box({-kSide / 2, y - kLeg / 2, seat_height}, {-kSide / 2 + kLeg, y + kLeg / 2, seat_height + 0.2});
  }
  m.surface({Texture::cloth, 0.4F, 0.4F, 0.2F, spot.seed + 1});
  m.box({-kSide / 2, -kSide / 2, seat_height - 0.04}, {kSide / 2, kSide / 2, seat_height});
  m.box({-kSide / 2, -kSide / 2, seat_height + 0.2}, {-kSide / 2 + kLeg, kSide / 2, seat_height + 0.42});
  return made("chair", m, spot, Expect::obstacle);
}

Thing table(const Spot& spot, double length, double width, double height) {
  constexpr double kTop = 0.03;
  MeshBuilder m;
  m.surface({Texture::wood, 0.3F, 0.35F, 0.4F, spot.seed});
  legs(m, length - 0.06, width - 0.06, 0.045, height - kTop);
  m.surface({Texture::wood, 0.5F, 0.35F, 0.6F, spot.seed + 1});
  m.box({-length / 2, -width / 2, height - kTop}, {length / 2, width / 2, height});
  return made("table", m, spot, Expect::obstacle);
}

Thing shelf(const Spot& spot, double length, double height, double board_height, double overhang) {
  constexpr double kDepth = 0.35;
  MeshBuilder m;
  m.surface({Texture::wood, 0.45F, 0.4F, 0.5F, spot.seed});
  m.box({-kDepth / 2, -length / 2, 0}, {kDepth / 2, length / 2, height});
  m.surface({Texture::wood, 0.6F, 0.3F, 0.5F, spot.seed + 1});
  m.box({kDepth / 2, -length / 2, board_height}, {kDepth / 2 + overhang, length / 2, board_height + 0.04});
  return made("shelf", m, spot, Expect::obstacle);
}

Thing bench(const Spot& spot, double length) {
  constexpr double kWidth = 0.4;
  MeshBuilder m;
  m.surface({Texture::concrete, 0.5F, 0.5F, 0.4F, spot.seed});
  for (const double side : {-1.0, 1.0}) {
    const double x = side * (length / 2 - 0.25);
    m.box({x - 0.06, -kWidth / 2 + 0.05, 0}, {x + 0.06, kWidth / 2 - 0.05, 0.4});
  }
  m.surface({Texture::wood, 0.35F, 0.7F, 0.3F, spot.seed + 1});
  constexpr int kPlanks = 3;
  for (int i = 0; i < kPlanks; ++i) {
    const double y = -kWidth / 2 + i * kWidth / kPlanks;
    m.box({-length / 2, y, 0.4}, {length / 2, y + kWidth / kPlanks - 0.02, 0.45});
  }
  return made("bench", m, spot, Expect::obstacle);
}

// Bodies overlap a little, so that no light falls through a joint.
Thing person(const Spot& spot, double height) {
  const double s = height / 1.7;
  MeshBuilder m;
  m.surface({Texture::cloth, 0.2F, 0.4F, 0.15F, spot.seed});  // trousers
  for (const double side : {-1.0, 1.0}) {
    const double stride = 0.07 * side * s;  // one foot before the other
    m.frustum(stride, side * 0.1 * s, 0, 0.86 * s, 0.06 * s, 0.09 * s, 12);
    m.box({stride - 0.09 * s, side * 0.1 * s - 0.045 * s, 0},
          {stride + 0.17 * s, side * 0.1 * s + 0.045 * s, 0.08 * s});
  }
  m.surface({Texture::cloth, 0.55F, 0.6F, 0.2F, spot.seed + 1});  // jacket
  m.ellipsoid({0, 0, 1.12 * s}, {0.15 * s, 0.22 * s, 0.36 * s}, 7, 16);
  for (const double side : {-1.0, 1.0})
    m.frustum(-0.03 * side * s, side * 0.25 * s, 0.75 * s, 1.38 * s, 0.04 * s, 0.055 * s, 10);
  m.surface({Texture::plain, 0.5F, 0.3F, 0.2F, spot.seed + 2});  // skin
  m.cylinder(0, 0, 1.38 * s, 1.52 * s, 0.055 * s, 10);
  m.ellipsoid({0.01 * s, 0, 1.58 * s}, {0.1 * s, 0.08 * s, 0.12 * s}, 6, 12);
  return made("person", m, spot, Expect::obstacle);
}

Thing walking_person(const Walk& walk, double height, std::uint32_t seed) {
  Thing thing = person({0, 0, 0, 0, seed}, height);
  thing.walk = walk;
  return thing;
}

}  // namespace lakshya::sim

#include "app/tools/sim/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "app/tools/sim/shape_kinds.h"
#include "app/tools/sim/truth.h"

namespace lakshya::sim {
namespace {

constexpr double kPi = 3.14159265358979;

struct Bounds {
  Eigen::Vector3d low{1e9, 1e9, 1e9};
  Eigen::Vector3d high{-1e9, -1e9, -1e9};
};

Bounds bounds_of(const Thing& thing) {
  Bounds b;
  for (const Eigen::Vector3f& v : thing.mesh.vertices) {
    b.low = b.low.cwiseMin(v.cast<double>());
    b.high = b.high.cwiseMax(v.cast<double>());
  }
  return b;
}

void expect_bounds(const Thing& thing, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                   double tolerance = 1e-6) {
  const Bounds b = bounds_of(thing);
  EXPECT_LT((b.low - low).cwiseAbs().maxCoeff(), tolerance) << thing.kind << " " << b.low.transpose();
  EXPECT_LT((b.high - high).cwiseAbs().maxCoeff(), tolerance) << thing.kind << " " << b.high.transpose();
}

// Every edge belongs to two triangles, once in each direction.
bool is_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i)
      ++count[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, times] : count) {
    const auto back = count.find({edge.second, edge.first});
    if (times != 1 || back == count.end() || back->second != 1) return false;
  }
  return true;
}

double volume(const Mesh& mesh) {
  double six = 0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Matrix3d m = (Eigen::Matrix3d() << mesh.vertices[t[0]].cast<double>(),
                               mesh.vertices[t[1]].cast<double>(), mesh.vertices[t[2]].cast<double>())
                                  .finished();
    six += m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1)) - m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0)) +
           m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0));
  }
  return six / 6;
}

TEST(Shapes, BoundsAreWhatWasAskedFor) {
  expect_bounds(box({1, 2, 0, 0, 1}, 0.4, 0.6, 0.5), {0.8, 1.7, 0}, {1.2, 2.3, 0.5});
  expect_bounds(box({1, 2, kPi / 2, 0.1, 1}, 0.4, 0.6, 0.5), {0.7, 1.8, 0.1}, {1.3, 2.2, 0.6});
  expect_bounds(wall({0, 0, 0, 0, 1}, 4, 0.1, 2.5), {-2, -0.05, 0}, {2, 0.05, 2.5});
  expect_bounds(pole({0, 0, 0, 0, 1}, 0.06, 2), {-0.03, -0.03, 0}, {0.03, 0.03, 2});
  expect_bounds(table({0, 0, 0, 0, 1}, 1.4, 0.8, 0.72), {-0.7, -0.4, 0}, {0.7, 0.4, 0.72});
  expect_bounds(chair({0, 0, 0, 0, 1}, 0.45), {-0.21, -0.21, 0}, {0.21, 0.21, 0.87});
  expect_bounds(shelf({0, 0, 0, 0, 1}, 1, 1.6, 0.7, 0.3), {-0.175, -0.5, 0}, {0.475, 0.5, 1.6});
  expect_bounds(hanging_bar({0, 0, 0, 0.9, 1}, 1.2, 0.06), {-0.6, -0.03, 0.9}, {0.6, 0.03, kCeilingM});
  expect_bounds(doorway({0, 0, 0, 0, 1}, 3, 1.2, 2.5), {-1.5, -0.06, 0}, {1.5, 0.06, 2.5});
  expect_bounds(glass_pane({0, 0, 0, 0, 1}, 1.5, 2.1), {-0.75, -0.02, 0}, {0.75, 0.02, 2.1});
  const Bounds paper = bounds_of(newspaper({0, 0, 0, 0, 1}, 0.6, 0.4));
  EXPECT_GE(paper.low.z(), 0.004 - 1e-6);
  EXPECT_LE(paper.high.z(), 0.008 + 1e-6);
  const Bounds man = bounds_of(person({0, 0, 0, 0, 1}, 1.7));
  EXPECT_NEAR(man.high.z(), 1.7, 1e-6);
  EXPECT_GT(man.high.x(), -man.low.x());  // his feet point ahead
}

TEST(Shapes, NaturalThingsKeepInsideTheirSizes) {
  for (std::uint32_t seed = 1; seed < 20; ++seed) {
    for (const Thing& thing : {bush({0, 0, 0, 0, seed}, 0.8, 0.6), rock({0, 0, 0, 0, seed}, 0.8, 0.6)}) {
      const Bounds b = bounds_of(thing);
      EXPECT_LE(b.high.head<2>().maxCoeff(), 0.4 + 1e-6) << thing.kind << seed;
      EXPECT_GE(b.low.head<2>().minCoeff(), -0.4 - 1e-6) << thing.kind << seed;
      EXPECT_LE(b.high.z(), 0.6 + 1e-6) << thing.kind << seed;
      EXPECT_GE(b.low.z(), -1e-6) << thing.kind << seed;
      EXPECT_GT(b.high.x() - b.low.x(), 0.55) << thing.kind << seed;
      EXPECT_GT(b.high.z(), 0.45) << thing.kind << seed;
    }
  }
}

TEST(Shapes, BodiesAreClosedWithTheirOutsideOut) {
  const Spot spot{1, 2, 0.3, 0, 5};
  for (const Thing& thing :
       {box(spot, 0.4, 0.5, 0.6), pole(spot, 0.1, 2), rock(spot, 0.8, 0.5), table(spot, 1.4, 0.8, 0.72),
        chair(spot, 0.45), person(spot, 1.7), hanging_lamp(spot, 0.4), hedge(spot, 3, 0.6, 1.5)}) {
    EXPECT_TRUE(is_closed(thing.mesh)) << thing.kind;
    EXPECT_GT(volume(thing.mesh), 0) << thing.kind;
  }
  EXPECT_NEAR(volume(box(spot, 0.4, 0.5, 0.6).mesh), 0.12, 1e-6);
  EXPECT_FALSE(is_closed(newspaper(spot, 0.6, 0.4).mesh));
}

TEST(Shapes, WhatHangsHighOrLiesFlatIsFree) {
  EXPECT_EQ(hanging_bar({0, 0, 0, 1.1, 1}, 1, 0.06).expect, Expect::obstacle);
  EXPECT_EQ(hanging_bar({0, 0, 0, 1.3, 1}, 1, 0.06).expect, Expect::free);
  EXPECT_EQ(hanging_lamp({0, 0, 0, 1.1, 1}, 0.4).expect, Expect::obstacle);
  EXPECT_EQ(hanging_lamp({0, 0, 0, 1.3, 1}, 0.4).expect, Expect::free);
  EXPECT_EQ(newspaper({}, 0.6, 0.4).expect, Expect::free);
  EXPECT_EQ(glass_pane({}, 1, 2.1).expect, Expect::glass);
  EXPECT_EQ(chair({}, 0.45).expect, Expect::obstacle);
}

TEST(Shapes, EveryKindIsMadeWithItsDefaults) {
  for (const ShapeKind& kind : shape_kinds()) {
    ShapeSizes sizes{};
    for (std::size_t i = 0; i < kind.count; ++i) {
      EXPECT_LE(kind.sizes[i].low, kind.sizes[i].fallback) << kind.kind;
      EXPECT_LE(kind.sizes[i].fallback, kind.sizes[i].high) << kind.kind;
      sizes[i] = kind.sizes[i].fallback;
    }
    const Thing thing = kind.make({0, 0, 0, 1, 1}, sizes);
    EXPECT_EQ(thing.kind, kind.kind);
    ASSERT_EQ(thing.mesh.surface.size(), thing.mesh.triangles.size());
    for (std::size_t i = 0; i < thing.mesh.triangles.size(); ++i) {
      EXPECT_LT(thing.mesh.surface[i], thing.mesh.surfaces.size());
      for (const std::uint32_t v : thing.mesh.triangles[i])
        EXPECT_LT(v, thing.mesh.vertices.size());
    }
  }
}

TEST(Shapes, SeedsChangeABushAndNothingElseDoes) {
  const auto first = bush({0, 0, 0, 0, 1}, 0.8, 0.8).mesh.vertices;
  EXPECT_EQ(first, bush({0, 0, 0, 0, 1}, 0.8, 0.8).mesh.vertices);
  EXPECT_NE(first, bush({0, 0, 0, 0, 2}, 0.8, 0.8).mesh.vertices);
}

}  // namespace
}  // namespace lakshya::sim

#include "app/tools/bench_scene.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace lakshya {
namespace {

using Eigen::Vector3d;

// A block with edges along the axes of the body frame (x forward, y left, z up, metres).
struct Block {
  Vector3d low;
  Vector3d high;
  double gray;
  std::uint32_t seed;
};

const Block kBlocks[] = {
    {{-50, -50, -1}, {50, 50, 0}, 120, 1},          // floor
    {{11, -50, 0}, {12, 50, 6}, 150, 2},            // wall ahead
    {{-50, -4, 0}, {50, -3.5, 6}, 135, 3},          // wall on the right
    {{1.6, 0.25, 0}, {2.0, 0.7, 0.5}, 95, 4},       // boxes
    {{2.6, -1.1, 0}, {3.1, -0.4, 1.1}, 160, 5},     //
    {{4.0, 0.9, 0}, {5.0, 2.2, 0.9}, 105, 6},       //
    {{2.2, -0.1, 0}, {2.26, -0.04, 1.7}, 70, 7},    // pole
    {{3.0, -0.3, 1.35}, {4.2, 0.8, 1.45}, 180, 8},  // board above the vehicle
};

struct Hit {
  const Block* block = nullptr;
  double depth = std::numeric_limits<double>::infinity();
  int axis = 0;  // normal of the face
};

// Where the ray enters the block, by the three pairs of planes (Kay and Kajiya, SIGGRAPH 1986).
void enter(const Block& block, const Vector3d& eye, const Vector3d& ray, Hit& nearest) {
  double in = 0;
  double out = nearest.depth;
  int axis = -1;
  for (int i = 0; i < 3; ++i) {
    const double a = (block.low[i] - eye[i]) / ray[i];
    const double b = (block.high[i] - eye[i]) / ray[i];
    if (std::min(a, b) > in) {
      in = std::min(a, b);
      axis = i;
    }
    out = std::min(out, std::max(a, b));
  }
  if (axis >= 0 && in < out) nearest = {&block, in, axis};
}

// A lattice corner's random value in [-1, 1].
double lattice_value(std::int64_t a, std::int64_t b, std::uint32_t seed) {
  std::uint32_t h = seed * 0x9E3779B9U ^ static_cast<std::uint32_t>(a) * 0x85EBCA6BU;
  h = (h ^ (h >> 15)) * 0x2C1B3C6DU ^ static_cast<std::uint32_t>(b) * 0xC2B2AE35U;
  h = (h ^ (h >> 13)) * 0x297A2D39U;
  return (h ^ (h >> 15)) / 2147483647.5 - 1;
}

double value_noise(double a, double b, std::uint32_t seed) {
  const double whole_a = std::floor(a);
  const double whole_b = std::floor(b);
  const auto i = static_cast<std::int64_t>(whole_a);
  const auto j = static_cast<std::int64_t>(whole_b);
  const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
  const double s = smooth(a - whole_a);
  const double t = smooth(b - whole_b);
  const auto across = [&](std::int64_t row) {
    return (1 - s) * lattice_value(i, row, seed) + s * lattice_value(i + 1, row, seed);
  };
  return (1 - t) * across(j) + t * across(j + 1);
}

// Three lattices of value noise, the finest with cells of at least two pixels, so that nothing aliases; it fades in
// and out with the distance, so that no seam shows (band limit: Norton, Rockwood, Skolmoski, SIGGRAPH 1982).
double texture(double a_m, double b_m, double pixel_m, std::uint32_t seed) {
  constexpr double kFinestM = 0.008;
  constexpr double kContrast = 42;  // grey levels
  const double level = std::max(std::log2(2 * pixel_m / kFinestM), 0.0);
  const double fade = level - std::floor(level);
  double cell = kFinestM * std::exp2(std::floor(level));
  auto k = static_cast<std::uint32_t>(level);
  double sum = (1 - fade) * value_noise(a_m / cell, b_m / cell, seed + 101 * k);
  for (int i = 0; i < 3; ++i) {
    cell *= 2;
    ++k;
    const double weight = i == 2 ? fade : 1;
    if (weight > 0) sum += weight * value_noise(a_m / cell, b_m / cell, seed + 101 * k);
  }
  return kContrast * sum;
}

double gray_of(const Hit& hit, const Vector3d& eye, const Vector3d& ray, double focal_px) {
  constexpr double kSky = 215;
  if (hit.block == nullptr) return kSky;
  const Vector3d point = eye + hit.depth * ray;
  const int a = hit.axis == 0 ? 1 : 0;
  const int b = hit.axis == 2 ? 1 : 2;
  const auto face = static_cast<std::uint32_t>(hit.axis);
  // Daylight from above: tops, fronts and sides differ.
  const double light[3] = {0.85, 0.75, 1.0};
  const double detail = texture(point[a], point[b], hit.depth / focal_px, 16 * hit.block->seed + face);
  return light[hit.axis] * (hit.block->gray + detail);
}

}  // namespace

Image<std::uint8_t> render_bench_scene(const RectifiedGeometry& g, BenchCamera camera) {
  const double pitch = kBenchCameraPitchDeg * std::numbers::pi / 180;
  const Vector3d ahead(std::cos(pitch), 0, -std::sin(pitch));
  const Vector3d right(0, -1, 0);
  const Vector3d down(-std::sin(pitch), 0, -std::cos(pitch));
  const bool is_left = camera == BenchCamera::left;
  const Vector3d eye = Vector3d(0, 0, kBenchCameraHeightM) + (is_left ? 0 : g.baseline_m) * right;
  const double cx = is_left ? g.cx_left : g.cx_right;
  Image<std::uint8_t> image(g.width, g.height);
  for (int v = 0; v < g.height; ++v) {
    for (int u = 0; u < g.width; ++u) {
      const Vector3d ray = ahead + (u - cx) / g.focal_px * right + (v - g.cy) / g.focal_px * down;
      Hit hit;
      for (const Block& block : kBlocks)
        enter(block, eye, ray, hit);
      const double gray = gray_of(hit, eye, ray, g.focal_px);
      image.view().at(u, v) = static_cast<std::uint8_t>(std::lround(std::clamp(gray, 0.0, 255.0)));
    }
  }
  return image;
}

}  // namespace lakshya

// Procedural grey texture for made-up scenes: the same surface point has the same grey value in every view.
//
// Value noise: random grey levels at the corners of a square lattice, hashed from the corner's integer coordinates,
// with smooth interpolation between them; several lattices, each twice as coarse as the one before. A lattice whose
// cells are not at least a pixel wide is left out (two pixels: counts fully), so that nothing aliases along an image
// row; in its place a coarser one comes in, so that there is contrast to match at every distance.
// Source of the band limit: A. Norton, A. Rockwood, P. Skolmoski, "Clamping: a method of antialiasing textured surfaces
// by bandwidth limiting in object space", SIGGRAPH 1982.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lakshya::test {

struct SurfaceTexture {
  double gray = 128;        // mean grey level
  double contrast = 50;     // grey levels; the noise's standard deviation is about half of this
  double finest_m = 0.008;  // cell of the finest lattice
  std::uint32_t seed = 1;
};

// A corner's random value in [-1, 1].
inline double lattice_value(std::int64_t a, std::int64_t b, std::uint32_t seed) {
  std::uint32_t h = seed * 0x9E3779B9U;
  for (const std::int64_t coordinate : {a, b}) {
    h ^= static_cast<std::uint32_t>(coordinate) * 0x85EBCA6BU;
    h = (h ^ (h >> 15)) * 0x2C1B3C6DU;
    h = (h ^ (h >> 12)) * 0x297A2D39U;
    h ^= h >> 15;
  }
  return h / 2147483647.5 - 1;
}

// a, b in lattice cells.
inline double value_noise(double a, double b, std::uint32_t seed) {
  const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
  const double whole_a = std::floor(a);
  const double whole_b = std::floor(b);
  const auto i = static_cast<std::int64_t>(whole_a);
  const auto j = static_cast<std::int64_t>(whole_b);
  const double s = smooth(a - whole_a);
  const double t = smooth(b - whole_b);
  const double low = (1 - s) * lattice_value(i, j, seed) + s * lattice_value(i + 1, j, seed);
  const double high = (1 - s) * lattice_value(i, j + 1, seed) + s * lattice_value(i + 1, j + 1, seed);
  return (1 - t) * low + t * high;
}

// Grey level (not clamped) of the surface point (a, b), metres; pixel_m: what a step of one pixel along the image
// row is on the surface.
inline double gray_at(const SurfaceTexture& texture, double a_m, double b_m, double pixel_m) {
  constexpr int kLattices = 12;
  constexpr double kMostWeight = 3;  // that many lattices at a time
  double weights = 0;
  double squares = 0;
  double sum = 0;
  double cell = texture.finest_m;
  for (std::uint32_t k = 0; k < kLattices && weights < kMostWeight; ++k, cell *= 2) {
    const double weight = std::min(std::clamp(cell / pixel_m - 1, 0.0, 1.0), kMostWeight - weights);
    if (weight <= 0) continue;
    weights += weight;
    squares += weight * weight;
    sum += weight * value_noise(a_m / cell, b_m / cell, texture.seed + 101 * k);
  }
  return squares > 0 ? texture.gray + texture.contrast * sum / std::sqrt(squares) : texture.gray;
}

}  // namespace lakshya::test

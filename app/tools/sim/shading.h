// Light and texture on a facet, for the renderer's own files only.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "app/tools/sim/ray_scene.h"
#include "app/tools/sim/world.h"

namespace lakshya::sim {

inline constexpr int kLanes = 16;  // rays of a packet: 8 x 2 pixels
using Lanes = std::array<float, kLanes>;

// Hits of a packet of rays, lane by lane.
struct Hits {
  Lanes px, py, pz;              // where
  Lanes nx, ny, nz;              // normal, length 1, on the ray's side
  std::array<bool, kLanes> hit;  // else the lane holds anything finite
};

struct PointLight {
  float x, y, z, strength;
};

// How much of the picture a pixel covers.
struct Footprint {
  float depth_pixel = 0;           // size of a pixel at the hit, square to the ray, m
  float cosine = 1;                // between ray and normal, > 0
  Eigen::Vector3f along{0, 0, 0};  // unit, in the facet's plane, away from the camera
};

// log2 to 0.09, which is enough to choose between levels.
inline float rough_log2(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(std::max(x, 1e-6F));
  return static_cast<float>(bits) * 0x1p-23F - 127.0F + 0.04F;
}

// Share of light that the surface sends back at p.
inline float reflectance(const Facet& facet, const Material& m, const Eigen::Vector3f& p, const Footprint& pixel) {
  constexpr int kMostSamples = 4;  // along a footprint that is longer than wide
  constexpr float kFaded = 7;      // from this level on a picture is its mean
  constexpr float kFiner = 2.7F;
  constexpr float kCoarser = 1 / 5.3F;
  const float minor = pixel.depth_pixel * m.texels_per_m;
  const float ratio = 1 / pixel.cosine;
  const int samples = ratio < 1.4F ? 1 : std::min(kMostSamples, static_cast<int>(ratio + 0.6F));
  const float level = rough_log2(minor * std::max(1.0F, ratio / static_cast<float>(samples)));
  const float u0 = facet.u_axis.dot(p) + facet.u_offset;
  const float v0 = facet.v_axis.dot(p) + facet.v_offset;
  const float length = pixel.depth_pixel * ratio / static_cast<float>(samples);
  const float du = facet.u_axis.dot(pixel.along) * length;
  const float dv = facet.v_axis.dot(pixel.along) * length;
  const TextureLayout& layout = m.layout;
  const float finer_level = level + 1.43F;
  const float coarser_level = level - 2.41F;
  float sum = 0;
  for (int i = 0; i < samples; ++i) {
    const float k = static_cast<float>(i) - 0.5F * static_cast<float>(samples - 1);
    const float u = u0 + k * du;
    const float v = v0 + k * dv;
    if (level < kFaded) sum += layout.own * (m.picture->sample_between(u, v, level) - 0.5F);
    if (layout.finer > 0 && finer_level < kFaded) {
      const float a = kFiner * (0.8F * u - 0.6F * v);
      const float b = kFiner * (0.6F * u + 0.8F * v);
      sum += layout.finer * (m.picture->sample_between(a, b, finer_level) - 0.5F);
    }
    if (layout.coarser > 0 && i == 0) {  // wide enough to be the same for all
      const float a = kCoarser * (0.96F * u0 + 0.28F * v0);
      const float b = kCoarser * (-0.28F * u0 + 0.96F * v0);
      sum += static_cast<float>(samples) * layout.coarser * (m.picture->sample_between(a, b, coarser_level) - 0.5F);
    }
  }
  const float figure = 1 + 2 * m.contrast * sum / static_cast<float>(samples);
  return std::clamp(m.albedo * std::max(figure, 0.03F), 0.0F, 0.98F);
}

// Irradiance without what needs a shadow ray: ambient light (more from above) and all lamps but `skipped`.
inline void soft_light(const Hits& h, float ambient, const std::vector<PointLight>& lamps, std::size_t skipped,
                       Lanes& out) {
  for (std::size_t i = 0; i < kLanes; ++i)
    out[i] = ambient * (0.8F + 0.2F * h.nz[i]);
  for (std::size_t k = 0; k < lamps.size(); ++k) {
    if (k == skipped) continue;
    const PointLight& lamp = lamps[k];
    for (std::size_t i = 0; i < kLanes; ++i) {
      const float x = lamp.x - h.px[i];
      const float y = lamp.y - h.py[i];
      const float z = lamp.z - h.pz[i];
      const float squared = x * x + y * y + z * z + 1e-2F;  // nobody is nearer than a lamp's own size
      const float cosine = std::max(0.0F, x * h.nx[i] + y * h.ny[i] + z * h.nz[i]);
      out[i] += lamp.strength * cosine / (squared * std::sqrt(squared));
    }
  }
}

}  // namespace lakshya::sim

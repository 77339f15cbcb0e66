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
  constexpr std::array<float, kMostSamples + 1> kShare{0, 1, 1 / 2.0F, 1 / 3.0F, 1 / 4.0F};
  const float minor = pixel.depth_pixel * m.texels_per_m;
  const float ratio = 1 / pixel.cosine;
  const int samples = ratio < 1.4F ? 1 : std::min(kMostSamples, static_cast<int>(ratio + 0.6F));
  const float level = rough_log2(minor * std::max(1.0F, ratio * kShare[static_cast<std::size_t>(samples)]));
  const float u0 = facet.u_axis.dot(p) + facet.u_offset;
  const float v0 = facet.v_axis.dot(p) + facet.v_offset;
  const float length = pixel.depth_pixel * ratio * kShare[static_cast<std::size_t>(samples)];
  const float du = facet.u_axis.dot(pixel.along) * length;
  const float dv = facet.v_axis.dot(pixel.along) * length;
  const TextureLayout& layout = m.layout;
  const TexturePicture& picture = *m.picture;
  // Blending two levels hides where one ends; several samples, or a picture laid over another, hide it as well.
  const auto nearest_level = [](float at) {
    return std::clamp(static_cast<int>(at + 0.5F), 0, TexturePicture::kLevels - 1);
  };
  // Mean of the samples at (u, v) + k (du, dv), less the picture's mean.
  const auto along_footprint = [&](float u, float v, float step_u, float step_v, int at) {
    const float back = 0.5F * static_cast<float>(samples - 1);
    std::uint32_t x = TexturePicture::fixed(u - back * step_u);
    std::uint32_t y = TexturePicture::fixed(v - back * step_v);
    const std::uint32_t dx = TexturePicture::fixed(step_u);
    const std::uint32_t dy = TexturePicture::fixed(step_v);
    float total = 0;
    for (int i = 0; i < samples; ++i, x += dx, y += dy)
      total += picture.sample(x, y, at);
    return total * kShare[static_cast<std::size_t>(samples)] - 0.5F;
  };
  float sum = 0;
  if (level < kFaded) {
    sum = layout.own *
          (samples == 1 ? picture.sample_between(TexturePicture::fixed(u0), TexturePicture::fixed(v0), level) - 0.5F
                        : along_footprint(u0, v0, du, dv, nearest_level(level)));
  }
  const float finer_level = level + 1.43F;
  if (layout.finer > 0 && finer_level < kFaded) {
    const auto turned_u = [](float u, float v) { return kFiner * (0.8F * u - 0.6F * v); };
    const auto turned_v = [](float u, float v) { return kFiner * (0.6F * u + 0.8F * v); };
    sum += layout.finer * along_footprint(turned_u(u0, v0), turned_v(u0, v0), turned_u(du, dv), turned_v(du, dv),
                                          nearest_level(finer_level));
  }
  if (layout.coarser > 0) {  // wide enough to be the same for all samples
    const float u = kCoarser * (0.96F * u0 + 0.28F * v0);
    const float v = kCoarser * (-0.28F * u0 + 0.96F * v0);
    sum +=
        layout.coarser *
        (picture.sample(TexturePicture::fixed(u), TexturePicture::fixed(v), nearest_level(level - 2.41F)) - 0.5F);
  }
  const float figure = 1 + 2 * m.contrast * sum;
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

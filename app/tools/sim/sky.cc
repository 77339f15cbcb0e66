#include "app/tools/sim/sky.h"

#include <algorithm>

#include "app/tools/sim/textures.h"

namespace lakshya::sim {
namespace {

constexpr float kCosSunRadius = 0.99996F;  // half of the sun's 0.53 degrees, made 0.5: a pixel must not miss it
constexpr float kDisc = 60;                // times the sun's irradiance: saturates every exposure

float eighth_power(float x) {
  const float x2 = x * x;
  const float x4 = x2 * x2;
  return x4 * x4;
}

}  // namespace

Sky::Sky(const Light& light)
    : sky_(static_cast<float>(light.sky)),
      sun_(static_cast<float>(light.sun)),
      clouds_(light.clouds),
      to_sun_(light.sun_direction.normalized().cast<float>()) {}

float Sky::radiance(const Eigen::Vector3f& direction) const {
  const float up = direction.z();
  if (up < 0) return sky_ * std::max(0.35F, 0.85F + 2.5F * up);  // haze where the ground ends
  float radiance = sky_ * (0.85F + 0.35F * eighth_power(1 - up) - 0.15F * up);
  if (clouds_) {
    const float spread = 0.11F / (up + 0.12F);
    const float billow =
        cloud_picture().sample_between(TexturePicture::fixed(direction.x() * spread),
                                       TexturePicture::fixed(direction.y() * spread), 0.06F / (up + 0.02F));
    const float cover = std::clamp((billow - 0.42F) * 3, 0.0F, 1.0F);
    radiance *= 0.8F + cover * (0.55F - 0.35F * std::max(0.0F, billow - 0.65F) * 4);
  }
  if (sun_ > 0) {
    const float c = std::max(0.0F, direction.dot(to_sun_));
    const float c8 = eighth_power(c);
    const float c128 = eighth_power(c8) * eighth_power(c8);
    radiance += sun_ * (0.08F * c8 + 0.35F * c128 + 1.5F * eighth_power(c128) * eighth_power(c128));
    if (c > kCosSunRadius) radiance += sun_ * kDisc;
  }
  return radiance;
}

}  // namespace lakshya::sim

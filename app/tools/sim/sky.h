// What a ray that meets nothing sees.
#pragma once

#include <Eigen/Core>

#include "app/tools/sim/world.h"

namespace lakshya::sim {

class Sky {
 public:
  explicit Sky(const Light& light);
  // Radiance from `direction` (length 1): brighter towards the horizon and the sun, clouds, the sun's disc.
  float radiance(const Eigen::Vector3f& direction) const;

 private:
  float sky_;
  float sun_;
  bool clouds_;
  Eigen::Vector3f to_sun_;
};

}  // namespace lakshya::sim

// Triangles of one thing, in metres. Plain data.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "app/tools/sim/surface.h"

namespace lakshya::sim {

struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices of vertices; both sides are seen
  std::vector<std::uint16_t> surface;                   // of each triangle: index into `surfaces`
  std::vector<Surface> surfaces;
};

}  // namespace lakshya::sim

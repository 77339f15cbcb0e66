// What a rolling map keeps, for one test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/nav/rolling_map.h"

namespace lakshya::test {

struct RollingMapArrays {
  // Everything 0, for a square of size_m; what is returned stays valid until the next call.
  RollingMapMemory make(const GridGeometry& geometry, double size_m) {
    const auto side = static_cast<std::size_t>(rolling_map_side(geometry, size_m));
    evidence.assign(side * side, 0);
    height.assign(side * side, 0);
    seen.assign(side * side, 0);
    floor.assign(side * side, 0);
    return {evidence, height, seen, floor};
  }

  std::vector<std::uint8_t> evidence;
  std::vector<std::int16_t> height;
  std::vector<std::uint32_t> seen;
  std::vector<std::uint8_t> floor;
};

}  // namespace lakshya::test

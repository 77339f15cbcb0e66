#include "app/tools/compare_planes.h"

#include <algorithm>

namespace lakshya {

Comparison compare_planes(const Planes& reference, const Planes& other) {
  Comparison result;
  for (std::size_t i = 0; i < std::min(reference.size(), other.size()); ++i) {
    const Plane& a = reference[i];
    const Plane& b = other[i];
    for (int v = 0; v < a.height; ++v) {
      for (int u = 0; u < a.width; ++u) {
        ++result.compared;
        const double expected = a.at(u, v);
        const double value = b.at(u, v);
        if (expected == value) continue;
        ++result.different;
        if (!result.first) result.first = Difference{a.what, u, v, expected, value};
      }
    }
  }
  return result;
}

}  // namespace lakshya

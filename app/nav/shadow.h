// What lies behind an obstacle as the camera looks at it: for each direction the distance of the nearest one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lakshya {

// Lengths in one unit, any; x ahead of the camera and y to its left. Directions up to kMostTangent to either side.
class Shadow {
 public:
  static constexpr int kDirections = 128;
  static constexpr double kMostTangent = 1.5;

  void clear() { nearest2_.fill(std::numeric_limits<float>::infinity()); }

  // Something `width` wide at (x, y).
  void add(double x, double y, double width) {
    if (x <= 0) return;
    const int begin = std::max(direction((y - width / 2) / x), 0);
    const int end = std::min(direction((y + width / 2) / x), kDirections - 1);
    const auto range2 = static_cast<float>(x * x + y * y);
    for (int k = begin; k <= end; ++k)
      nearest2_[static_cast<std::size_t>(k)] = std::min(nearest2_[static_cast<std::size_t>(k)], range2);
  }

  // Whether something lies before (x, y), nearer by more than `margin`.
  bool covers(double x, double y, double margin) const {
    if (x <= 0) return false;
    const int k = direction(y / x);
    if (k < 0 || k >= kDirections) return false;
    const double range = std::hypot(x, y) - margin;
    return range > 0 && range * range > nearest2_[static_cast<std::size_t>(k)];
  }

 private:
  static int direction(double tangent) {
    const double scaled = std::clamp(tangent, -2 * kMostTangent, 2 * kMostTangent) / kMostTangent;
    return static_cast<int>(std::floor((scaled + 1) * (kDirections / 2.0)));
  }

  std::array<float, kDirections> nearest2_{};
};

}  // namespace lakshya

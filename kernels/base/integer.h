// Integer rounding with one meaning on every machine: towards minus infinity, halves up.
#pragma once

#include <cmath>
#include <cstdint>

namespace lakshya {

// Largest integer <= a / b, for b > 0.
template <class Int>
constexpr Int floor_divide(Int a, Int b) {
  return a / b - (a % b < 0 ? 1 : 0);
}

// For the once-rounded coefficients of a model; |x| < 2^62.
inline std::int64_t round_half_up(double x) {
  return static_cast<std::int64_t>(std::floor(x + 0.5));
}

}  // namespace lakshya

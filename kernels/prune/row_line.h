// The model's affine bounds along one row, narrowed to 32 bits for the *_simd kernels.
#pragma once

#include <cstdint>

#include "kernels/prune/prune.h"

namespace lakshya {

// a(u) = at_0 + u * per_u
struct RowLine {
  std::int32_t at_0 = 0;
  std::int32_t per_u = 0;
};

inline constexpr int kRowLineMaxWidth = 16384;
inline constexpr std::int64_t kRowLineLimit = std::int64_t{1} << 30;

// False when a value of the row, or of the columns that a vector may overhang it, does not stay within kRowLineLimit;
// such a row is the reference's. width <= kRowLineMaxWidth.
constexpr bool narrow_to_row(const Affine& a, int v, int width, RowLine& line) {
  constexpr int kOverhang = 512;
  const auto fits = [](std::int64_t x) { return -kRowLineLimit <= x && x <= kRowLineLimit; };
  if (!fits(a.per_u) || !fits(a.at(0, v)) || !fits(a.at(width + kOverhang, v))) return false;
  line = {static_cast<std::int32_t>(a.at(0, v)), static_cast<std::int32_t>(a.per_u)};
  return true;
}

}  // namespace lakshya

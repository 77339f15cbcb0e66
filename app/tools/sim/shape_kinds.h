// The kinds of things that a world file can name, with their sizes: name, default and range of each.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "app/tools/sim/shapes.h"

namespace lakshya::sim {

struct ShapeSize {
  std::string_view name;
  double fallback = 0;
  double low = 0;
  double high = 0;
};

inline constexpr std::size_t kMostSizes = 4;
using ShapeSizes = std::array<double, kMostSizes>;

struct ShapeKind {
  std::string_view kind;
  std::array<ShapeSize, kMostSizes> sizes;  // those that it has come first
  std::size_t count = 0;
  Thing (*make)(const Spot& spot, const ShapeSizes& sizes) = nullptr;
};

std::span<const ShapeKind> shape_kinds();

}  // namespace lakshya::sim

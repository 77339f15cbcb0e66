// What a stage wrote, as planes of numbers that can be compared value by value.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "kernels/base/image_view.h"

namespace lakshya {

// `at` reads memory of the stage's output, which outlives the plane. Every number of the frame is an integer below 2^53
// or a double, so that a double holds it as it is.
struct Plane {
  std::string what;
  int width = 0;
  int height = 0;
  std::function<double(int, int)> at;
};
using Planes = std::vector<Plane>;

template <class T>
Plane plane_of(std::string what, const ImageView<T>& image) {
  return {std::move(what), image.width, image.height,
          [image](int u, int v) { return static_cast<double>(image.at(u, v)); }};
}

template <class Numbers>
Plane list_of(std::string what, const Numbers& numbers) {
  return {std::move(what), static_cast<int>(std::size(numbers)), 1,
          [&numbers](int u, int) { return static_cast<double>(numbers[static_cast<std::size_t>(u)]); }};
}

struct Difference {
  std::string what;  // the plane
  int u = 0;         // pixel, or column and row of the map's cell
  int v = 0;
  double reference = 0;
  double value = 0;
};

struct Comparison {
  std::size_t compared = 0;  // numbers
  std::size_t different = 0;
  std::optional<Difference> first;  // of the first plane that differs, row by row
};

// Planes of one stage: the same ones, of the same sizes; what one of them lacks at the end is not compared.
Comparison compare_planes(const Planes& reference, const Planes& other);

}  // namespace lakshya

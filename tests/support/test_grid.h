// A navigation map that owns its planes.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

#include "kernels/base/nav_grid.h"
#include "kernels/base/units.h"

namespace lakshya::test {

class TestGrid {
 public:
  TestGrid(int rows, int cols, std::int32_t cell_mm = 100)
      : geometry_{rows, cols, cell_mm},
        count_(cells()),
        height_sum_(cells()),
        floor_count_(cells()),
        below_count_(cells()),
        type_(cells(), std::uint8_t{kCellUnknown}) {}

  NavGrid view() {
    const int w = geometry_.cols;
    const int h = geometry_.rows;
    return {geometry_,
            {count_.data(), w, h},
            {height_sum_.data(), w, h},
            {floor_count_.data(), w, h},
            {below_count_.data(), w, h},
            {type_.data(), w, h}};
  }

  static std::uint64_t total(const ImageView<std::uint32_t>& plane) {
    std::uint64_t sum = 0;
    for (int r = 0; r < plane.height; ++r)
      sum = std::accumulate(plane.row(r), plane.row(r) + plane.width, sum);
    return sum;
  }

  friend bool operator==(const TestGrid& a, const TestGrid& b) {
    return a.count_ == b.count_ && a.height_sum_ == b.height_sum_ && a.floor_count_ == b.floor_count_ &&
           a.below_count_ == b.below_count_ && a.type_ == b.type_;
  }

 private:
  std::size_t cells() const {
    return static_cast<std::size_t>(geometry_.rows) * static_cast<std::size_t>(geometry_.cols);
  }

  GridGeometry geometry_;
  std::vector<std::uint32_t> count_;
  std::vector<std::int64_t> height_sum_;
  std::vector<std::uint32_t> floor_count_;
  std::vector<std::uint32_t> below_count_;
  std::vector<std::uint8_t> type_;
};

}  // namespace lakshya::test

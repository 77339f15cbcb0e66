// A rolling map and the frames that it is fed with.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "app/core/image.h"
#include "app/nav/rolling_map.h"
#include "app/nav/sectors.h"
#include "kernels/base/units.h"
#include "tests/support/rolling_map_arrays.h"

namespace lakshya::test {

inline constexpr std::int64_t kSecondNs = 1'000'000'000;

// A rolling map of 16 m x 16 m and the frames it is fed with: 60 x 80 cells of 0.1 m, 6 m ahead and 4 m to each side.
class RollingMapWorld : public ::testing::Test {
 protected:
  RollingMapWorld() {
    params.size_m = 16;
    params.near_m = 2;
    params.camera.angle = radians(20);
  }

  void configure() { ASSERT_EQ(map.configure(params, geometry, arrays.make(geometry, params.size_m)), Status::ok); }

  void fill(CellType what) { block(0, geometry.rows, 0, geometry.cols, what); }
  void block(int row_begin, int row_end, int col_begin, int col_end, CellType what, int height_mm = 300) {
    for (int r = row_begin; r < row_end; ++r) {
      for (int c = col_begin; c < col_end; ++c) {
        type.view().at(c, r) = what;
        count.view().at(c, r) = what == kCellObstacle ? 10 : 0;
        height_sum.view().at(c, r) = what == kCellObstacle ? 10 * height_mm : 0;
      }
    }
  }

  NavGrid frame() {
    NavGrid grid;
    grid.geometry = geometry;
    grid.count = count.view();
    grid.height_sum = height_sum.view();
    grid.floor_count = floor_count.view();
    grid.type = type.view();
    return grid;
  }

  void add(double seconds = 0.1) {
    at.time_ns += static_cast<std::int64_t>(seconds * static_cast<double>(kSecondNs));
    ASSERT_EQ(map.add(frame(), at), Status::ok);
    ASSERT_EQ(map.view(type.view(), shown.view()), Status::ok);
  }
  std::uint8_t cell(int row, int col) { return shown.view().at(col, row); }

  // Obstacle cells shown within `reach` cells of a place given in metres ahead and to the left.
  int obstacles_near(double forward, double left, double reach) {
    int found = 0;
    for (int r = 0; r < geometry.rows; ++r) {
      for (int c = 0; c < geometry.cols; ++c) {
        const double df = (r + 0.5) - forward * 10;
        const double dl = (geometry.cols / 2.0 - c - 0.5) - left * 10;
        found += cell(r, c) == kCellObstacle && std::hypot(df, dl) <= reach ? 1 : 0;
      }
    }
    return found;
  }
  int obstacles() { return obstacles_near(0, 0, 1e9); }

  GridGeometry geometry{.rows = 60, .cols = 80, .cell_mm = 100};
  Image<std::uint8_t> type{80, 60, kCellUnknown};
  Image<std::uint8_t> shown{80, 60, kCellUnknown};
  Image<std::uint32_t> count{80, 60, 0};
  Image<std::int64_t> height_sum{80, 60, 0};
  Image<std::uint32_t> floor_count{80, 60, 0};
  RollingMapArrays arrays;
  RollingMapParams params;
  RollingMap map;
  MapPose at;
};

}  // namespace lakshya::test

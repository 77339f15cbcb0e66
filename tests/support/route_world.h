// A map made by hand and the way through it.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "app/core/image.h"
#include "app/nav/route.h"
#include "tests/support/rolling_map_arrays.h"

namespace lakshya::test {

// A rolling map that was filled through frames which look in all directions from the origin: what is not an obstacle is free.
class RouteWorld : public ::testing::Test {
 protected:
  RouteWorld() {
    params_.size_m = 30;
    params_.near_m = 20;
    params_.camera.angle = 1.5;
    EXPECT_EQ(map_.configure(params_, geometry_, arrays_.make(geometry_, params_.size_m)), Status::ok);
    RouteMemory memory{bytes_[0], bytes_[1], bytes_[2], words_[0], words_[1], words_[2], bytes_[3]};
    EXPECT_EQ(planner_.configure(route_params_, geometry_.cell_mm, memory), Status::ok);
  }

  // An obstacle cell wherever `is_obstacle(east, north)` of its centre, and nothing known wherever `is_unknown`.
  template <class F>
  void see(F is_obstacle) {
    see(is_obstacle, [](double, double) { return false; });
  }
  template <class F, class G>
  void see(F is_obstacle, G is_unknown) {
    for (const double yaw : {0.0, std::numbers::pi / 2, std::numbers::pi, -std::numbers::pi / 2}) {
      const Pose pose{0, 0, yaw};
      for (int r = 0; r < geometry_.rows; ++r) {
        for (int c = 0; c < geometry_.cols; ++c) {
          const double forward = (r + 0.5) * 0.1;
          const double left = (geometry_.cols / 2.0 - c - 0.5) * 0.1;
          const double east = forward * std::cos(yaw) - left * std::sin(yaw);
          const double north = forward * std::sin(yaw) + left * std::cos(yaw);
          const bool obstacle = is_obstacle(east, north);
          type_.view().at(c, r) =
              obstacle ? kCellObstacle : (is_unknown(east, north) ? kCellUnknown : kCellUnoccupied);
          count_.view().at(c, r) = obstacle ? 10 : 0;
          height_sum_.view().at(c, r) = obstacle ? 3000 : 0;
        }
      }
      NavGrid grid;
      grid.geometry = geometry_;
      grid.type = type_.view();
      grid.count = count_.view();
      grid.height_sum = height_sum_.view();
      grid.floor_count = floor_count_.view();
      time_ += 100'000'000;
      ASSERT_EQ(map_.add(grid, {pose, time_}), Status::ok);
    }
  }

  Route plan(double east, double north, const Pose& pose = {}) {
    Route route;
    EXPECT_EQ(planner_.plan(map_, pose, east, north, 0, route), Status::ok);
    return route;
  }

  GridGeometry geometry_{.rows = 70, .cols = 140, .cell_mm = 100};
  RollingMapParams params_;
  RouteParams route_params_;
  RollingMapArrays arrays_;
  Image<std::uint8_t> type_{140, 70};
  Image<std::uint32_t> count_{140, 70};
  Image<std::int64_t> height_sum_{140, 70};
  Image<std::uint32_t> floor_count_{140, 70};
  std::vector<std::uint8_t> bytes_[4] = {
      std::vector<std::uint8_t>(kRouteCells), std::vector<std::uint8_t>(kRouteCells),
      std::vector<std::uint8_t>(kRouteCells), std::vector<std::uint8_t>(kRouteCells)};
  std::vector<std::int32_t> words_[3] = {std::vector<std::int32_t>(kRouteCells),
                                         std::vector<std::int32_t>(kRouteCells),
                                         std::vector<std::int32_t>(kRouteCells)};
  std::int64_t time_ = 0;
  RollingMap map_;
  RoutePlanner planner_;
};

}  // namespace lakshya::test

// A planner on a made-up map, and random maps.
#pragma once

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "app/core/image.h"
#include "app/nav/planner.h"
#include "kernels/base/units.h"

namespace lakshya::test {

// A world of 60 x 60 cells of 0.1 m, 6 m ahead and 3 m to each side.
class Trial {
 public:
  Trial() {
    params.active_radius_m = 4;
    params.blind_zone_m = 0.5;
    vehicle.contact_time_s = 0;
  }

  void rows(int begin, int end, CellType what) { block(begin, end, 0, geometry.cols, what); }
  void block(int row_begin, int row_end, int col_begin, int col_end, CellType what) {
    for (int r = row_begin; r < row_end; ++r) {
      for (int c = col_begin; c < col_end; ++c)
        type.view().at(c, r) = what;
    }
  }
  void configure() { ASSERT_EQ(planner.configure(params, vehicle, geometry, table), Status::ok); }
  Plan plan(const PlanInput& input = {}) {
    Plan result;
    EXPECT_EQ(planner.plan(type.view(), input, state, result), Status::ok);
    return result;
  }
  Plan fresh(const PlanInput& input = {}) {
    configure();
    state = {};
    return plan(input);
  }

  GridGeometry geometry{.rows = 60, .cols = 60, .cell_mm = 100};
  Image<std::uint8_t> type{60, 60, kCellUnoccupied};
  PlannerParams params;
  VehicleParams vehicle;
  std::vector<PolarEntry> table = std::vector<PolarEntry>(3600);
  Planner planner;
  PlanState state;
};

inline PlanInput towards(double target_deg) {
  return {.target = radians(target_deg)};
}

inline CellType drawn_cell(std::mt19937& random) {
  const auto drawn = random() % 1000;
  if (drawn < 3) return kCellObstacle;
  return drawn < 6 ? kCellUnknown : kCellUnoccupied;
}

inline void scatter(std::mt19937& random, Trial& trial) {
  for (int r = 0; r < 60; ++r) {
    for (int c = 0; c < 60; ++c)
      trial.block(r, r + 1, c, c + 1, drawn_cell(random));
  }
}

inline void mirror_into(const Trial& world, Trial& mirror) {
  for (int r = 0; r < 60; ++r) {
    for (int c = 0; c < 60; ++c)
      mirror.type.view().at(59 - c, r) = world.type.view().at(c, r);
  }
}

}  // namespace lakshya::test

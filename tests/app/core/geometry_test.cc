#include "app/core/geometry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/core/matcher.h"

namespace lakshya {
namespace {

RectifiedGeometry camera() {
  return {
      .width = 641, .height = 481, .focal_px = 320, .cx_left = 320, .cx_right = 320, .cy = 240, .baseline_m = 0.1};
}

TEST(BlindZone, IsWhereTheBottomRowMeetsTheFloor) {
  VehicleConfig config;
  config.camera.height_m = 0.6;
  config.planner.blind_zone_m = 0.1;
  // Bottom row: tan = 240/320, floor at 0.8 m; towards the corner / cos(atan(320.5/320)); two cells of 0.1 m more.
  EXPECT_NEAR(blind_zone_m(config, camera()), 0.8 / std::cos(std::atan(320.5 / 320)) + 0.2, 1e-9);
  config.camera.forward_m = 0.3;
  EXPECT_NEAR(blind_zone_m(config, camera()), 0.8 / std::cos(std::atan(320.5 / 320)) + 0.5, 1e-9);
  config.planner.blind_zone_m = 4;
  EXPECT_EQ(blind_zone_m(config, camera()), 4);
}

TEST(BlindZone, IsNotWidenedForACameraThatShowsNoFloor) {
  VehicleConfig config;
  config.camera.pitch_deg = -45;
  EXPECT_EQ(blind_zone_m(config, camera()), config.planner.blind_zone_m);
  config.camera.pitch_deg = -36.7;  // the bottom row looks 0.2 degrees down: floor beyond the map's depth
  EXPECT_EQ(blind_zone_m(config, camera()), config.planner.blind_zone_m);
}

TEST(StoredRange, TakesDoffsOutOfTheSearch) {
  EXPECT_EQ(stored_range(0, 0).first_raw, 0);
  EXPECT_EQ(stored_range(0, 0).offset16, 0);
  // doffs 32.778: 524 sixteenths, of which 32 are whole pixels.
  EXPECT_EQ(stored_range(0, 32.778).offset16, 524);
  EXPECT_EQ(stored_range(0, 32.778).first_raw, -32);
  EXPECT_EQ(stored_range(40, 32.778).first_raw, 8);
  EXPECT_EQ(stored_range(0, -2.5).first_raw, 3);
  EXPECT_EQ(stored_range(0, -2.5).offset16, -40);
}

TEST(StoredRange, NoStoredDisparityIsBelowTheMinimum) {
  for (int i = -200; i <= 200; ++i) {
    const double doffs = i * 0.37;
    const StoredRange r = stored_range(5, doffs);
    EXPECT_GE(16 * r.first_raw + r.offset16, 5 * 16) << doffs;
    EXPECT_LT(16 * r.first_raw + r.offset16, 6 * 16) << doffs;
  }
}

TEST(GridGeometryOf, RoundsToMillimetres) {
  const GridGeometry g = grid_geometry({.cell_m = 0.025, .rows = 120, .cols = 80});
  EXPECT_EQ(g.cell_mm, 25);
  EXPECT_EQ(g.rows, 120);
  EXPECT_EQ(g.cols, 80);
}

}  // namespace
}  // namespace lakshya

#include "app/loop/map_picture.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>
#include <string>

#include "kernels/base/units.h"

namespace lakshya {

static bool operator==(const Rgb8& a, const Rgb8& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}
static void PrintTo(const Rgb8& c, std::ostream* stream) {
  *stream << +c.r << " " << +c.g << " " << +c.b;
}

namespace {

constexpr Rgb8 kObstacle{200, 40, 30};
constexpr Rgb8 kFree{250, 250, 248};
constexpr Rgb8 kUnknown{176, 178, 182};
constexpr Rgb8 kVehicle{230, 159, 0};
constexpr Rgb8 kChosen{0, 90, 181};
constexpr Rgb8 kTarget{20, 20, 20};

constexpr double kDegree = std::numbers::pi / 180;

// 60 x 60 cells of 0.1 m: 10 px for each, 100 px for a metre; the turning centre is at (300, 600).
class MapPicture : public testing::Test {
 protected:
  MapPicture() {
    config_.grid.rows = 60;
    config_.grid.cols = 60;
    config_.grid.cell_m = 0.1;
    config_.vehicle.radius_m = 0.3;
    plan_.target = std::numbers::pi;  // backward, out of the picture
  }
  Image<Rgb8> draw() const { return loop_map_picture(type_.view(), plan_, config_); }
  static Rgb8 at(const Image<Rgb8>& picture, double forward_m, double left_m) {
    return picture.view().at(static_cast<int>(300 - left_m * 100), static_cast<int>(600 - forward_m * 100));
  }

  Image<std::uint8_t> type_{60, 60, kCellUnoccupied};
  VehicleConfig config_;
  PlanNote plan_;
};

TEST_F(MapPicture, ACellIsASquareOfItsColorAtItsPlace) {
  type_.view().at(0, 59) = kCellObstacle;   // farthest, leftmost: the corner above left
  type_.view().at(59, 59) = kCellUnknown;   // the corner above right
  type_.view().at(10, 20) = kCellObstacle;  // 10th column from the left, 20th row from below
  const Image<Rgb8> picture = draw();
  ASSERT_EQ(picture.width(), 600);
  ASSERT_EQ(picture.height(), 600);
  const auto p = picture.view();
  EXPECT_EQ(p.at(0, 0), kObstacle);
  EXPECT_EQ(p.at(9, 9), kObstacle);
  EXPECT_EQ(p.at(10, 9), kFree);
  EXPECT_EQ(p.at(9, 10), kFree);
  EXPECT_EQ(p.at(599, 0), kUnknown);
  EXPECT_EQ(p.at(590, 9), kUnknown);
  EXPECT_EQ(p.at(589, 0), kFree);
  // Row 20 ends 2.0 m and begins 2.1 m before the centre: pixels 390 to 399.
  for (const int u : {100, 109}) {
    for (const int v : {390, 399})
      EXPECT_EQ(p.at(u, v), kObstacle) << u << ", " << v;
  }
  EXPECT_EQ(p.at(99, 395), kFree);
  EXPECT_EQ(p.at(110, 395), kFree);
  EXPECT_EQ(p.at(105, 389), kFree);
  EXPECT_EQ(p.at(105, 400), kFree);
}

TEST_F(MapPicture, ASmallMapIsDrawnLargeAndALargeOneCellByCell) {
  type_ = Image<std::uint8_t>(7, 4, kCellUnknown);
  EXPECT_EQ(draw().width(), 7 * 150);
  EXPECT_EQ(draw().height(), 4 * 150);
  type_ = Image<std::uint8_t>(800, 700, kCellUnknown);
  EXPECT_EQ(draw().width(), 800);
  EXPECT_EQ(draw().height(), 700);
}

TEST_F(MapPicture, TheVehicleIsACircleOfItsRadiusBelowInTheMiddle) {
  const Image<Rgb8> picture = draw();
  EXPECT_EQ(at(picture, 0.05, 0), kVehicle);
  EXPECT_EQ(at(picture, 0.28, 0), kVehicle);
  EXPECT_EQ(at(picture, 0.32, 0), kFree);
  EXPECT_EQ(at(picture, 0.01, 0.28), kVehicle);
  EXPECT_EQ(at(picture, 0.01, -0.28), kVehicle);
  EXPECT_EQ(at(picture, 0.01, 0.32), kFree);
  EXPECT_EQ(at(picture, 0.01, -0.32), kFree);
  EXPECT_EQ(at(picture, 0.25, 0.25), kFree);  // 0.35 m away: a circle, no square
}

TEST_F(MapPicture, TheChosenDirectionIsDrawnAsFarAsItIsClear) {
  plan_.blocked = false;
  plan_.direction = 0;
  plan_.clear_m = 2;
  const Image<Rgb8> picture = draw();
  EXPECT_EQ(at(picture, 0.1, 0), kChosen);
  EXPECT_EQ(at(picture, 1.0, 0), kChosen);
  EXPECT_EQ(at(picture, 1.97, 0), kChosen);
  EXPECT_EQ(at(picture, 2.05, 0), kFree);
  EXPECT_EQ(at(picture, 1.0, 0.05), kFree);
}

TEST_F(MapPicture, PositiveDirectionsAreToTheLeft) {
  plan_.blocked = false;
  plan_.direction = 30 * kDegree;
  plan_.clear_m = 2.5;
  plan_.target = -45 * kDegree;
  const Image<Rgb8> picture = draw();
  // Two metres along 30 degrees: 1.732 m ahead, 1 m to the left; the target's ray is 1 m long.
  EXPECT_EQ(at(picture, 1.732, 1.0), kChosen);
  EXPECT_EQ(at(picture, 1.732, -1.0), kFree);
  EXPECT_EQ(at(picture, 0.6, -0.6), kTarget);
  EXPECT_EQ(at(picture, 0.6, 0.6), kFree);
  EXPECT_EQ(at(picture, 0.75, -0.75), kFree);
}

TEST_F(MapPicture, TheTargetsRayLeavesTheVehicle) {
  plan_.target = 0;
  config_.vehicle.radius_m = 0.6;
  const Image<Rgb8> picture = draw();
  EXPECT_EQ(at(picture, 1.75, 0), kTarget);  // three times the radius
  EXPECT_EQ(at(picture, 1.85, 0), kFree);
}

TEST_F(MapPicture, ABlockedPlanHasNoDirection) {
  plan_.blocked = true;
  plan_.direction = 0;
  plan_.clear_m = 2;
  const Image<Rgb8> picture = draw();
  for (int v = 0; v < picture.height(); ++v) {
    for (int u = 0; u < picture.width(); ++u)
      ASSERT_FALSE(picture.view().at(u, v) == kChosen) << u << ", " << v;
  }
}

TEST_F(MapPicture, WhatLiesOutsideIsLeftOut) {
  plan_.blocked = false;
  plan_.clear_m = 20;
  config_.vehicle.radius_m = 12;
  for (const double degrees : {-170.0, -90.0, -60.0, 0.0, 60.0, 90.0, 170.0}) {
    plan_.direction = degrees * kDegree;
    plan_.target = -plan_.direction;
    const Image<Rgb8> picture = draw();
    EXPECT_EQ(at(picture, 1, 1), kVehicle) << degrees;
  }
}

}  // namespace
}  // namespace lakshya

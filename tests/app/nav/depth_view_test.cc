#include "app/nav/depth_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "app/core/image.h"

namespace lakshya {
namespace {

constexpr double kFocalBaseline = 200 * 0.12;

// A level camera 1 m above the ground, 320 x 240, and a disparity image that shows one depth.
class DepthViewTest : public ::testing::Test {
 protected:
  static DepthViewParams level() {
    return {
        .focal_px = 200, .baseline_m = 0.12, .center_u = 160, .center_v = 120, .height_m = 1, .depth_sigma = 0.01};
  }
  static std::int16_t disparity_of(double depth_m) {
    return static_cast<std::int16_t>(std::lround(16 * kFocalBaseline / depth_m));
  }
  void fill(std::int16_t d) { rows(0, 240, d); }
  void rows(int begin, int end, std::int16_t d) {
    for (int v = begin; v < end; ++v) {
      for (int u = 0; u < 320; ++u)
        disparity.view().at(u, v) = d;
    }
  }
  Shown look(double forward, double left, double height) const {
    return view.at(disparity.view(), forward, left, height, 0.1);
  }

  DepthView view{level()};
  Image<std::int16_t> disparity{320, 240, -2};
};

TEST_F(DepthViewTest, WhatIsFartherNearerOrNotSeen) {
  EXPECT_EQ(look(2, 0, 0.8), Shown::nothing);
  fill(disparity_of(4));
  EXPECT_EQ(look(2, 0, 0.8), Shown::behind);
  fill(disparity_of(2.05));
  EXPECT_EQ(look(2, 0, 0.8), Shown::thing);
  fill(disparity_of(1.2));  // something before it hides it
  EXPECT_EQ(look(2, 0, 0.8), Shown::thing);
}

// 2 m away, 0.8 m high: rows 120 + 200 * (0.17 to 0.32) / 2 = 137 to 152.
TEST_F(DepthViewTest, AThinBoardBeforeAWallIsStillThere) {
  fill(disparity_of(4));
  rows(141, 145, disparity_of(2));
  EXPECT_EQ(look(2, 0, 0.8), Shown::thing);
  rows(141, 145, disparity_of(4));
  rows(160, 164, disparity_of(2));  // another one, lower
  EXPECT_EQ(look(2, 0, 0.8), Shown::behind);
}

// A bar's end costs its neighbours their disparities, too: a third of the pixels is not enough to say that it is gone.
TEST_F(DepthViewTest, WhatHangsIsGoneOnlyWhereHalfOfTheViewIsBehindIt) {
  fill(-2);
  rows(137, 143, disparity_of(4));  // of the rows 137 to 153
  EXPECT_EQ(look(2, 0, 0.8), Shown::nothing);
  rows(137, 147, disparity_of(4));
  EXPECT_EQ(look(2, 0, 0.8), Shown::behind);
  fill(-2);
  rows(152, 158, disparity_of(4));  // 0.65 m high, of the rows 152 to 168
  EXPECT_EQ(look(2, 0, 0.65), Shown::behind);
}

TEST_F(DepthViewTest, OutsideOfTheImage) {
  fill(disparity_of(4));
  EXPECT_EQ(look(-1, 0, 0.8), Shown::outside);
  EXPECT_EQ(look(2, 3, 0.8), Shown::outside);   // to the left
  EXPECT_EQ(look(2, -3, 0.8), Shown::outside);  // to the right
  EXPECT_EQ(look(0.5, 0, 1.5), Shown::outside);
  EXPECT_EQ(look(2, 0, 2.1), Shown::outside);  // in the topmost rows
  EXPECT_EQ(look(0.5, 0, 0.4), Shown::outside);
}

// A camera 0.3 m ahead of the turning centre that looks 90 degrees to the left and 10 degrees down: a place 2.5 m to the left lies before it.
TEST_F(DepthViewTest, FollowsTheMount) {
  DepthViewParams mount = level();
  mount.yaw = std::acos(-1.0) / 2;
  mount.pitch = 10 * std::acos(-1.0) / 180;
  mount.forward_m = 0.3;
  view = DepthView(mount);
  fill(-2);
  // Depth cos(10 deg) 2.5 + sin(10 deg) 0.2 = 2.5 m; row 120 + 200 tan(4.6 - 10 deg) = 101.
  for (int v = 97; v < 116; ++v) {
    for (int u = 150; u < 170; ++u)
      disparity.view().at(u, v) = disparity_of(2.5);
  }
  EXPECT_EQ(look(0.3, 2.5, 0.8), Shown::thing);
  EXPECT_EQ(look(1.3, 2.5, 0.8), Shown::nothing);  // beside it
  EXPECT_EQ(look(0.3, -2.5, 0.8), Shown::outside);
}

}  // namespace
}  // namespace lakshya

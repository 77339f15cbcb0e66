#include "app/loop/yaw_history.h"

#include <gtest/gtest.h>

#include <numbers>

namespace lakshya {
namespace {

TEST(YawHistory, LiesBetweenItsEntries) {
  YawHistory h;
  EXPECT_EQ(h.at_time(5), 0);
  h.add(100, 1.0);
  EXPECT_EQ(h.at_time(0), 1.0);
  EXPECT_EQ(h.at_time(1000), 1.0);
  h.add(200, 2.0);
  h.add(300, 1.0);
  EXPECT_EQ(h.at_time(50), 1.0);
  EXPECT_NEAR(h.at_time(125), 1.25, 1e-12);
  EXPECT_EQ(h.at_time(200), 2.0);
  EXPECT_NEAR(h.at_time(290), 1.1, 1e-12);
  EXPECT_EQ(h.at_time(300), 1.0);
  EXPECT_EQ(h.at_time(400), 1.0);
}

TEST(YawHistory, TakesTheShorterWayAcrossTheSeam) {
  YawHistory h;
  h.add(0, 3.0);
  h.add(100, -3.0);
  EXPECT_NEAR(h.at_time(50), std::numbers::pi, 1e-9);
  EXPECT_NEAR(h.at_time(75), -3.0 - 0.25 * (2 * std::numbers::pi - 6.0), 1e-9);
}

TEST(YawHistory, ForgetsTheOldestAndIgnoresWhatIsNotNewer) {
  YawHistory h;
  for (int i = 0; i < 100; ++i)
    h.add(i * 10, i * 0.01);
  EXPECT_NEAR(h.at_time(985), 0.985, 1e-9);
  EXPECT_NEAR(h.at_time(695), 0.695, 1e-9);
  EXPECT_NEAR(h.at_time(0), 0.68, 1e-9);  // 32 are kept: 68 to 99
  h.add(990, 3);
  h.add(500, 3);
  EXPECT_NEAR(h.at_time(2000), 0.99, 1e-9);
}

}  // namespace
}  // namespace lakshya

#include "app/loop/pose_history.h"

#include <gtest/gtest.h>

#include <numbers>

namespace lakshya {
namespace {

TEST(PoseHistory, LiesBetweenItsEntries) {
  PoseHistory h;
  EXPECT_EQ(h.at_time(5).yaw, 0);
  h.add({.yaw = 1.0, .time = 100});
  EXPECT_EQ(h.at_time(0).yaw, 1.0);
  EXPECT_EQ(h.at_time(1000).yaw, 1.0);
  h.add({.yaw = 2.0, .time = 200});
  h.add({.yaw = 1.0, .time = 300});
  EXPECT_EQ(h.at_time(50).yaw, 1.0);
  EXPECT_NEAR(h.at_time(125).yaw, 1.25, 1e-12);
  EXPECT_EQ(h.at_time(200).yaw, 2.0);
  EXPECT_NEAR(h.at_time(290).yaw, 1.1, 1e-12);
  EXPECT_EQ(h.at_time(300).yaw, 1.0);
}

TEST(PoseHistory, GoesOnAfterTheNewestForAWhile) {
  PoseHistory h;
  h.add({.east_m = 1, .yaw = 3.0, .time = kSecond});
  EXPECT_EQ(h.at_time(2 * kSecond).yaw, 3.0);
  h.add({.east_m = 1.1, .yaw = 3.1, .time = kSecond + 20 * kMillisecond});
  EXPECT_NEAR(h.at_time(kSecond + 40 * kMillisecond).east_m, 1.2, 1e-12);
  EXPECT_NEAR(h.at_time(kSecond + 40 * kMillisecond).yaw, 3.2 - 2 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(h.at_time(kSecond + 120 * kMillisecond).east_m, 1.6, 1e-12);
  EXPECT_NEAR(h.at_time(2 * kSecond).east_m, 1.6, 1e-12);
}

TEST(PoseHistory, TakesTheShorterWayAcrossTheSeam) {
  PoseHistory h;
  h.add({.yaw = 3.0, .time = 0});
  h.add({.yaw = -3.0, .time = 100});
  EXPECT_NEAR(h.at_time(50).yaw, std::numbers::pi, 1e-9);
  EXPECT_NEAR(h.at_time(75).yaw, -3.0 - 0.25 * (2 * std::numbers::pi - 6.0), 1e-9);
}

TEST(PoseHistory, ForgetsTheOldestAndIgnoresWhatIsNotNewer) {
  PoseHistory h;
  for (int i = 0; i < 100; ++i)
    h.add({.yaw = i * 0.01, .time = i * 10});
  EXPECT_NEAR(h.at_time(985).yaw, 0.985, 1e-9);
  EXPECT_NEAR(h.at_time(695).yaw, 0.695, 1e-9);
  EXPECT_NEAR(h.at_time(0).yaw, 0.68, 1e-9);  // 32 are kept: 68 to 99
  h.add({.yaw = 3, .time = 990});
  h.add({.yaw = 3, .time = 500});
  EXPECT_NEAR(h.at_time(990).yaw, 0.99, 1e-9);
}

TEST(PoseHistory, PlacesLieBetweenItsEntries) {
  PoseHistory h;
  EXPECT_EQ(h.at_time(7).east_m, 0);
  h.add({.east_m = 1, .north_m = -2, .yaw = 0.5, .time = 100});
  h.add({.east_m = 3, .north_m = -6, .yaw = 0.5, .time = 200});
  const PoseSample between = h.at_time(125);
  EXPECT_NEAR(between.east_m, 1.5, 1e-12);
  EXPECT_NEAR(between.north_m, -3, 1e-12);
  EXPECT_EQ(between.time, 125);
  EXPECT_EQ(h.at_time(50).east_m, 1);
}

}  // namespace
}  // namespace lakshya

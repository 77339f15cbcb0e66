#include "app/nav/steering.h"

#include <gtest/gtest.h>

#include "app/nav/sectors.h"

namespace lakshya {
namespace {

TEST(Steering, TurnRateFollowsTheDirectionUpToItsLimit) {
  EXPECT_NEAR(turn_rate(0.2, 1.5, 1.0), 0.3, 1e-12);
  EXPECT_NEAR(turn_rate(-0.2, 1.5, 1.0), -0.3, 1e-12);
  EXPECT_EQ(turn_rate(2.0, 1.5, 1.0), 1.0);
  EXPECT_EQ(turn_rate(-2.0, 1.5, 1.0), -1.0);
}

TEST(Steering, SpeedFallsWithTheDirection) {
  EXPECT_EQ(speed_towards(0, 2.0), 2.0);
  EXPECT_NEAR(speed_towards(radians(60), 2.0), 1.0, 1e-12);
  EXPECT_NEAR(speed_towards(radians(-60), 2.0), 1.0, 1e-12);
  EXPECT_EQ(speed_towards(radians(120), 2.0), 0);
}

TEST(Steering, TurningLeftTheRightWheelIsFaster) {
  const WheelSpeeds wheels = wheel_speeds(1.0, 0.4, 0.5);
  EXPECT_NEAR(wheels.left_mps, 0.9, 1e-12);
  EXPECT_NEAR(wheels.right_mps, 1.1, 1e-12);
}

// One step of one wheel; the other stands.
double step(double wanted, double now, double dt_s) {
  const WheelSpeeds next = limit_acceleration({wanted, 0}, {now, 0}, {1.0, 2.0}, dt_s);
  EXPECT_EQ(next.right_mps, 0);
  const WheelSpeeds other = limit_acceleration({0, wanted}, {0, now}, {1.0, 2.0}, dt_s);
  EXPECT_EQ(other.right_mps, next.left_mps);
  return next.left_mps;
}

TEST(Steering, WheelsAreLimitedInAcceleration) {
  EXPECT_NEAR(step(1.0, 0.0, 0.1), 0.1, 1e-12);
  EXPECT_NEAR(step(1.0, 0.95, 0.1), 1.0, 1e-12);
  EXPECT_NEAR(step(-1.0, -0.5, 0.1), -0.6, 1e-12);
  EXPECT_EQ(step(1.0, 0.3, 0.0), 0.3);
}

TEST(Steering, WheelsBrakeAsTheGovernorCountsOn) {
  EXPECT_NEAR(step(0.0, 1.0, 0.1), 0.8, 1e-12);
  EXPECT_NEAR(step(0.95, 1.0, 0.1), 0.95, 1e-12);
  EXPECT_NEAR(step(-0.2, -1.0, 0.1), -0.8, 1e-12);
  EXPECT_EQ(step(0.0, 0.1, 0.1), 0.0);
}

TEST(Steering, AWheelThatChangesItsSenseBrakesFirst) {
  EXPECT_NEAR(step(-1.0, 1.0, 0.1), 0.8, 1e-12);
  // 0.1 m/s are braked in 0.05 s, the other 0.05 s accelerate.
  EXPECT_NEAR(step(-1.0, 0.1, 0.1), -0.05, 1e-12);
  EXPECT_NEAR(step(0.02, -0.1, 0.1), 0.02, 1e-12);
}

}  // namespace
}  // namespace lakshya

#include "app/nav/speed_governor.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace lakshya {
namespace {

TEST(SpeedGovernor, HandComputed) {
  // D = 0.7: 0.25 v + v^2 / 4 = 0.7 gives v = (-1 + sqrt(12.2)) / 2 = 1.2464.
  EXPECT_NEAR(governed_speed(1.0, {.contact_time_s = 0}), 1.246424, 1e-6);
  // Contact time: 1.0 / 2.8.
  EXPECT_NEAR(governed_speed(1.0, {}), 0.357143, 1e-6);
  // No latency: v = sqrt(2 a D) = sqrt(2 * 2 * 4).
  EXPECT_NEAR(governed_speed(4.0, {.latency_s = 0, .stop_margin_m = 0, .contact_time_s = 0}), 4.0, 1e-12);
}

TEST(SpeedGovernor, ThePaperSees20MetresAt7MetresPerSecond) {
  EXPECT_NEAR(governed_speed(20.0, {.deceleration_mps2 = 4}), 7.0, 1e-12);
  EXPECT_NEAR(governed_speed(14.0, {.deceleration_mps2 = 4}), 5.0, 1e-12);
}

TEST(SpeedGovernor, StandsWithinTheMargin) {
  EXPECT_EQ(governed_speed(0.0, {}), 0);
  EXPECT_EQ(governed_speed(0.3, {}), 0);
  EXPECT_EQ(governed_speed(-1.0, {}), 0);
  EXPECT_EQ(governed_speed(0.0, {.stop_margin_m = 0}), 0);
  EXPECT_EQ(governed_speed(std::numeric_limits<double>::quiet_NaN(), {}), 0);
}

TEST(SpeedGovernor, NothingInTheWay) {
  EXPECT_EQ(governed_speed(std::numeric_limits<double>::infinity(), {}), 7);
  EXPECT_EQ(governed_speed(1e6, {}), 7);
}

bool allowed(double v, double clear_m, const GovernorParams& p, double tolerance) {
  return v <= p.max_speed_mps + tolerance && v * p.contact_time_s <= clear_m + tolerance &&
         v * p.latency_s + v * v / (2 * p.deceleration_mps2) <= clear_m - p.stop_margin_m + tolerance;
}

TEST(SpeedGovernor, LargestSpeedThatKeepsEveryLimit) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const GovernorParams p{.max_speed_mps = 8 * unit(random),
                           .latency_s = unit(random),
                           .deceleration_mps2 = 0.1 + 5 * unit(random),
                           .stop_margin_m = unit(random),
                           .contact_time_s = 4 * unit(random)};
    const double clear_m = 20 * unit(random);
    const double v = governed_speed(clear_m, p);
    ASSERT_GE(v, 0);
    if (clear_m > p.stop_margin_m) {
      ASSERT_TRUE(allowed(v, clear_m, p, 1e-9)) << clear_m;
    } else {
      ASSERT_EQ(v, 0);
    }
    ASSERT_FALSE(allowed(v + 1e-4, clear_m, p, 0)) << clear_m;
  }
}

}  // namespace
}  // namespace lakshya

#include "hal/angle.h"

#include <gtest/gtest.h>

namespace lakshya {
namespace {

TEST(Angle, IsWrappedIntoHalfOpenTurn) {
  const double pi = std::numbers::pi;
  EXPECT_EQ(wrapped_angle(pi), pi);
  EXPECT_EQ(wrapped_angle(-pi), pi);
  EXPECT_EQ(wrapped_angle(0), 0);
  EXPECT_NEAR(wrapped_angle(pi + 0.25), 0.25 - pi, 1e-12);
  EXPECT_NEAR(wrapped_angle(-9 * pi - 0.25), pi - 0.25, 1e-12);
}

}  // namespace
}  // namespace lakshya

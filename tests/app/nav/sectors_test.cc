#include "app/nav/sectors.h"

#include <gtest/gtest.h>

namespace lakshya {
namespace {

TEST(Sectors, CentresRunFromRightToLeft) {
  EXPECT_EQ(sector_centre(0), 0);
  EXPECT_NEAR(degrees(sector_centre(18)), 90, 1e-12);
  EXPECT_NEAR(degrees(sector_centre(36)), 180, 1e-12);
  EXPECT_NEAR(degrees(sector_centre(37)), -175, 1e-12);
  EXPECT_NEAR(degrees(sector_centre(71)), -5, 1e-12);
  EXPECT_EQ(sector_centre(-1), sector_centre(71));
  EXPECT_EQ(sector_centre(72), 0);
}

TEST(Sectors, EveryCentreIsInItsSector) {
  for (int k = 0; k < kPolarSectors; ++k) {
    EXPECT_EQ(sector_of(sector_centre(k)), k);
    EXPECT_EQ(sector_of(sector_centre(k) + radians(2.4)), k);
    EXPECT_EQ(sector_of(sector_centre(k) - radians(2.4)), k);
    EXPECT_EQ(sector_of(sector_centre(k) + radians(720)), k);
  }
}

TEST(Sectors, MirroredDirectionsFallIntoMirroredSectors) {
  for (int step = 0; step < 314; ++step) {
    const double direction = 0.01 * step;
    EXPECT_EQ(sector_of(-direction), wrap_sector(-sector_of(direction)));
  }
}

TEST(Sectors, Wrapping) {
  EXPECT_EQ(wrap_sector(-73), 71);
  EXPECT_EQ(wrap_sector(145), 1);
  EXPECT_EQ(sector_index(-1), 71U);
  EXPECT_NEAR(wrap_angle(radians(350)), radians(-10), 1e-12);
  EXPECT_NEAR(wrap_angle(radians(-190)), radians(170), 1e-12);
  EXPECT_NEAR(angle_between(radians(170), radians(-170)), radians(20), 1e-12);
  EXPECT_NEAR(angle_between(radians(-30), radians(15)), radians(45), 1e-12);
}

}  // namespace
}  // namespace lakshya

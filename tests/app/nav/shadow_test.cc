#include "app/nav/shadow.h"

#include <gtest/gtest.h>

namespace lakshya {
namespace {

TEST(Shadow, CoversWhatLiesBehindWithinItsWidth) {
  Shadow shadow;
  shadow.clear();
  EXPECT_FALSE(shadow.covers(3, 0, 0));
  shadow.add(2, 0.5, 0.4);  // from 0.3 to 0.7 at 2: 0.6 to 1.4 at 4
  EXPECT_TRUE(shadow.covers(4, 0.65, 0.3));
  EXPECT_TRUE(shadow.covers(4, 1.35, 0.3));
  EXPECT_FALSE(shadow.covers(4, 0.5, 0.3));
  EXPECT_FALSE(shadow.covers(4, 1.5, 0.3));
  EXPECT_FALSE(shadow.covers(1.9, 0.5, 0));
  EXPECT_FALSE(shadow.covers(2.2, 0.55, 0.3));
  EXPECT_TRUE(shadow.covers(2.5, 0.62, 0.3));
  shadow.clear();
  EXPECT_FALSE(shadow.covers(4, 1, 0));
}

TEST(Shadow, TheNearestCountsAndNothingOutsideTheView) {
  Shadow shadow;
  shadow.clear();
  shadow.add(3, 0, 0.1);
  shadow.add(2, 0, 0.1);
  shadow.add(2.5, 0, 0.1);
  EXPECT_TRUE(shadow.covers(2.2, 0, 0.1));
  shadow.add(-1, 0, 5);
  shadow.add(1, 4, 0.1);
  shadow.add(1, -4, 0.1);
  EXPECT_FALSE(shadow.covers(-2, 0, 0));
  EXPECT_FALSE(shadow.covers(2, 8, 0));
  EXPECT_FALSE(shadow.covers(2, -8, 0));
  EXPECT_FALSE(shadow.covers(5, 7.4, 0));
}

}  // namespace
}  // namespace lakshya

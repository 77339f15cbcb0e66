#include "kernels/select/select.h"

#include <gtest/gtest.h>

#include <vector>

#include "kernels/base/units.h"

namespace lakshya {
namespace {

constexpr int kWidth = 24;
constexpr int kCandidates = 16;

// A row whose costs are 200 everywhere until a test sets some.
class Select : public ::testing::Test {
 protected:
  std::uint16_t& sum(int u, int i) {
    return sums_[static_cast<std::size_t>(u) * kCandidates + static_cast<std::size_t>(i)];
  }

  int disparity_at(int u) {
    std::vector<std::int16_t> scratch(select_scratch_elements(kWidth));
    EXPECT_EQ(select_row_ref(sums_, textured_, range_, params_, scratch, out_), Status::ok);
    return out_[static_cast<std::size_t>(u)];
  }

  // A clear minimum of depth `least` at candidate i with a symmetric parabola.
  void match(int u, int i, int least = 20) {
    sum(u, i) = static_cast<std::uint16_t>(least);
    if (i > 0) sum(u, i - 1) = 100;
    if (i < kCandidates - 1) sum(u, i + 1) = 100;
  }

  std::vector<std::uint16_t> sums_ = std::vector<std::uint16_t>(std::size_t{kWidth} * kCandidates, 200);
  std::vector<std::uint8_t> textured_ = std::vector<std::uint8_t>(kWidth, 1);
  std::vector<std::int16_t> out_ = std::vector<std::int16_t>(kWidth, 999);
  SearchRange range_{.first = 0, .disparities = kCandidates, .valid_begin = 0, .valid_end = kWidth};
  SelectParams params_{.uniqueness_percent = 10, .left_right_max = 1, .offset16 = 0};
};

TEST_F(Select, TakesTheLeastCost) {
  match(20, 5);
  EXPECT_EQ(disparity_at(20), 5 * 16);
}

TEST_F(Select, SmallerDisparityWinsATie) {
  params_.uniqueness_percent = 0;
  sum(20, 5) = 20;
  sum(20, 6) = 20;
  // Sub-pixel: (200 - 20) and equal neighbours: num = 180, den = 180, floor((16*180 + 180) / 360) = 8: half way.
  EXPECT_EQ(disparity_at(20), 5 * 16 + 8);
}

TEST_F(Select, SubPixelIsTheVertexOfTheParabola) {
  match(20, 5, 10);
  sum(20, 4) = 40;
  sum(20, 6) = 60;  // num = -20, den = 80: floor((-320 + 80) / 160) = floor(-1.5) = -2
  EXPECT_EQ(disparity_at(20), 5 * 16 - 2);
  sum(20, 4) = 60;
  sum(20, 6) = 40;  // num = 20: floor((320 + 80) / 160) = floor(2.5) = 2
  EXPECT_EQ(disparity_at(20), 5 * 16 + 2);
}

TEST_F(Select, NoSubPixelAtTheEndsOfTheRange) {
  sum(20, 0) = 20;
  sum(20, 1) = 50;
  EXPECT_EQ(disparity_at(20), 0);
  sum(20, 0) = 200;
  sum(20, 1) = 200;
  sum(20, 15) = 20;
  sum(20, 14) = 50;
  EXPECT_EQ(disparity_at(20), 15 * 16);
}

TEST_F(Select, ASecondMinimumNearlyAsGoodIsNotUnique) {
  match(20, 5, 90);
  sum(20, 12) = 100;  // 100 * 90 = 9000 is not below 100 * 90
  EXPECT_EQ(disparity_at(20), 5 * 16);
  sum(20, 12) = 99;
  EXPECT_EQ(disparity_at(20), kNotUnique);
  params_.uniqueness_percent = 0;
  EXPECT_EQ(disparity_at(20), 5 * 16);
}

TEST_F(Select, TheWinnersNeighboursDoNotCountAgainstIt) {
  sum(20, 5) = 90;
  sum(20, 4) = 91;
  sum(20, 6) = 91;
  EXPECT_EQ(disparity_at(20), 5 * 16);
}

TEST_F(Select, LeftRightCheckRejectsAnOccludedPixel) {
  match(20, 5);      // right pixel 15
  match(22, 7, 10);  // the same right pixel, better
  EXPECT_EQ(disparity_at(20), kLeftRightFailed);
  EXPECT_EQ(disparity_at(22), 7 * 16);
  params_.left_right_max = 2;
  EXPECT_EQ(disparity_at(20), 5 * 16);
  params_.left_right_max = -1;
  EXPECT_EQ(disparity_at(20), 5 * 16);
}

TEST_F(Select, LeftRightCheckAllowsOnePixel) {
  match(20, 5);
  match(21, 6, 10);
  EXPECT_EQ(disparity_at(20), 5 * 16);
}

// The disparity 4.8 names the right pixels 15 and 16: one that agrees is enough.
TEST_F(Select, LeftRightCheckAsksBothNeighboursOfAFraction) {
  sum(20, 5) = 20;
  sum(20, 4) = 30;
  sum(20, 6) = 40;   // num = -10, den = 30: 5 - 2/16
  match(22, 7, 10);  // right pixel 15 prefers candidate 7
  EXPECT_EQ(disparity_at(20), 5 * 16 - 3);
  match(23, 7, 10);  // and right pixel 16 too
  EXPECT_EQ(disparity_at(20), kLeftRightFailed);
}

TEST_F(Select, AMatchOutsideTheRightImageIsNotSearched) {
  match(3, 5);
  EXPECT_EQ(disparity_at(3), kNotSearched);
}

TEST_F(Select, TextureComesFirst) {
  match(20, 5);
  textured_[20] = 0;
  EXPECT_EQ(disparity_at(20), kLowTexture);
}

TEST_F(Select, ColumnsWithoutDescriptorsAreNotSearched) {
  range_.valid_begin = 4;
  range_.valid_end = 20;
  match(20, 5);
  textured_[3] = 0;
  EXPECT_EQ(disparity_at(20), kNotSearched);
  EXPECT_EQ(out_[3], kNotSearched);
  match(8, 5);  // right pixel 3 has none
  EXPECT_EQ(disparity_at(8), kNotSearched);
}

TEST_F(Select, OffsetMakesStoredDisparities) {
  range_.first = -2;
  params_.offset16 = 2 * 16 + 7;
  match(20, 5);  // raw disparity 3
  EXPECT_EQ(disparity_at(20), 3 * 16 + 39);
  params_.offset16 = 31;  // would make candidate 0 negative
  std::vector<std::int16_t> scratch(kWidth);
  EXPECT_EQ(select_row_ref(sums_, textured_, range_, params_, scratch, out_), Status::bad_argument);
}

TEST_F(Select, RefusesWrongArguments) {
  std::vector<std::int16_t> scratch(kWidth - 1);
  EXPECT_EQ(select_row_ref(sums_, textured_, range_, params_, scratch, out_), Status::scratch_too_small);
  scratch.resize(kWidth);
  params_.uniqueness_percent = 100;
  EXPECT_EQ(select_row_ref(sums_, textured_, range_, params_, scratch, out_), Status::bad_argument);
  params_.uniqueness_percent = 10;
  textured_.pop_back();
  EXPECT_EQ(select_row_ref(sums_, textured_, range_, params_, scratch, out_), Status::size_mismatch);
}

}  // namespace
}  // namespace lakshya

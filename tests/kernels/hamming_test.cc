#include "kernels/hamming/hamming.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace lakshya {
namespace {

TEST(Hamming, HandComputedRow) {
  const std::vector<CensusCode> left = {0b0000, 0b0001, 0b0011, 0b0111};
  const std::vector<CensusCode> right = {0b0000, 0b1111, 0b0011, 0xFFFF};
  std::vector<std::uint8_t> cost(std::size_t{4} * 16, 99);
  ASSERT_EQ(hamming_row_ref(left, right, {.first = 0, .disparities = 16, .valid_begin = 0, .valid_end = 4}, cost),
            Status::ok);
  const auto at = [&](int u, int d) {
    return int{cost[std::size_t{16} * static_cast<std::size_t>(u) + static_cast<std::size_t>(d)]};
  };
  EXPECT_EQ(at(0, 0), 0);
  EXPECT_EQ(at(0, 1), kOutsideCost);
  EXPECT_EQ(at(1, 0), 3);   // 0001 ^ 1111
  EXPECT_EQ(at(1, 1), 1);   // 0001 ^ 0000
  EXPECT_EQ(at(3, 0), 13);  // 0111 ^ 16 ones
  EXPECT_EQ(at(3, 1), 1);
  EXPECT_EQ(at(3, 2), 1);
  EXPECT_EQ(at(3, 3), 3);
  EXPECT_EQ(at(3, 4), kOutsideCost);
  EXPECT_EQ(at(3, 15), kOutsideCost);
}

TEST(Hamming, NegativeFirstDisparityLooksToTheRight) {
  const std::vector<CensusCode> left = {1, 1, 1};
  const std::vector<CensusCode> right = {1, 3, 7};
  std::vector<std::uint8_t> cost(std::size_t{3} * 16);
  ASSERT_EQ(hamming_row_ref(left, right, {.first = -2, .disparities = 16, .valid_begin = 0, .valid_end = 3}, cost),
            Status::ok);
  EXPECT_EQ(cost[0], 2);              // u 0 against u_right 2
  EXPECT_EQ(cost[1], 1);              // u_right 1
  EXPECT_EQ(cost[2], 0);              // u_right 0
  EXPECT_EQ(cost[16], kOutsideCost);  // u 1 against u_right 3
}

TEST(Hamming, LeavesColumnsWithoutDescriptorsAlone) {
  const std::vector<CensusCode> codes(10, 5);
  std::vector<std::uint8_t> cost(std::size_t{10} * 16, 99);
  ASSERT_EQ(hamming_row_ref(codes, codes, {.first = 0, .disparities = 16, .valid_begin = 4, .valid_end = 6}, cost),
            Status::ok);
  for (std::size_t i = 0; i < cost.size(); ++i) {
    const std::size_t u = i / 16;
    const std::size_t d = i % 16;
    const int expected = u < 4 || u > 5 ? 99 : (u - d >= 4 && u >= d ? 0 : kOutsideCost);
    ASSERT_EQ(cost[i], expected) << u << " " << d;
  }
}

// Three rows of three pixels; the left and right columns repeat themselves.
TEST(SmoothCost, HandComputedRow) {
  const SearchRange range{.first = 0, .disparities = 16, .valid_begin = 1, .valid_end = 4};
  const auto row = [](int a, int b, int c) {
    std::vector<std::uint8_t> cost(std::size_t{16} * 5, 16);  // columns 0 and 4 are not valid
    for (std::size_t i = 0; i < 16; ++i) {
      cost[16 + i] = static_cast<std::uint8_t>(a);
      cost[32 + i] = static_cast<std::uint8_t>(b);
      cost[48 + i] = static_cast<std::uint8_t>(c);
    }
    return cost;
  };
  std::vector<std::uint8_t> out(std::size_t{16} * 5, 99);
  ASSERT_EQ(smooth_cost_row_ref(row(0, 1, 2), row(3, 4, 5), row(6, 7, 16), range, out), Status::ok);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(out[i], 99);
    EXPECT_EQ(out[16 + i], (2 * (0 + 3 + 6) + (1 + 4 + 7) + 1) / 2);
    EXPECT_EQ(out[32 + i], (0 + 1 + 2 + 3 + 4 + 5 + 6 + 7 + 16 + 1) / 2);
    EXPECT_EQ(out[48 + i], ((1 + 4 + 7) + 2 * (2 + 5 + 16) + 1) / 2);
    EXPECT_EQ(out[64 + i], 99);
  }
}

TEST(SmoothCost, TheLargestFitsAndIsTheConstant) {
  const SearchRange range{.first = 0, .disparities = 16, .valid_begin = 0, .valid_end = 2};
  const std::vector<std::uint8_t> worst(32, 16);
  std::vector<std::uint8_t> out(32);
  ASSERT_EQ(smooth_cost_row_ref(worst, worst, worst, range, out), Status::ok);
  EXPECT_EQ(out, std::vector<std::uint8_t>(32, kMaxSmoothCost));
}

TEST(SmoothCost, RefusesWrongArguments) {
  const std::vector<std::uint8_t> row(32);
  std::vector<std::uint8_t> out(32);
  const std::vector<std::uint8_t> shorter(16);
  SearchRange range{.first = 0, .disparities = 16, .valid_begin = 0, .valid_end = 2};
  EXPECT_EQ(smooth_cost_row_ref(shorter, row, row, range, out), Status::size_mismatch);
  EXPECT_EQ(smooth_cost_row_ref(row, row, shorter, range, out), Status::size_mismatch);
  range.valid_end = 3;
  EXPECT_EQ(smooth_cost_row_ref(row, row, row, range, out), Status::bad_argument);
  range.disparities = 0;
  EXPECT_EQ(smooth_cost_row_ref(row, row, row, range, out), Status::bad_argument);
}

TEST(Hamming, RefusesWrongArguments) {
  const std::vector<CensusCode> codes(8);
  std::vector<std::uint8_t> cost(std::size_t{8} * 16);
  EXPECT_EQ(hamming_row_ref(codes, codes, {.first = 0, .disparities = 8, .valid_begin = 0, .valid_end = 8}, cost),
            Status::bad_argument);
  EXPECT_EQ(hamming_row_ref(codes, codes, {.first = 0, .disparities = 16, .valid_begin = 0, .valid_end = 9}, cost),
            Status::bad_argument);
  EXPECT_EQ(hamming_row_ref(codes, codes, {.first = 0, .disparities = 32, .valid_begin = 0, .valid_end = 8}, cost),
            Status::size_mismatch);
  EXPECT_EQ(hamming_row_ref(codes, std::span(codes).first(7),
                            {.first = 0, .disparities = 16, .valid_begin = 0, .valid_end = 8}, cost),
            Status::size_mismatch);
}

}  // namespace
}  // namespace lakshya

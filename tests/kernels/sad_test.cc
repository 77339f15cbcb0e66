#include "kernels/sad/sad.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <vector>

namespace lakshya {
namespace {

constexpr std::uint8_t kOutside = 10;

TEST(Sad, HandComputedRow) {
  const std::vector<std::uint8_t> left = {0, 31, 62, 254};
  const std::vector<std::uint8_t> right = {5, 30, 62, 0};
  std::vector<std::uint8_t> cost(64, 99);
  ASSERT_EQ(
      sad_row_ref(left, right, {.first = 0, .disparities = 16, .valid_begin = 0, .valid_end = 4}, kOutside, cost),
      Status::ok);
  const auto at = [&](std::size_t u, std::size_t i) { return int{cost[16 * u + i]}; };
  EXPECT_EQ(at(0, 0), 5);
  EXPECT_EQ(at(0, 1), kOutside);
  EXPECT_EQ(at(1, 0), 1);
  EXPECT_EQ(at(1, 1), 26);
  EXPECT_EQ(at(2, 0), 0);
  EXPECT_EQ(at(2, 1), 32);
  EXPECT_EQ(at(3, 0), 254);
  EXPECT_EQ(at(3, 1), 192);
  EXPECT_EQ(at(3, 2), 224);
  EXPECT_EQ(at(3, 3), 249);
  EXPECT_EQ(at(3, 4), kOutside);
  EXPECT_EQ(at(3, 15), kOutside);
}

TEST(Sad, NegativeFirstDisparityLooksToTheRight) {
  const std::vector<std::uint8_t> left = {1, 1, 1};
  const std::vector<std::uint8_t> right = {1, 3, 7};
  std::vector<std::uint8_t> cost(48);
  ASSERT_EQ(
      sad_row_ref(left, right, {.first = -2, .disparities = 16, .valid_begin = 0, .valid_end = 3}, kOutside, cost),
      Status::ok);
  EXPECT_EQ(cost[0], 6);          // u 0 against u_right 2
  EXPECT_EQ(cost[1], 2);          // u_right 1
  EXPECT_EQ(cost[2], 0);          // u_right 0
  EXPECT_EQ(cost[16], kOutside);  // u 1 against u_right 3
}

TEST(Sad, EqualsTheDefinitionAndLeavesColumnsWithoutEdgesAlone) {
  std::mt19937 random(1);
  constexpr int kWidth = 45;
  std::vector<std::uint8_t> left(kWidth);
  std::vector<std::uint8_t> right(kWidth);
  for (std::size_t u = 0; u < kWidth; ++u) {
    left[u] = static_cast<std::uint8_t>(random() % 256);
    right[u] = static_cast<std::uint8_t>(random() % 256);
  }
  std::vector<std::uint8_t> cost(std::size_t{kWidth} * 32, 99);
  ASSERT_EQ(
      sad_row_ref(left, right, {.first = 3, .disparities = 32, .valid_begin = 4, .valid_end = 40}, kOutside, cost),
      Status::ok);
  for (int u = 0; u < kWidth; ++u) {
    for (int i = 0; i < 32; ++i) {
      const int other = u - 3 - i;
      int expected = kOutside;
      if (u < 4 || u >= 40) {
        expected = 99;
      } else if (other >= 4) {
        expected = std::abs(left[static_cast<std::size_t>(u)] - right[static_cast<std::size_t>(other)]);
      }
      ASSERT_EQ(cost[static_cast<std::size_t>(32 * u + i)], expected) << u << " " << i;
    }
  }
}

TEST(Sad, OutsideCostFollowsTheCap) {
  EXPECT_EQ(sad_outside_cost(1), 1);  // never as good as a perfect match
  EXPECT_EQ(sad_outside_cost(3), 1);
  EXPECT_EQ(sad_outside_cost(31), 10);
  EXPECT_EQ(sad_outside_cost(127), 42);
}

TEST(Sad, RefusesWrongArguments) {
  const std::vector<std::uint8_t> edges(8);
  std::vector<std::uint8_t> cost(128);
  const auto run = [&](std::span<const std::uint8_t> right, const SearchRange& range) {
    return sad_row_ref(edges, right, range, kOutside, cost);
  };
  const SearchRange good{.first = 0, .disparities = 16, .valid_begin = 0, .valid_end = 8};
  EXPECT_EQ(run(edges, good), Status::ok);
  EXPECT_EQ(run(edges, {.first = 0, .disparities = 8, .valid_begin = 0, .valid_end = 8}), Status::bad_argument);
  EXPECT_EQ(run(edges, {.first = 0, .disparities = 16, .valid_begin = 0, .valid_end = 9}), Status::bad_argument);
  EXPECT_EQ(run(edges, {.first = 0, .disparities = 32, .valid_begin = 0, .valid_end = 8}), Status::size_mismatch);
  EXPECT_EQ(run(std::span(edges).first(7), good), Status::size_mismatch);
}

}  // namespace
}  // namespace lakshya

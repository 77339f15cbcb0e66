#include "hal/servo/quicksilver_travel.h"

#include <gtest/gtest.h>

#include <limits>

namespace lakshya {
namespace {

using Verdict = QuickSilverTravel::Verdict;

constexpr std::int32_t kHighest = std::numeric_limits<std::int32_t>::max();
constexpr std::int32_t kLowest = std::numeric_limits<std::int32_t>::min();
constexpr Nanoseconds kTenth = 100 * kMillisecond;

class QuickSilverTravelTest : public testing::Test {
 protected:
  // 1000 counts are a metre; 1 m/s: 0.15 m and 0.05 m, 200 counts, are believed after 0.1 s.
  void SetUp() override { travel_.start(0.001, 1.0); }
  Verdict take_after_tenth(std::int32_t position) { return travel_.take(position, now_ += kTenth); }

  Nanoseconds now_ = 7 * kSecond;
  QuickSilverTravel travel_;
};

TEST_F(QuickSilverTravelTest, StartsWhereTheDriveIs) {
  EXPECT_EQ(travel_.metres(), 0);
  EXPECT_EQ(take_after_tenth(-123456), Verdict::believed);
  EXPECT_EQ(travel_.metres(), 0);
  EXPECT_EQ(take_after_tenth(-123356), Verdict::believed);
  EXPECT_DOUBLE_EQ(travel_.metres(), 0.1);
  travel_.start(-0.001, 1.0);
  EXPECT_EQ(take_after_tenth(500), Verdict::believed);
  EXPECT_EQ(take_after_tenth(600), Verdict::believed);
  EXPECT_DOUBLE_EQ(travel_.metres(), -0.1) << "the motor is mounted the other way round";
}

TEST_F(QuickSilverTravelTest, GoesOnAcrossTheWrapBothWays) {
  EXPECT_EQ(take_after_tenth(kHighest - 49), Verdict::believed);
  EXPECT_EQ(take_after_tenth(kLowest + 50), Verdict::believed);
  EXPECT_DOUBLE_EQ(travel_.metres(), 0.1);
  EXPECT_EQ(take_after_tenth(kHighest - 99), Verdict::believed);
  EXPECT_DOUBLE_EQ(travel_.metres(), -0.05);
}

// 3 000 000 000 counts a turn round the 32 bits and more.
TEST_F(QuickSilverTravelTest, GoesOnBeyond32Bits) {
  travel_.start(0.001, 1e6);
  std::uint32_t position = 5;
  ASSERT_EQ(take_after_tenth(static_cast<std::int32_t>(position)), Verdict::believed);
  for (int i = 0; i < 100; ++i) {
    position += 100'000'000U;
    ASSERT_EQ(take_after_tenth(static_cast<std::int32_t>(position)), Verdict::believed);
  }
  EXPECT_DOUBLE_EQ(travel_.metres(), 10'000'000.0);
}

TEST_F(QuickSilverTravelTest, DamageOnTheLineCostsNothing) {
  EXPECT_EQ(take_after_tenth(10'000), Verdict::believed);
  EXPECT_EQ(take_after_tenth(10'201), Verdict::doubted) << "200 are possible";
  EXPECT_EQ(travel_.metres(), 0);
  EXPECT_EQ(take_after_tenth(10'100), Verdict::believed);
  EXPECT_DOUBLE_EQ(travel_.metres(), 0.1);
  EXPECT_EQ(take_after_tenth(10'300), Verdict::believed);
  EXPECT_EQ(take_after_tenth(-2'000'000), Verdict::doubted);
  EXPECT_EQ(take_after_tenth(2'000'000), Verdict::doubted) << "two that do not agree with each other either";
  EXPECT_EQ(take_after_tenth(10'310), Verdict::believed);
  EXPECT_DOUBLE_EQ(travel_.metres(), 0.31);
}

TEST_F(QuickSilverTravelTest, ADriveThatStartsAnewIsFollowedFromThere) {
  EXPECT_EQ(take_after_tenth(50'000), Verdict::believed);
  EXPECT_EQ(take_after_tenth(50'100), Verdict::believed);
  EXPECT_EQ(take_after_tenth(3), Verdict::doubted);
  EXPECT_EQ(take_after_tenth(13), Verdict::restarted);
  EXPECT_DOUBLE_EQ(travel_.metres(), 0.11);
  EXPECT_EQ(take_after_tenth(23), Verdict::believed);
  EXPECT_DOUBLE_EQ(travel_.metres(), 0.12);
}

TEST_F(QuickSilverTravelTest, ALongPauseAllowsALongWay) {
  EXPECT_EQ(travel_.take(0, 0), Verdict::believed);
  EXPECT_EQ(travel_.take(15'000, 10 * kSecond), Verdict::believed);
  EXPECT_EQ(travel_.take(30'051, 20 * kSecond), Verdict::doubted);
  EXPECT_DOUBLE_EQ(travel_.metres(), 15);
}

TEST_F(QuickSilverTravelTest, APauseLongerThanTheLongestAllowsNoMore) {
  travel_.start(0.001, 1.0, kSecond);
  EXPECT_EQ(travel_.take(0, 0), Verdict::believed);
  EXPECT_EQ(travel_.take(1'550, 10 * kSecond), Verdict::believed);
  EXPECT_EQ(travel_.take(3'101, 40 * kSecond), Verdict::doubted);
  EXPECT_DOUBLE_EQ(travel_.metres(), 1.55);
}

TEST_F(QuickSilverTravelTest, ARebaseAddsNoWay) {
  EXPECT_FALSE(travel_.has_position());
  EXPECT_EQ(take_after_tenth(50'000), Verdict::believed);
  EXPECT_TRUE(travel_.has_position());
  EXPECT_EQ(take_after_tenth(50'100), Verdict::believed);
  travel_.rebase();
  EXPECT_FALSE(travel_.has_position());
  EXPECT_EQ(take_after_tenth(3), Verdict::believed);
  EXPECT_DOUBLE_EQ(travel_.metres(), 0.1);
  EXPECT_EQ(take_after_tenth(53), Verdict::believed);
  EXPECT_DOUBLE_EQ(travel_.metres(), 0.15);
}

}  // namespace
}  // namespace lakshya

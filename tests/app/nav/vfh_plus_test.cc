#include "app/nav/vfh_plus.h"

#include <gtest/gtest.h>

#include <initializer_list>

#include "app/core/image.h"
#include "kernels/base/units.h"

namespace lakshya {
namespace {

SectorMask sectors(std::initializer_list<int> list) {
  SectorMask mask{};
  for (const int k : list)
    mask[sector_index(k)] = true;
  return mask;
}

SectorMask span(int first, int last) {
  SectorMask mask{};
  for (int k = first; k <= last; ++k)
    mask[sector_index(k)] = true;
  return mask;
}

SectorMask both(const SectorMask& a, const SectorMask& b) {
  SectorMask mask{};
  for (std::size_t k = 0; k < mask.size(); ++k)
    mask[k] = a[k] || b[k];
  return mask;
}

SectorMask inverse(const SectorMask& a) {
  SectorMask mask{};
  for (std::size_t k = 0; k < mask.size(); ++k)
    mask[k] = !a[k];
  return mask;
}

TEST(BinaryHistogram, HysteresisBetweenTheThresholds) {
  PolarHistogram histogram{};
  histogram[0] = 121;
  histogram[1] = histogram[2] = 120;
  histogram[3] = histogram[4] = 80;
  histogram[5] = 79;
  const SectorMask before = sectors({2, 4, 5, 6});
  EXPECT_EQ(binary_histogram(histogram, before, 80, 120), sectors({0, 2, 4}));
  EXPECT_EQ(binary_histogram(histogram, {}, 80, 120), sectors({0}));
}

TEST(BinaryHistogram, LargeSumsAreAboveTheThreshold) {
  PolarHistogram histogram{};
  histogram[7] = 4'000'000'000U;
  EXPECT_EQ(binary_histogram(histogram, {}, 80, 120), sectors({7}));
}

TEST(TurnWithVehicle, ALeftTurnMovesObstaclesToTheRight) {
  BinaryHistogram binary{.blocked = sectors({0, 10})};
  turn_with_vehicle(binary, radians(10));
  EXPECT_EQ(binary.blocked, sectors({-2, 8}));
  turn_with_vehicle(binary, radians(-25));
  EXPECT_EQ(binary.blocked, sectors({3, 13}));
}

TEST(TurnWithVehicle, TheRemainderIsCarried) {
  BinaryHistogram binary{.blocked = sectors({20})};
  for (int i = 0; i < 30; ++i)
    turn_with_vehicle(binary, radians(2));
  EXPECT_EQ(binary.blocked, sectors({8}));
  EXPECT_NEAR(binary.turned, 0, 1e-9);
  turn_with_vehicle(binary, radians(2));
  EXPECT_EQ(binary.blocked, sectors({8}));
  turn_with_vehicle(binary, radians(1));
  EXPECT_EQ(binary.blocked, sectors({7}));
  EXPECT_NEAR(binary.turned, radians(-2), 1e-9);
}

TEST(TurnWithVehicle, AFullTurnChangesNothing) {
  BinaryHistogram binary{.blocked = sectors({3, 40, 71})};
  for (int i = 0; i < 7; ++i)
    turn_with_vehicle(binary, radians(360.0 / 7));
  EXPECT_EQ(binary.blocked, sectors({3, 40, 71}));
}

class TurningCirclesTest : public ::testing::Test {
 protected:
  SectorMask mask(const TurningCircles& circles) const {
    return mask_turning_circles({}, type_.view(), geometry_, circles);
  }
  void obstacle(int r, int c) { type_.view().at(c, r) = kCellObstacle; }

  GridGeometry geometry_{.rows = 40, .cols = 41, .cell_mm = 100};
  Image<std::uint8_t> type_{41, 40, kCellUnoccupied};
  TurningCircles circles_{.radius_m = 1.0, .enlargement_m = 0.3, .active_radius_m = 5};
};

TEST_F(TurningCirclesTest, AnObstacleInTheLeftCircleBlocksFromItsBearingOutward) {
  obstacle(9, 14);  // 0.95 ahead, 0.6 left: 32.3 deg, 1.03 from (0, 1)
  EXPECT_EQ(mask(circles_), span(6, 36));
}

TEST_F(TurningCirclesTest, AndInTheRightCircleTheMirrorImage) {
  obstacle(9, 26);
  EXPECT_EQ(mask(circles_), span(36, 66));
}

TEST_F(TurningCirclesTest, TheNearestBearingCounts) {
  obstacle(9, 14);
  obstacle(9, 17);  // 0.3 left: 17.5 deg, 1.18 from (0, 1)
  obstacle(2, 26);
  EXPECT_EQ(mask(circles_), both(span(4, 36), span(36, 72 - 13)));  // -67.4 deg
}

TEST_F(TurningCirclesTest, OutsideTheCircleNothingIsBlocked) {
  obstacle(13, 14);  // 1.35 ahead, 0.6 left: 1.41 from (0, 1)
  obstacle(15, 26);
  EXPECT_EQ(mask(circles_), SectorMask{});
  circles_.enlargement_m = 0.5;
  EXPECT_EQ(mask(circles_), span(5, 36));  // 24 deg
}

TEST_F(TurningCirclesTest, StraightAheadCountsForBothSides) {
  obstacle(7, 20);  // 0.75 ahead: 1.25 from both centres
  EXPECT_EQ(mask(circles_), inverse({}));
}

TEST_F(TurningCirclesTest, WithoutARadiusOrBeyondTheActiveRadiusNothingIsMasked) {
  obstacle(9, 14);
  circles_.active_radius_m = 1.0;
  EXPECT_EQ(mask(circles_), SectorMask{});
  circles_ = {.radius_m = 0, .enlargement_m = 5, .active_radius_m = 5};
  EXPECT_EQ(mask(circles_), SectorMask{});
}

TEST_F(TurningCirclesTest, KeepsWhatIsBlockedAlready) {
  obstacle(9, 14);
  EXPECT_EQ(mask_turning_circles(sectors({2, 50}), type_.view(), geometry_, circles_),
            both(sectors({2, 50}), span(6, 36)));
}

TEST(Openings, RunsWithTheirBorders) {
  // Seen from -50 to 50 deg; blocked at -10 and 0 deg.
  const SectorMask blocked = sectors({-2, 0});
  SectorMask selectable = span(-10, 10);
  selectable[sector_index(-2)] = selectable[0] = false;
  const Openings openings = find_openings(selectable, blocked);
  ASSERT_EQ(openings.count, 3);
  const auto items = openings.view();
  EXPECT_EQ(items[0].first, 62);
  EXPECT_EQ(items[0].count, 8);
  EXPECT_EQ(items[0].right, Border::view);
  EXPECT_EQ(items[0].left, Border::obstacle);
  EXPECT_NEAR(degrees(items[0].right_edge()), -52.5, 1e-9);
  EXPECT_NEAR(degrees(items[0].left_edge()), -12.5, 1e-9);
  EXPECT_EQ(items[1].first, 71);
  EXPECT_EQ(items[1].count, 1);
  EXPECT_EQ(items[1].right, Border::obstacle);
  EXPECT_EQ(items[1].left, Border::obstacle);
  EXPECT_EQ(items[2].first, 1);
  EXPECT_EQ(items[2].count, 10);
  EXPECT_EQ(items[2].right, Border::obstacle);
  EXPECT_EQ(items[2].left, Border::view);
}

TEST(Openings, NoneAllAndTheGreatestNumber) {
  EXPECT_EQ(find_openings({}, {}).count, 0);

  const Openings all = find_openings(span(0, 71), {});
  ASSERT_EQ(all.count, 1);
  EXPECT_EQ(all.items[0].count, kPolarSectors);

  SectorMask alternate{};
  for (int k = 0; k < kPolarSectors; k += 2)
    alternate[sector_index(k)] = true;
  EXPECT_EQ(find_openings(alternate, inverse(alternate)).count, 36);
}

TEST(Openings, OneThatRunsThroughBehindStaysWhole) {
  const Openings openings = find_openings(span(30, 40), inverse(span(30, 40)));
  ASSERT_EQ(openings.count, 1);
  EXPECT_EQ(openings.items[0].first, 30);
  EXPECT_EQ(openings.items[0].count, 11);
  EXPECT_NEAR(degrees(openings.items[0].left_edge()), -157.5, 1e-9);
}

constexpr DirectionCosts kCosts{};

// The choice in degrees when everything else is blocked by obstacles.
double choose_between_obstacles(const SectorMask& free, double target_deg, double heading_deg = 0) {
  const auto chosen = choose_direction(find_openings(free, inverse(free)), free,
                                       {.target = radians(target_deg), .heading = radians(heading_deg)}, kCosts);
  EXPECT_TRUE(chosen.has_value());
  return degrees(chosen.value_or(1e3));
}

double choose_in_view(const SectorMask& free, double target_deg) {
  const auto chosen = choose_direction(find_openings(free, {}), free, {.target = radians(target_deg)}, kCosts);
  EXPECT_TRUE(chosen.has_value());
  return degrees(chosen.value_or(1e3));
}

TEST(ChooseDirection, NarrowOpeningGivesItsCentre) {
  EXPECT_NEAR(choose_between_obstacles(span(4, 10), 0), 35, 1e-9);
  EXPECT_NEAR(choose_between_obstacles(span(4, 10), 45), 35, 1e-9);
  EXPECT_NEAR(choose_between_obstacles(span(4, 9), 0), 32.5, 1e-9);
  EXPECT_NEAR(choose_between_obstacles(span(-9, -4), 0), -32.5, 1e-9);
  EXPECT_NEAR(choose_between_obstacles(sectors({3}), 14), 15, 1e-9);
}

TEST(ChooseDirection, WideOpeningGivesBothOffsetsAndTheTarget) {
  // 0 to 100 deg: candidates 40 and 60 deg.
  EXPECT_NEAR(choose_between_obstacles(span(0, 20), -20), 40, 1e-9);
  EXPECT_NEAR(choose_between_obstacles(span(0, 20), 90), 60, 1e-9);
  EXPECT_NEAR(choose_between_obstacles(span(0, 20), 51.3), 51.3, 1e-9);
  EXPECT_NEAR(choose_between_obstacles(span(0, 20), 39), 40, 1e-9);
}

TEST(ChooseDirection, NarrowAndWideMeet) {
  // 17 sectors, 80 deg between the outer centres: 8 sectors from each side is the centre too.
  EXPECT_NEAR(choose_between_obstacles(span(-8, 8), 20), 0, 1e-9);
  EXPECT_NEAR(choose_between_obstacles(span(-9, 9), 20), 5, 1e-9);
}

TEST(ChooseDirection, AtTheBorderOfTheViewNothingIsKeptAwayFrom) {
  EXPECT_NEAR(choose_in_view(span(-6, 6), 25), 25, 1e-9);
  EXPECT_NEAR(choose_in_view(span(-6, 6), 31.7), 31.7, 1e-9);  // still inside the last sector
  EXPECT_NEAR(choose_in_view(span(-6, 6), 33), 30, 1e-9);      // outside: the last centre
  EXPECT_NEAR(choose_in_view(span(-6, 6), -120), -30, 1e-9);
}

TEST(ChooseDirection, OneSideObstacleOneSideView) {
  // 0 to 50 deg, obstacle on the right: 25 deg from it.
  const SectorMask free = span(0, 10);
  const Openings openings = find_openings(free, sectors({-1}));
  const auto choose = [&](double deg) {
    return degrees(choose_direction(openings, free, {.target = radians(deg)}, kCosts).value_or(1e3));
  };
  EXPECT_NEAR(choose(0), 25, 1e-9);
  EXPECT_NEAR(choose(24), 25, 1e-9);
  EXPECT_NEAR(choose(40), 40, 1e-9);
  EXPECT_NEAR(choose(52), 52, 1e-9);
  EXPECT_NEAR(choose(60), 50, 1e-9);
}

TEST(ChooseDirection, LeastCostOfTwoGaps) {
  const SectorMask free = both(span(3, 5), span(-7, -5));  // centres 20 and -30 deg
  EXPECT_NEAR(choose_between_obstacles(free, 0), 20, 1e-9);
  // Target -10: 5 * 30 + 2 * 20 = 190 against 5 * 20 + 2 * 30 = 160.
  EXPECT_NEAR(choose_between_obstacles(free, -10), -30, 1e-9);
  // Target -6: 5 * 26 + 40 = 170 against 5 * 24 + 60 = 180.
  EXPECT_NEAR(choose_between_obstacles(free, -6), 20, 1e-9);
  // Heading -30 as well: 5 * 26 + 2 * 50 = 230 against 120.
  EXPECT_NEAR(choose_between_obstacles(free, -6, -30), -30, 1e-9);
}

TEST(ChooseDirection, ThePreviousChoiceIsKeptWhenTheCostsAreClose) {
  const SectorMask free = both(span(3, 5), span(-5, -3));  // centres 20 and -20 deg
  const Openings openings = find_openings(free, inverse(free));
  Wishes wishes{.target = radians(2)};
  // 5 * 18 + 40 = 130 against 5 * 22 + 40 = 150; previous -20 adds 80 to the left one.
  EXPECT_NEAR(degrees(choose_direction(openings, free, wishes, kCosts).value_or(0)), 20, 1e-9);
  wishes.previous = radians(-20);
  EXPECT_NEAR(degrees(choose_direction(openings, free, wishes, kCosts).value_or(0)), -20, 1e-9);
}

TEST(ChooseDirection, EqualCostsGoNearerTheTargetThenLeft) {
  EXPECT_NEAR(choose_between_obstacles(both(span(3, 5), span(-5, -3)), 0), 20, 1e-9);
  EXPECT_NEAR(choose_between_obstacles(both(span(3, 5), span(-5, -3)), 180), 20, 1e-9);

  // Target and heading weigh the same: every candidate between 0 and 40 deg costs the same.
  const SectorMask free = both(sectors({2}), sectors({6}));
  const auto chosen = choose_direction(find_openings(free, inverse(free)), free,
                                       {.target = radians(40), .heading = 0}, {.target = 2, .heading = 2});
  EXPECT_NEAR(degrees(chosen.value_or(0)), 30, 1e-9);
}

TEST(ChooseDirection, NoOpeningNoDirection) {
  EXPECT_FALSE(choose_direction({}, {}, {.target = 0.3}, kCosts).has_value());
}

TEST(ChooseDirection, EverythingSelectable) {
  EXPECT_NEAR(choose_in_view(span(0, 71), 170), 170, 1e-9);
  EXPECT_NEAR(choose_in_view(span(0, 71), -179), -179, 1e-9);
}

TEST(MoreOpenSide, CountsSectorsThatAreSeenAndFree) {
  const SectorMask seen = span(-10, 10);
  const PolarHistogram none{};
  EXPECT_EQ(more_open_side(span(-3, 9), seen, none), Side::right);
  EXPECT_EQ(more_open_side(span(-9, 3), seen, none), Side::left);
  EXPECT_EQ(more_open_side(span(-10, 10), seen, none), Side::left);
}

TEST(MoreOpenSide, ThenTheLighterSide) {
  PolarHistogram histogram{};
  histogram[5] = 10;
  EXPECT_EQ(more_open_side(span(-10, 10), span(-10, 10), histogram), Side::right);
  histogram[sector_index(-7)] = 11;
  EXPECT_EQ(more_open_side(span(-10, 10), span(-10, 10), histogram), Side::left);
  histogram[0] = histogram[36] = 99;
  EXPECT_EQ(more_open_side(span(-10, 10), span(-10, 10), histogram), Side::left);
}

}  // namespace
}  // namespace lakshya

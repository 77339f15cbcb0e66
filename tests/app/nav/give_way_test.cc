#include "app/nav/give_way.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lakshya {
namespace {

const VehicleParams kVehicle{.radius_m = 0.35, .max_speed_mps = 1.0};

GiveWay asked(const std::vector<Mover>& movers, const Intention& intention) {
  return give_way(kVehicle, movers, {}, intention);
}

TEST(GiveWay, NobodyThere) {
  const GiveWay allowed = asked({}, {.now_mps = 0.5, .speed_mps = 0.8});
  EXPECT_EQ(allowed.speed_mps, 0.8);
  EXPECT_FALSE(allowed.stands);
}

TEST(GiveWay, WhoIsFarAwayOrHasPassedDoesNotMatter) {
  EXPECT_EQ(asked({{.east_m = 6, .north_mps = 1}}, {.now_mps = 0.5, .speed_mps = 0.8}).speed_mps, 0.8);
  EXPECT_EQ(asked({{.east_m = -3, .east_mps = -1}}, {.now_mps = 0.5, .speed_mps = 0.8}).speed_mps, 0.8);
}

TEST(GiveWay, SlowsDownForWhoCrosses) {
  const GiveWay allowed =
      asked({{.east_m = 1.8, .north_m = -1.3, .north_mps = 0.8}}, {.now_mps = 0.8, .speed_mps = 0.8});
  EXPECT_LT(allowed.speed_mps, 0.8);
  EXPECT_FALSE(allowed.stands);
}

TEST(GiveWay, StandsForWhoComes) {
  const GiveWay allowed =
      asked({{.east_m = 1.5, .east_mps = -0.8}}, {.now_mps = 0, .speed_mps = 0, .direction = 1.5});
  EXPECT_EQ(allowed.speed_mps, 0);
  EXPECT_TRUE(allowed.stands);
}

TEST(GiveWay, WhoMayTurnRoundIsGivenRoom) {
  const std::vector<Mover> leaves{{.east_m = 1.2, .east_mps = 0.8}};
  EXPECT_TRUE(asked(leaves, {.now_mps = 0, .speed_mps = 0.5}).stands);
  EXPECT_FALSE(asked(leaves, {.now_mps = 0, .speed_mps = 0.5, .hurries = true}).stands);
}

// He walked to the left when he was last seen, 1.5 s ago; if he has turned round he is right before the vehicle now.
TEST(GiveWay, WhoIsOutOfViewMayHaveTurnedRound) {
  const Mover left{.east_m = 1.4, .north_m = 2.4, .north_mps = 0.8, .unseen_s = 1.5};
  Mover seen = left;
  seen.unseen_s = 0;
  const Intention goes_on{.now_mps = 0.5, .speed_mps = 0.8};
  EXPECT_EQ(asked({seen}, goes_on).speed_mps, 0.8);
  EXPECT_LT(asked({left}, goes_on).speed_mps, 0.8);
}

TEST(GiveWay, APlanWithoutAWayDoesNotTurnEither) {
  Plan plan;
  plan.turn_rate_rps = 0.5;
  Patience patience;
  const std::vector<Mover> comes{{.east_m = 1.2, .east_mps = -0.8}};
  limit_plan(kVehicle, comes, {}, 0, patience, plan);
  EXPECT_TRUE(plan.yields);
  EXPECT_EQ(plan.turn_rate_rps, 0);
  EXPECT_EQ(plan.wheels.left_mps, 0);
}

TEST(GiveWay, NobodyIsWaitedForForEver) {
  const std::vector<Mover> stays{{.east_m = 1.3, .east_mps = 0.6}};
  Patience patience;
  int plans = 0;
  for (; plans < 200; ++plans) {
    Plan plan;
    plan.blocked = false;
    plan.speed_mps = 0.5;
    plan.direction = 1.5;
    limit_plan(kVehicle, stays, {}, 0, patience, plan);
    if (!plan.yields) break;
  }
  EXPECT_GT(plans, 10);
  EXPECT_LE(plans, Patience::kWaits + 2);
}

// One who walks to and fro across the vehicle's way, once a second and a half, at 0.9 m/s: it gets by without being touched while it moves.
TEST(GiveWay, GetsByOneWhoWalksToAndFro) {
  for (int start = 0; start < 40; ++start) {
    double x = 0;
    double v = 0;
    Patience patience;
    int steps = 0;
    for (; steps < 600 && x < 5; ++steps) {
      const double t = 0.1 * (steps + start);
      const double along = std::fmod(0.9 * t, 8.0);
      const double sense = along < 4 ? 1 : -1;
      const double north = along < 4 ? along - 2 : 6 - along;
      Plan plan;
      plan.blocked = false;
      plan.speed_mps = 0.8;
      const std::vector<Mover> walker{{.east_m = 2.5, .north_m = north, .north_mps = 0.9 * sense}};
      limit_plan(kVehicle, walker, {.east_m = x}, v, patience, plan);
      v += std::clamp(plan.speed_mps - v, -0.2, 0.1);
      x += 0.1 * v;
      if (v > 0.02) {
        ASSERT_GT(std::hypot(2.5 - x, north), 0.65) << "start " << start << " at " << x;
      }
    }
    EXPECT_GE(x, 5) << "start " << start;
  }
}

}  // namespace
}  // namespace lakshya

// What the planner makes of a way that was found: docs/contract.md section 5.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/nav/planner.h"
#include "app/nav/speed_governor.h"
#include "tests/support/planner_trial.h"

namespace lakshya {
namespace {

using test::Trial;

constexpr double kOpen = 100;  // m

class PlannerRouteTest : public testing::Test {
 protected:
  PlannerRouteTest() { trial_.params.name = "route"; }

  Plan plan(const RouteAim& aim) {
    PlanInput input;
    input.route = aim;
    return trial_.fresh(input);
  }

  Trial trial_;
};

TEST_F(PlannerRouteTest, GoesWhereTheWayLeadsWhateverTheMapShows) {
  trial_.rows(3, 5, kCellObstacle);
  const Plan plan = this->plan({.found = true, .direction = radians(20), .clear_m = kOpen, .swept_m = kOpen});
  EXPECT_FALSE(plan.blocked);
  EXPECT_NEAR(plan.direction, radians(20), 1e-12);
  EXPECT_GT(plan.speed_mps, 0);
  EXPECT_TRUE(this->plan({.found = false}).blocked);
}

TEST_F(PlannerRouteTest, TheLeastOfWhatIsClearDecides) {
  RouteAim aim{.found = true, .clear_m = 3, .swept_m = kOpen};
  const double clear = plan(aim).speed_mps;
  aim.clear_m = kOpen;
  aim.swept_m = 3;
  EXPECT_EQ(plan(aim).speed_mps, clear);
  EXPECT_GT(clear, 0);
  aim.swept_m = kOpen;
  EXPECT_GT(plan(aim).speed_mps, clear);
}

// It must not be carried past the point where the way bends.
TEST_F(PlannerRouteTest, OnItsArcItMeetsThePointThatItAimsAt) {
  trial_.vehicle.max_speed_mps = 5;
  for (const double straight_m : {0.2, 0.5, 1.2}) {
    for (const double direction : {radians(-40), radians(10), radians(40)}) {
      const Plan plan = this->plan(
          {.found = true, .direction = direction, .straight_m = straight_m, .clear_m = kOpen, .swept_m = kOpen});
      ASSERT_GT(plan.speed_mps, 0);
      // The circle through the vehicle, along its heading, and the point: chord = 2 r sin(direction).
      const double radius_m = straight_m / (2 * std::sin(std::abs(direction)));
      EXPECT_LE(plan.speed_mps / std::abs(plan.turn_rate_rps), radius_m + 1e-9) << straight_m << ' ' << direction;
    }
  }
  const Plan ahead = plan({.found = true, .straight_m = 0.1, .clear_m = kOpen, .swept_m = kOpen});
  EXPECT_GT(ahead.speed_mps, 2);
}

}  // namespace
}  // namespace lakshya

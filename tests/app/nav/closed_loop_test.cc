// Rolling map and planner drive among discs: nobody is touched, nearly all arrive.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>

#include "tests/support/disc_world.h"

namespace lakshya {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kWorlds = 20;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr int kWorlds = 20;
#else
constexpr int kWorlds = 200;
#endif
#else
constexpr int kWorlds = 200;
#endif

class ClosedLoop : public ::testing::TestWithParam<const char*> {};

// 200 fields of 10 m x 8 m, each disc 0.98 to 1.75 m from its nearest neighbour, the goal 1.5 m behind them; a vehicle 0.7 m wide
// with 0.1 m of safety distance at up to 1 m/s, a view of 80 degrees and 6 m, blind within 0.7 m.
TEST_P(ClosedLoop, AmongDiscs) {
  int arrived = 0;
  int collided = 0;
  double time_s = 0;
  double way_m = 0;
  double least_gap_m = 1e9;
  for (int world = 0; world < kWorlds; ++world) {
    std::mt19937 random(1000 + static_cast<unsigned>(world));
    test::DiscDrive drive(test::random_discs(random, 10, 8));
    drive.params.name = GetParam();
    const test::DriveResult result = drive.drive({.east_m = 12.5}, 180);
    EXPECT_FALSE(result.collided) << "world " << world << " at " << result.end.east_m << " " << result.end.north_m;
    arrived += result.arrived ? 1 : 0;
    collided += result.collided ? 1 : 0;
    time_s += result.arrived ? result.time_s : 0;
    way_m += result.arrived ? result.way_m : 0;
    least_gap_m = std::min(least_gap_m, result.least_gap_m);
  }
  std::printf("%s: %d of %d arrived, %d collided, mean time %.1f s, mean way %.1f m, least gap %.3f m\n",
              GetParam(), arrived, kWorlds, collided, time_s / std::max(arrived, 1), way_m / std::max(arrived, 1),
              least_gap_m);
  EXPECT_EQ(collided, 0);
  EXPECT_GE(arrived, kWorlds * 97 / 100);
}

INSTANTIATE_TEST_SUITE_P(Planners, ClosedLoop, ::testing::Values("vfh+", "vfh*"));

}  // namespace
}  // namespace lakshya

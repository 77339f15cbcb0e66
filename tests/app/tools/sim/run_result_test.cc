// Lines and sums of campaigns.
#include "app/tools/sim/run_result.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace lakshya::sim {
namespace {

RunResult drive(Ending ending) {
  RunResult r;
  r.world = "random-indoor";
  r.seed = 7;
  r.sensor = "stereo";
  r.ending = ending;
  r.time_s = 20;
  r.path_m = 11;
  r.shortest_m = 10;
  r.min_clearance_m = 0.25;
  r.mean_speed_mps = 0.55;
  r.frames = 200;
  r.frame_ms_p50 = 4;
  r.frame_ms_p99 = 6;
  return r;
}

RunResult hit(const std::string& kind, const std::string& excuse = "") {
  RunResult r = drive(Ending::collision);
  r.hit = kind + " 1";
  r.hit_kind = kind;
  r.excuse = excuse;
  return r;
}

TEST(RunResult, ALineSaysWhatADriveWas) {
  const auto line = run_json(hit("table"));
  EXPECT_EQ(line["result"], "collision");
  EXPECT_EQ(line["hit"], "table 1");
  EXPECT_TRUE(line["excuse"].is_null());
  const RunResult again = run_from_json(line);
  EXPECT_EQ(run_json(again), line);
  EXPECT_TRUE(again.is_collision());
}

TEST(RunResult, RefusesOtherLines) {
  EXPECT_THROW((void)run_from_json({{"world", "x"}}), std::invalid_argument);
  auto line = run_json(drive(Ending::reached));
  line["result"] = "won";
  EXPECT_THROW((void)run_from_json(line), std::invalid_argument);
}

TEST(RunResult, SumsTellWhatCountsAndWhatIsExcused) {
  const auto sums =
      summary_json({drive(Ending::reached), drive(Ending::reached), hit("table"), hit("glass pane", "glass"),
                    hit("person", "person not in view"), drive(Ending::stuck), drive(Ending::dropoff)});
  EXPECT_EQ(sums["runs"], 7);
  EXPECT_EQ(sums["reached"], 2);
  EXPECT_EQ(sums["collisions"], 1);
  EXPECT_EQ(sums["hits"]["table"], 1);
  EXPECT_EQ(sums["hits"].size(), 1U);
  EXPECT_EQ(sums["excused"]["glass"], 1);
  EXPECT_EQ(sums["excused"]["person not in view"], 1);
  EXPECT_EQ(sums["stuck"], 1);
  EXPECT_EQ(sums["dropoffs"], 1);
  EXPECT_NEAR(sums["path_over_shortest"].get<double>(), 1.1, 1e-9);
}

TEST(RunResult, NoDrivesNoSums) {
  const auto sums = summary_json({});
  EXPECT_EQ(sums["runs"], 0);
  EXPECT_EQ(sums["path_over_shortest"], 0);
}

}  // namespace
}  // namespace lakshya::sim

// What `lakshya bench` computes and draws from its times; the times here are made up.
#include "app/tools/bench_suite.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/tools/bench_report.h"
#include "app/tools/picture_colors.h"

namespace lakshya {
namespace {

using Json = nlohmann::json;

BenchResult made_up(const std::string& isa, int width, int threads, double ms) {
  BenchResult r;
  r.isa = isa;
  r.width = width;
  r.height = 100;
  r.disparities = 64;
  r.threads = threads;
  r.rows.reserve(kBenchRows.size());
  for (const char* name : kBenchRows)
    r.rows.push_back({name, ms, {}, "peer", 3 * ms});
  r.rows[5].peer.clear();
  r.rows[5].peer_ms.reset();
  return r;
}

SuiteResults made_up_suite() {
  SuiteResults results;
  results.processor = "made up";
  results.input = "nothing";
  for (const int threads : {1, 2}) {
    for (const char* isa : {"avx2", "avx3"})
      results.settings.push_back(made_up(isa, 640, threads, 4.0 / threads));
  }
  for (BenchRow& row : results.settings.front().rows)
    row.reference_ms = 40;
  BenchResult frame = made_up("avx2", 1024, 2, 20);
  frame.rows.erase(frame.rows.begin(), frame.rows.end() - 1);
  results.target = {frame};
  for (const int width : {100, 200, 300})
    results.scaling.push_back(made_up("avx2", width, 1, width / 10.0));
  for (const char* isa : {"avx2", "avx3"}) {
    results.kernels.push_back({isa, {"sgm", "sgm", true, 60, 16}, 2, 1e6});
    results.peaks.push_back({isa, 1e11, 5e10, 1e10});
  }
  return results;
}

TEST(BenchMeasure, MedianOfOddAndEvenCounts) {
  EXPECT_EQ(median({3}), 3);
  EXPECT_EQ(median({9, 1, 5}), 5);
  EXPECT_EQ(median({9, 1, 5, 2}), 3.5);
}

TEST(BenchMeasure, TasksTakeTurnsAndTheFirstRoundCountsForNothing) {
  std::string order;
  int calls = 0;
  const BenchTask ours = [&] {
    order += 'a';
    return ++calls == 1 ? 1000.0 : 2.0;
  };
  const BenchTask peer = [&] {
    order += 'b';
    return 7.0;
  };
  EXPECT_EQ(interleaved_medians({ours, peer}, {.rounds = 3}), (std::vector<double>{2, 7}));
  EXPECT_EQ(order, "abababab");
  order.clear();
  (void)interleaved_medians({ours, peer}, {.rounds = 0, .least = 2, .most = 4, .budget_ms = 1e9});
  EXPECT_EQ(order, "ababababab");
}

TEST(BenchSuite, FitsALine) {
  const LineFit exact = fit_line({{1, 5}, {2, 7}, {4, 11}});
  EXPECT_NEAR(exact.slope, 2, 1e-12);
  EXPECT_NEAR(exact.intercept, 3, 1e-12);
  EXPECT_NEAR(exact.r2, 1, 1e-12);
  // By hand: means 1 and 2/3, slope 1/2, intercept 1/6, explained 1/2 of 2/3.
  const LineFit rough = fit_line({{0, 0}, {1, 1}, {2, 1}});
  EXPECT_NEAR(rough.slope, 0.5, 1e-12);
  EXPECT_NEAR(rough.intercept, 1.0 / 6, 1e-12);
  EXPECT_NEAR(rough.r2, 0.75, 1e-12);
  EXPECT_EQ(fit_line({{1, 5}}).slope, 0);
  EXPECT_EQ(fit_line({}).slope, 0);
}

TEST(BenchSuite, TableAndJsonHoldEverySetting) {
  const SuiteResults results = made_up_suite();
  const std::string table = suite_markdown(results);
  EXPECT_NE(table.find("| 640x100 | 64 | 1 | avx2 | 4.00 (3.0x) |"), std::string::npos) << table;
  EXPECT_NE(table.find("| 640x100 | 64 | 2 | avx3 | 2.00 (3.0x) |"), std::string::npos) << table;
  EXPECT_NE(table.find("1024x100, 64 disparities, 2 threads, avx2: 20.0 ms (met)"), std::string::npos) << table;
  EXPECT_NE(table.find("sgm 40.0 ms (10.0x)"), std::string::npos) << table;
  EXPECT_NE(table.find("| avx3 | sgm | 2.00 | 60 | pixel-disparity | 30.0 | 30.0 |"), std::string::npos) << table;

  const Json json = Json::parse(suite_json(results));
  ASSERT_EQ(json["settings"].size(), 4U);
  EXPECT_EQ(json["settings"][0]["rows"][0]["speedup"], 3.0);
  EXPECT_EQ(json["settings"][0]["rows"][0]["ref_ms"], 40.0);
  EXPECT_TRUE(json["settings"][1]["rows"][0]["ref_ms"].is_null());
  EXPECT_TRUE(json["settings"][0]["rows"][5]["speedup"].is_null());
  EXPECT_EQ(json["target"]["results"][0]["rows"][0]["ms"], 20.0);
  // 10 ms for 0.64 million pixel-disparities.
  EXPECT_NEAR(json["scaling"]["fits"][0]["ns_per_pixel_disparity"].get<double>(), 15.625, 1e-9);
}

TEST(BenchSuite, PlotsShowTheirSeries) {
  const SuiteResults results = made_up_suite();
  for (const Image<Rgb8>& plot : {speedup_plot(results), scaling_plot(results), roofline_plot(results)}) {
    std::ptrdiff_t colored = 0;
    for (int v = 0; v < plot.height(); ++v) {
      colored += std::count_if(plot.view().row(v), plot.view().row(v) + plot.width(), [](const Rgb8& c) {
        return std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b}) > 100;
      });
    }
    EXPECT_GT(colored, 300);
    EXPECT_LT(colored, plot.width() * plot.height() / 2);
  }
}

TEST(BenchReport, ThreeDigits) {
  EXPECT_EQ(milliseconds(0.1234), "0.123");
  EXPECT_EQ(milliseconds(1.234), "1.23");
  EXPECT_EQ(milliseconds(12.34), "12.3");
  EXPECT_EQ(milliseconds(1234), "1234");
}

TEST(BenchReport, SaysHowOpencvWasBuilt) {
  const OpencvBuild build = opencv_build();
  EXPECT_NE(build.version, "");
  EXPECT_NE(build.baseline, "not said");
  EXPECT_NE(build.processor, "");
  EXPECT_EQ(build.parallel.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace lakshya

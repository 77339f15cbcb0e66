#include "app/core/stage_times.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "tests/support/count_allocations.h"

namespace lakshya {
namespace {

constexpr double kBucket = 1.0 / 64;  // half a bucket, of the time in it

std::unique_ptr<TimeHistogram> histogram_of(const std::vector<Nanoseconds>& times) {
  auto histogram = std::make_unique<TimeHistogram>();
  for (const Nanoseconds t : times)
    histogram->add(t);
  return histogram;
}

TEST(TimeHistogram, OfNothingEverythingIsZero) {
  const TimeHistogram h;
  EXPECT_EQ(h.count(), 0U);
  EXPECT_EQ(h.max(), 0);
  EXPECT_EQ(h.quantile(500), 0);
}

TEST(TimeHistogram, SmallTimesAreExact) {
  const auto h = histogram_of({3, 1, 63, 2, 5});
  EXPECT_EQ(h->quantile(0), 1);
  EXPECT_EQ(h->quantile(200), 1);
  EXPECT_EQ(h->quantile(201), 2);
  EXPECT_EQ(h->quantile(500), 3);
  EXPECT_EQ(h->quantile(990), 63);
  EXPECT_EQ(h->quantile(1000), 63);
  EXPECT_EQ(h->sum(), 74);
}

TEST(TimeHistogram, EveryTimeComesBackFromItsBucket) {
  for (int bits = 0; bits <= 36; ++bits) {
    const Nanoseconds power = Nanoseconds{1} << bits;
    for (const Nanoseconds t : {power - 1, power, power + 1, power + power / 3, power + power / 2}) {
      const auto h = histogram_of({t, t, t + t});  // the second keeps max() from hiding the bucket's middle
      const auto found = static_cast<double>(h->quantile(500));
      if (t >= Nanoseconds{63} << 30) {
        EXPECT_EQ(found, static_cast<double>(2 * t));  // the last bucket: the maximum is all that is known
      } else {
        EXPECT_LE(std::abs(found - static_cast<double>(t)), kBucket * static_cast<double>(t)) << t;
      }
    }
  }
}

TEST(TimeHistogram, QuantilesOfManyTimesAreThoseOfTheSortedTimes) {
  std::mt19937_64 random(5);
  std::lognormal_distribution<double> spread(17, 1.5);  // about 24 ms, with a long tail
  std::vector<Nanoseconds> times(10'001);
  for (Nanoseconds& t : times)
    t = static_cast<Nanoseconds>(spread(random));
  const auto h = histogram_of(times);
  std::sort(times.begin(), times.end());
  for (const int per_mille : {1, 10, 250, 500, 900, 990, 999}) {
    const auto rank = static_cast<std::size_t>((10'001 * per_mille + 999) / 1000 - 1);
    const auto exact = static_cast<double>(times[rank]);
    EXPECT_NEAR(static_cast<double>(h->quantile(per_mille)), exact, 2 * kBucket * exact) << per_mille;
  }
  EXPECT_EQ(h->max(), times.back());
  EXPECT_LE(h->quantile(1000), h->max());
  EXPECT_EQ(h->count(), times.size());
}

TEST(TimeHistogram, WhatCannotBeIsCountedAtTheEnds) {
  const auto h = histogram_of({-5, Nanoseconds{1} << 62});
  EXPECT_EQ(h->count(), 2U);
  EXPECT_EQ(h->quantile(500), 0);
  EXPECT_EQ(h->quantile(1000), Nanoseconds{1} << 62);
}

FrameTimes frame_of(Nanoseconds start) {
  FrameTimes f;
  Nanoseconds now = start;
  for (std::size_t i = 0; i < f.begin.size(); ++i) {
    f.begin[i] = now;
    f.took[i] = 10 * static_cast<Nanoseconds>(i + 1);
    now += f.took[i] + 1;
  }
  f.match.at = {f.begin[1], f.begin[1] + 4, f.begin[1] + 12, f.begin[1] + 20};
  return f;
}

TEST(StageTimes, AFrameIsCountedInItsStagesAndPasses) {
  const auto times = std::make_unique<StageTimes>();
  times->add(frame_of(1'000'000'007));
  EXPECT_EQ(times->of(Stage::rectify).max(), 10);
  EXPECT_EQ(times->of(Stage::plan).max(), 70);
  EXPECT_EQ(times->frame().max(), 10 + 20 + 30 + 40 + 50 + 60 + 70 + 6);
  EXPECT_EQ(times->of(MatchPass::describe).max(), 4);
  EXPECT_EQ(times->of(MatchPass::search).max(), 8);
  EXPECT_EQ(times->of(MatchPass::support).max(), 8);
}

TEST(StageTimes, CountingTakesNoMemory) {
  const auto times = std::make_unique<StageTimes>();
  const int before = test::allocations;
  for (int i = 0; i < 1000; ++i)
    times->add(frame_of(i));
  const Nanoseconds p99 = times->frame().quantile(990);
  EXPECT_EQ(test::allocations, before);
  EXPECT_GT(p99, 0);
  EXPECT_LE(sizeof(StageTimes), 48U << 10);
}

TEST(StageTimes, EveryStageAndPassHasAName) {
  EXPECT_STREQ(to_string(Stage::rectify), "rectify");
  EXPECT_STREQ(to_string(Stage::plan), "plan");
  EXPECT_STREQ(to_string(MatchPass::describe), "describe");
  EXPECT_STREQ(to_string(MatchPass::support), "support");
}

}  // namespace
}  // namespace lakshya

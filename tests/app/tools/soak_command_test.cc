// The endurance test, tested: it passes on the loop that there is, it is the same for the same seed, and it can fail.
#include "app/tools/soak_command.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "app/core/image_file.h"
#include "app/core/vehicle_config_file.h"
#include "app/tools/soak_report.h"
#include "app/tools/soak_run.h"
#include "tests/support/run_command.h"
#include "tests/support/stereo_pair.h"
#include "tests/support/temp_folder.h"

namespace lakshya {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using enum FaultKind;

// ---- the checker, fed by hand

constexpr Nanoseconds kStart = kSecond;
constexpr Nanoseconds kBegin = 5 * kSecond;

// Control turns every 20 ms about one fault.
class Feed {
 public:
  explicit Feed(const Fault& fault) : checker_(SoakLimits{}, kStart), fault_(fault) {
    drive_until(fault.begin, State::run, true);
  }

  void drive_until(Nanoseconds end, State state, bool turning, double mps = 0) {
    for (; now_ < end; now_ += 20 * kMillisecond) {
      way_m_ += mps * 0.02;
      checker_.turn({now_, state, turning, way_m_, {&fault_, 1}});
    }
  }
  void felt_now() { fault_.felt = now_; }
  void reset() { checker_.reset(now_); }
  const SoakChecker& checker() const { return checker_; }
  const FaultRecord& record() const { return checker_.records()[static_cast<std::size_t>(fault_.kind)]; }
  const SoakViolation& violation() const { return checker_.first_violations().at(0); }

 private:
  SoakChecker checker_;
  Fault fault_;
  Nanoseconds now_ = kStart;
  double way_m_ = 0;
};

Fault fault_of(FaultKind kind, Nanoseconds lasts = kSecond) {
  return {.kind = kind, .number = 1, .begin = kBegin, .end = kBegin + lasts};
}

TEST(SoakChecker, ZeroInTimeAndRunAgain) {
  Feed feed(fault_of(camera_silent));
  feed.drive_until(kBegin + 180 * kMillisecond, State::run, true);
  feed.drive_until(kBegin + kSecond + kSecond / 2, State::stop, false);
  feed.drive_until(kBegin + 4 * kSecond, State::run, true);
  EXPECT_EQ(feed.checker().violations(), 0U);
  EXPECT_EQ(feed.record().times, 1U);
  EXPECT_EQ(feed.record().while_turning, 1U);
  EXPECT_EQ(feed.record().stopped, 1U);
  EXPECT_EQ(feed.record().worst_reaction, 180 * kMillisecond);
  EXPECT_EQ(feed.record().recovered, 1U);
  EXPECT_EQ(feed.record().worst_recovery, 500 * kMillisecond);
}

TEST(SoakChecker, ZeroThatComesLate) {
  Feed feed(fault_of(drive_refused));
  feed.drive_until(kBegin + 240 * kMillisecond, State::run, true);
  feed.drive_until(kBegin + 1500 * kMillisecond, State::stop, false);
  feed.drive_until(kBegin + 2 * kSecond, State::run, true);
  ASSERT_EQ(feed.checker().violations(), 1U);
  EXPECT_EQ(feed.violation().rule, SoakRule::stops_in_time);
  EXPECT_EQ(feed.violation().kind, drive_refused);
  EXPECT_EQ(feed.violation().now, kBegin + 220 * kMillisecond);
  EXPECT_EQ(feed.record().worst_reaction, 240 * kMillisecond);
  EXPECT_EQ(violation_text(feed.violation(), kStart),
            "4.220 s, drive refused, state RUN: the wheels are told to turn 0.220 s after it began");
}

TEST(SoakChecker, ZeroThatDoesNotStay) {
  Feed feed(fault_of(camera_dark));
  feed.drive_until(kBegin + 500 * kMillisecond, State::stop, false);
  feed.drive_until(kBegin + 540 * kMillisecond, State::run, true);
  feed.drive_until(kBegin + kSecond, State::stop, false);
  EXPECT_EQ(feed.checker().violations(), 1U);
}

TEST(SoakChecker, AFaultTooShortToBeNoticed) {
  Feed feed(fault_of(camera_torn, 60 * kMillisecond));
  feed.drive_until(kBegin + 4 * kSecond, State::run, true);
  EXPECT_EQ(feed.checker().violations(), 0U);
  EXPECT_EQ(feed.record().stopped, 0U);
}

TEST(SoakChecker, RunThatDoesNotComeBack) {
  Feed feed(fault_of(compass_gone));
  feed.drive_until(kBegin + 2520 * kMillisecond, State::stop, false);
  EXPECT_EQ(feed.checker().violations(), 0U);
  feed.drive_until(kBegin + 3 * kSecond, State::stop, false);
  ASSERT_EQ(feed.checker().violations(), 1U);
  EXPECT_EQ(feed.violation().rule, SoakRule::recovers);
}

TEST(SoakChecker, AStopWithoutAnyFault) {
  Feed feed(fault_of(camera_silent, 0));
  feed.drive_until(kBegin + 10 * kSecond, State::run, true);
  feed.drive_until(kBegin + 11 * kSecond, State::stop, false);
  EXPECT_EQ(feed.checker().violations(), 1U);
}

TEST(SoakChecker, WhatLatchesWaitsForTheReset) {
  Feed feed(fault_of(emergency_stop, 100 * kMillisecond));
  feed.felt_now();
  feed.drive_until(kBegin + 5 * kSecond, State::fault, false);
  feed.reset();
  feed.drive_until(kBegin + 6 * kSecond, State::run, true);
  EXPECT_EQ(feed.checker().violations(), 0U);
}

TEST(SoakChecker, WhatLatchesAndDoesNotWait) {
  Feed feed(fault_of(compass_tipped, 100 * kMillisecond));
  feed.felt_now();
  feed.drive_until(kBegin + kSecond, State::fault, false);
  feed.drive_until(kBegin + 2 * kSecond, State::run, true);
  ASSERT_EQ(feed.checker().violations(), 1U);
  EXPECT_EQ(feed.violation().rule, SoakRule::waits_for_reset);
}

TEST(SoakChecker, AFrozenCameraCountsFromTheWayThatWasGone) {
  Feed stands(fault_of(camera_frozen, 3 * kSecond));
  stands.felt_now();
  stands.drive_until(kBegin + 3 * kSecond, State::run, true, 0);
  EXPECT_EQ(stands.checker().violations(), 0U);

  Feed moves(fault_of(camera_frozen, 3 * kSecond));
  moves.felt_now();
  moves.drive_until(kBegin + 290 * kMillisecond, State::run, true, 0.1);  // 0.02 m from the first turn: after 0.2 s
  moves.drive_until(kBegin + 3100 * kMillisecond, State::stop, false);
  EXPECT_EQ(moves.checker().violations(), 0U);
  EXPECT_GT(moves.record().worst_reaction, 60 * kMillisecond);
  EXPECT_LE(moves.record().worst_reaction, 100 * kMillisecond);

  Feed late(fault_of(camera_frozen, 3 * kSecond));
  late.felt_now();
  late.drive_until(kBegin + kSecond, State::run, true, 0.1);
  EXPECT_EQ(late.checker().violations(), 1U);
}

// ---- the faults

std::vector<Fault> drawn(std::uint64_t seed, bool can_freeze = true) {
  FaultPlan plan({.seed = seed, .recovery = kSecond, .longest_jump = kSecond, .can_freeze = can_freeze}, kStart);
  std::vector<Fault> list;
  for (Nanoseconds now = kStart; now < 600 * kSecond; now += 20 * kMillisecond) {
    for (const Fault& fault : plan.faults()) {
      if (list.size() < fault.number) list.push_back(fault);
    }
    (void)plan.step(now);
  }
  return list;
}

TEST(FaultPlan, TheSeedDecides) {
  const auto text = [](const std::vector<Fault>& list) {
    std::string all;
    for (const Fault& f : list)
      all += std::string(to_string(f.kind)) + " " + std::to_string(f.begin) + " " + std::to_string(f.end) + "\n";
    return all;
  };
  EXPECT_EQ(text(drawn(7)), text(drawn(7)));
  EXPECT_NE(text(drawn(7)), text(drawn(8)));
}

TEST(FaultPlan, AllKindsComeAndLastAsTheyShould) {
  std::set<FaultKind> kinds;
  int together = 0;
  const std::vector<Fault> list = drawn(3);
  for (std::size_t i = 0; i < list.size(); ++i) {
    kinds.insert(list[i].kind);
    const Nanoseconds lasts = list[i].end - list[i].begin;
    EXPECT_GE(lasts, 50 * kMillisecond);
    EXPECT_LE(lasts, list[i].kind == compass_jumped ? kSecond : 3 * kSecond);
    if (i > 0 && list[i].begin < list[i - 1].end) ++together;
  }
  EXPECT_EQ(kinds.size(), kFaultKinds);
  EXPECT_GT(together, 0);
  for (const Fault& fault : drawn(3, false))
    EXPECT_NE(fault.kind, camera_frozen);
}

// ---- the whole, on a made-up floor

class SoakTest : public ::testing::Test {
 protected:
  static constexpr int kPairs = 5;

  // A floor 0.1 m below the camera: one pixel of disparity more in every row. No two pairs are the same.
  void SetUp() override {
    fs::create_directories(folder_.path("left"));
    fs::create_directories(folder_.path("right"));
    for (int n = 0; n < kPairs; ++n) {
      test::StereoPair pair = test::textured_pair([](int v) { return std::max(v - 59, 0); });
      pair.left.view().at(n, 0) ^= 1U;
      pair.right.view().at(n, 0) ^= 1U;
      const std::string name = "/" + std::to_string(n) + ".png";
      write_png(folder_.path("left") + name, pair.left.view());
      write_png(folder_.path("right") + name, pair.right.view());
    }
    calibration_ = folder_.write("calib.txt", test::StereoRig::middlebury());
  }

  VehicleConfig config() const {
    VehicleConfig config = load_vehicle_config("", "indoor", {kHeight});
    config.folder.path = folder_.path("");
    config.camera.calibration = calibration_;
    config.grid.rows = config.grid.cols = 60;
    config.loop.threads = 1;  // a team that spins, as here, is slow where others work, too
    return soak_config(config);
  }
  SoakResult run(std::uint64_t seed) const {
    return run_soak(config(), {.source = "floor", .config_path = "", .frames = 2000, .seed = seed}, kSimdKernels,
                    nullptr);
  }

  static constexpr const char* kHeight = "camera.height_m=0.1";
  TempFolder folder_;
  std::string calibration_;
};

TEST_F(SoakTest, PassesWithTwoSeedsAndTheSeedDecides) {
  const SoakResult one = run(1);
  EXPECT_EQ(soak_verdict(one).failures, std::vector<std::string>()) << soak_text(one);
  EXPECT_EQ(one.frames, 2000U);
  EXPECT_GT(one.faults, 40U);
  EXPECT_GE(one.samples.size(), 20U);
  EXPECT_EQ(one.pairs, kPairs);
  std::uint64_t stopped = 0;
  for (const FaultRecord& record : one.records) {
    EXPECT_GT(record.times, 0U);
    stopped += record.stopped;
  }
  EXPECT_GT(stopped, one.faults / 4) << soak_text(one);

  EXPECT_EQ(fault_table(run(1)), fault_table(one));

  const SoakResult two = run(2);
  EXPECT_EQ(soak_verdict(two).failures, std::vector<std::string>()) << soak_text(two);
  EXPECT_NE(fault_table(two), fault_table(one));
}

TEST_F(SoakTest, TheCommandSaysAndWritesWhatHappened) {
  const std::string lakshya = lakshya_binary();
  if (lakshya.empty()) GTEST_SKIP() << "LAKSHYA_BIN names no lakshya";
  const std::vector<std::string> words{
      lakshya, "soak",  folder_.path(""), "--calib", calibration_, "--profile",        "indoor",
      "--set", kHeight, "--frames",       "1000",    "--out",      folder_.path("out")};
  const Outcome outcome = run_command(words);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("soak: passed"), std::string::npos);
  EXPECT_NE(outcome.err.find(" left"), std::string::npos) << "progress says how long it takes";
  const Json json = Json::parse(bytes_of(folder_.path("out/soak.json")));
  EXPECT_EQ(json["frames"], 1000);
  EXPECT_EQ(json["faults"].size(), kFaultKinds);
  EXPECT_GE(json["samples"].size(), 20U);
  EXPECT_TRUE(fs::exists(folder_.path("out/soak.png")));

  // A limit that is too long for what is demanded.
  std::vector<std::string> patient = words;
  patient.insert(patient.end(), {"--set", "safety.camera_silent_s=2", "--set", "safety.plan_age_s=5"});
  const Outcome failed = run_command(patient);
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_NE(failed.out.find("FAILED: a safety rule was broken"), std::string::npos) << failed.out;
  EXPECT_NE(failed.out.find("the wheels are told to turn 0.2"), std::string::npos) << failed.out;

  // One thread is another way through OpenMP; the program counts allocations, this test does not.
  std::vector<std::string> alone = words;
  alone.insert(alone.end(), {"--set", "loop.threads=1"});
  const Outcome one_thread = run_command(alone);
  EXPECT_EQ(one_thread.exit_code, 0) << one_thread.out << one_thread.err;

  const Outcome refused = run_command({lakshya, "soak", folder_.path("nowhere")});
  EXPECT_EQ(refused.exit_code, 1);
}

// ---- growth

TEST(SoakVerdict, GrowthIsFound) {
  SoakResult result;
  result.records[0].stopped = 1;
  for (std::uint64_t i = 1; i <= 100; ++i)
    result.samples.push_back({.frames = i, .resident_bytes = 100'000'000, .handles = 7, .p50 = kMillisecond});
  EXPECT_TRUE(soak_verdict(result).failures.empty());

  SoakResult memory = result;
  for (std::size_t i = 0; i < 100; ++i)
    memory.samples[i].resident_bytes += i * 30'000;
  EXPECT_EQ(soak_verdict(memory).failures.size(), 1U);

  SoakResult handles = result;
  handles.samples.back().handles = 8;
  EXPECT_EQ(soak_verdict(handles).failures.size(), 1U);

  SoakResult allocations = result;
  allocations.samples[50].allocations = 1;
  EXPECT_EQ(soak_verdict(allocations).failures.size(), 1U);

  SoakResult slower = result;
  for (std::size_t i = 80; i < 100; ++i)
    slower.samples[i].p50 = 2 * kMillisecond;
  EXPECT_TRUE(soak_verdict(slower).failures.empty());
  EXPECT_EQ(soak_verdict(slower).warnings.size(), 1U);
}

}  // namespace
}  // namespace lakshya

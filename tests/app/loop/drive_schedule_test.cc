#include "app/loop/drive_schedule.h"

#include <gtest/gtest.h>

#include <string>

namespace lakshya {
namespace {

constexpr Nanoseconds kPeriod = 20 * kMillisecond;

// What the turns did: c a command, r a reading, b both, - neither. Each exchange takes as long as it is told to.
std::string turns(DriveSchedule& schedule, int count, Nanoseconds command, Nanoseconds read, bool urgent = false) {
  std::string done;
  for (int i = 0; i < count; ++i) {
    schedule.begin(urgent);
    if (schedule.commands()) schedule.commanded(command);
    if (schedule.reads()) schedule.has_read(read);
    done += schedule.commands() ? (schedule.reads() ? 'b' : 'c') : (schedule.reads() ? 'r' : '-');
  }
  return done;
}

TEST(DriveSchedule, BothInEveryTurnWhereTheyFit) {
  DriveSchedule schedule(kPeriod);
  EXPECT_EQ(turns(schedule, 8, 9 * kMillisecond, 9 * kMillisecond), "bbbbbbbb");  // 18 of 20: a tenth is left
}

TEST(DriveSchedule, InTurnWhereTheyDoNotFit) {
  DriveSchedule schedule(kPeriod);
  // The first turn cannot know.
  EXPECT_EQ(turns(schedule, 9, 9 * kMillisecond, 9 * kMillisecond + 1), "bcrcrcrcr");
}

TEST(DriveSchedule, AnUrgentCommandIsAlwaysGiven) {
  for (const Nanoseconds took : {kMillisecond, 15 * kMillisecond}) {
    for (int before = 0; before < 4; ++before) {
      DriveSchedule schedule(kPeriod);
      (void)turns(schedule, before, took, took);
      EXPECT_EQ(turns(schedule, 3, took, took, true), "ccc") << took << ", after " << before;
    }
  }
}

TEST(DriveSchedule, AfterAnUrgentCommandTheTravelIsReadFirst) {
  DriveSchedule schedule(kPeriod);
  (void)turns(schedule, 5, 15 * kMillisecond, 15 * kMillisecond);
  (void)turns(schedule, 2, 15 * kMillisecond, 15 * kMillisecond, true);
  EXPECT_EQ(turns(schedule, 4, 15 * kMillisecond, 15 * kMillisecond), "rcrc");
}

TEST(DriveSchedule, OneSlowExchangeIsForgottenWithinSeconds) {
  DriveSchedule schedule(kPeriod);
  EXPECT_EQ(turns(schedule, 1, 25 * kMillisecond, 2 * kMillisecond), "b");
  const std::string after = turns(schedule, 500, 2 * kMillisecond, 2 * kMillisecond);
  EXPECT_EQ(after.substr(0, 6), "crcrcr");
  const std::size_t both = after.find('b');
  ASSERT_NE(both, std::string::npos);
  EXPECT_GT(both, 20U);   // not at once
  EXPECT_LT(both, 250U);  // 5 s
  EXPECT_EQ(after.find_first_not_of('b', both), std::string::npos);
}

}  // namespace
}  // namespace lakshya

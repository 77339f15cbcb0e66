#include "hal/odometry/wheel_odometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace lakshya {
namespace {

constexpr double kPi = std::numbers::pi;

class WheelOdometryTest : public testing::Test {
 protected:
  // Both wheels turn evenly for `seconds`, read every 20 ms.
  void run(WheelOdometry& odometry, double left_mps, double right_mps, double seconds) {
    const int steps = static_cast<int>(std::lround(seconds * 50));
    for (int i = 0; i < steps; ++i) {
      travel_.left_m += left_mps / 50;
      travel_.right_m += right_mps / 50;
      travel_.time += 20 * kMillisecond;
      ASSERT_EQ(odometry.add(travel_), Status::ok);
    }
  }

  PoseSample pose(const WheelOdometry& odometry) {
    PoseSample sample;
    EXPECT_EQ(odometry.pose(sample), Status::ok);
    return sample;
  }

  WheelTravel travel_{.left_m = 5, .right_m = -3, .time = kSecond};  // counts from wherever the drives were
};

TEST_F(WheelOdometryTest, StraightOnIsEast) {
  WheelOdometry odometry({.track_m = 0.5});
  ASSERT_EQ(odometry.add(travel_), Status::ok);
  run(odometry, 0.5, 0.5, 4);
  const PoseSample p = pose(odometry);
  EXPECT_NEAR(p.east_m, 2, 1e-9);
  EXPECT_NEAR(p.north_m, 0, 1e-9);
  EXPECT_NEAR(p.yaw, 0, 1e-9);
  EXPECT_EQ(p.time, travel_.time);
}

TEST_F(WheelOdometryTest, AQuarterCircleToTheLeftIsExactWhateverTheSteps) {
  // Radius 1 m, track 0.5 m: the wheels go pi/2 * 0.75 and pi/2 * 1.25 m.
  WheelOdometry fine({.track_m = 0.5});
  ASSERT_EQ(fine.add(travel_), Status::ok);
  WheelOdometry coarse({.track_m = 0.5});
  ASSERT_EQ(coarse.add(travel_), Status::ok);
  run(fine, kPi / 2 * 0.75, kPi / 2 * 1.25, 1);
  ASSERT_EQ(coarse.add(travel_), Status::ok);
  for (const WheelOdometry* odometry : {&fine, &coarse}) {
    const PoseSample p = pose(*odometry);
    EXPECT_NEAR(p.east_m, 1, 1e-9);
    EXPECT_NEAR(p.north_m, 1, 1e-9);
    EXPECT_NEAR(p.yaw, kPi / 2, 1e-9);
  }
}

TEST_F(WheelOdometryTest, OnTheSpotTurnsAndYawStaysInItsRange) {
  WheelOdometry odometry({.track_m = 0.5});
  ASSERT_EQ(odometry.add(travel_), Status::ok);
  run(odometry, -0.25 * kPi, 0.25 * kPi, 1.5);  // 1.5 pi to the left
  const PoseSample p = pose(odometry);
  EXPECT_NEAR(p.east_m, 0, 1e-9);
  EXPECT_NEAR(p.yaw, -kPi / 2, 1e-9);
}

TEST_F(WheelOdometryTest, TheFirstHeadingIsWhereTheVehiclePoints) {
  WheelOdometry odometry({.track_m = 0.5, .has_compass = true});
  PoseSample p;
  ASSERT_EQ(odometry.add(travel_), Status::ok);
  EXPECT_EQ(odometry.pose(p), Status::timeout);
  run(odometry, 1, 1, 1);  // in a direction that nobody knows
  EXPECT_EQ(odometry.pose(p), Status::timeout);
  ASSERT_EQ(odometry.add(HeadingSample{.yaw = kPi / 2, .time = travel_.time}), Status::ok);
  run(odometry, 1, 1, 3);
  p = pose(odometry);
  EXPECT_NEAR(p.east_m, 0, 1e-9);
  EXPECT_NEAR(p.north_m, 3, 1e-9);
}

TEST_F(WheelOdometryTest, ACompassTakesTheWheelsErrorAwayAndItsNoiseDoesNotShow) {
  // The left wheel is worn by 1 %, the compass trembles by 3 degrees: 60 s straight on.
  WheelOdometry with({.track_m = 0.5, .has_compass = true, .heading_time_s = 2});
  WheelOdometry without({.track_m = 0.5});
  ASSERT_EQ(with.add(travel_), Status::ok);
  ASSERT_EQ(without.add(travel_), Status::ok);
  double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    travel_.left_m += 0.5 / 50;
    travel_.right_m += 0.505 / 50;
    travel_.time += 20 * kMillisecond;
    ASSERT_EQ(with.add(travel_), Status::ok);
    ASSERT_EQ(without.add(travel_), Status::ok);
    ASSERT_EQ(with.add(HeadingSample{.yaw = (i % 2 == 0 ? 3 : -3) * kPi / 180, .time = travel_.time}), Status::ok);
    if (i > 100) worst = std::max(worst, std::abs(pose(with).yaw));
  }
  EXPECT_GT(pose(without).yaw, 30 * kPi / 180);
  EXPECT_LT(worst, 2 * kPi / 180);  // 0.57 degrees a second, times 2 s, and some noise
}

TEST_F(WheelOdometryTest, AJumpOfTheCompassIsNotBelievedUntilItStays) {
  WheelOdometry odometry({.track_m = 0.5, .has_compass = true, .heading_jump_deg = 20, .jump_hold_s = 3});
  ASSERT_EQ(odometry.add(travel_), Status::ok);
  HeadingSample heading{.yaw = 0, .time = kSecond};
  ASSERT_EQ(odometry.add(heading), Status::ok);
  heading.yaw = 1;
  for (int i = 0; i < 30; ++i) {  // 3 s
    heading.time += 100 * kMillisecond;
    EXPECT_EQ(odometry.add(heading), Status::bad_data);
    EXPECT_EQ(pose(odometry).yaw, 0);
  }
  EXPECT_EQ(odometry.counters()[1].value, 30U);
  heading.time += 100 * kMillisecond;
  EXPECT_EQ(odometry.add(heading), Status::ok);
  EXPECT_EQ(pose(odometry).yaw, 1);
}

// Turns at 1.5 rad/s to one side and the other, half a second each; read every 20 ms, the heading 15 ms later. The vehicle turns by
// `share` of what its wheels say.
class TurningOdometryTest : public WheelOdometryTest {
 protected:
  void turn(double share, double seconds) {
    const int steps = static_cast<int>(std::lround(seconds * 50));
    for (int i = 0; i < steps; ++i, ++steps_) {
      const double rate = steps_ / 25 % 2 == 0 ? 1.5 : -1.5;
      travel_.left_m -= rate / 50 * 0.25;
      travel_.right_m += rate / 50 * 0.25;
      travel_.time += 20 * kMillisecond;
      true_yaw_ += share * rate / 50;
      ASSERT_EQ(odometry_.add(travel_), Status::ok);
      worst_ = std::max(worst_, std::abs(pose(odometry_).yaw - true_yaw_));
      const HeadingSample heading{.yaw = true_yaw_ + compass_error_ + share * rate * 0.015,
                                  .time = travel_.time + 15 * kMillisecond};
      if (i % 3 == 0) {
        ASSERT_EQ(odometry_.add(heading), Status::ok);
      }
    }
  }

  WheelOdometry odometry_{{.track_m = 0.5, .has_compass = true}};
  double true_yaw_ = 0;
  double compass_error_ = 0;
  double worst_ = 0;
  int steps_ = 0;
};

TEST_F(TurningOdometryTest, WhatTheTyresLoseInATurnIsLearnt) {
  ASSERT_EQ(odometry_.add(travel_), Status::ok);
  ASSERT_EQ(odometry_.add(HeadingSample{.time = travel_.time}), Status::ok);
  turn(0.94, 4);
  worst_ = 0;
  turn(0.94, 4);
  EXPECT_LT(worst_, 0.5 * kPi / 180);  // 2.6 degrees in each half second, without
  // For a second without a compass to look at.
  for (int i = 0; i < 50; ++i) {
    travel_.left_m -= 1.5 / 50 * 0.25;
    travel_.right_m += 1.5 / 50 * 0.25;
    travel_.time += 20 * kMillisecond;
    ASSERT_EQ(odometry_.add(travel_), Status::ok);
  }
  EXPECT_NEAR(pose(odometry_).yaw, true_yaw_ + 0.94 * 1.5, 1.5 * kPi / 180);  // 5.2 degrees
}

TEST_F(TurningOdometryTest, AHeadingIsComparedWithThePoseOfItsOwnTime) {
  ASSERT_EQ(odometry_.add(travel_), Status::ok);
  ASSERT_EQ(odometry_.add(HeadingSample{.time = travel_.time}), Status::ok);
  turn(1, 4);
  EXPECT_LT(worst_, 0.4 * kPi / 180);  // the 15 ms are 1.3 degrees
}

TEST_F(WheelOdometryTest, AHeadingThatIsUnlikelyIsLeftOutButNoFault) {
  WheelOdometry odometry({.track_m = 0.5, .has_compass = true, .heading_jump_deg = 20, .jump_hold_s = 3});
  ASSERT_EQ(odometry.add(travel_), Status::ok);
  ASSERT_EQ(odometry.add(HeadingSample{.time = travel_.time}), Status::ok);
  for (int i = 0; i < 200; ++i) {
    run(odometry, 0.5, 0.5, 0.1);
    const bool passes_iron = i >= 50 && i < 60;
    const HeadingSample heading{.yaw = passes_iron ? 12 * kPi / 180 : 0, .time = travel_.time};
    ASSERT_EQ(odometry.add(heading), Status::ok);
    EXPECT_NEAR(pose(odometry).yaw, 0, 0.1 * kPi / 180);
  }
  EXPECT_EQ(odometry.counters()[1].value, 0U);
}

TEST_F(WheelOdometryTest, AShortJumpIsForgotten) {
  WheelOdometry odometry({.track_m = 0.5, .has_compass = true, .jump_hold_s = 0.3});
  ASSERT_EQ(odometry.add(travel_), Status::ok);
  HeadingSample heading{.time = kSecond};
  for (int i = 0; i < 20; ++i) {
    heading.yaw = i % 3 == 2 ? 0 : 2;  // never for longer than 0.2 s
    heading.time += 100 * kMillisecond;
    (void)odometry.add(i == 0 ? HeadingSample{.time = heading.time} : heading);
  }
  EXPECT_NEAR(pose(odometry).yaw, 0, 1e-9);
}

TEST_F(WheelOdometryTest, AWheelThatLostCountIsLeftOut) {
  WheelOdometry odometry({.track_m = 0.5, .max_speed_mps = 2});
  ASSERT_EQ(odometry.add(travel_), Status::ok);
  run(odometry, 1, 1, 1);
  travel_.left_m = 0;  // the drive was switched off and on
  travel_.time += 20 * kMillisecond;
  EXPECT_EQ(odometry.add(travel_), Status::bad_data);
  EXPECT_EQ(pose(odometry).time, travel_.time - 20 * kMillisecond);
  travel_.right_m = std::numeric_limits<double>::quiet_NaN();
  travel_.time += 20 * kMillisecond;
  EXPECT_EQ(odometry.add(travel_), Status::bad_data);
  travel_.right_m = 7;
  travel_.time += 20 * kMillisecond;
  EXPECT_EQ(odometry.add(travel_), Status::bad_data);  // from no number on nothing is known
  EXPECT_EQ(odometry.counters()[0].value, 3U);
  EXPECT_NEAR(pose(odometry).east_m, 1, 1e-9);
  run(odometry, 1, 1, 1);
  EXPECT_NEAR(pose(odometry).east_m, 2, 1e-9);
  EXPECT_NEAR(pose(odometry).yaw, 0, 1e-9);
}

TEST_F(WheelOdometryTest, NothingIsKnownBeforeTheFirstReadingAndOldOnesChangeNothing) {
  WheelOdometry odometry({});
  PoseSample p;
  EXPECT_EQ(odometry.pose(p), Status::timeout);
  ASSERT_EQ(odometry.add(travel_), Status::ok);
  run(odometry, 1, 1, 1);
  EXPECT_EQ(odometry.add(WheelTravel{.left_m = 100, .right_m = 100, .time = 0}), Status::ok);
  EXPECT_NEAR(pose(odometry).east_m, 1, 1e-9);
  EXPECT_EQ(odometry.add(HeadingSample{.yaw = NAN, .time = travel_.time}), Status::bad_data);
}

}  // namespace
}  // namespace lakshya

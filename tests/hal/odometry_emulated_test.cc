// Odometry from the emulated drives and compass, on a clock that only moves when somebody waits: minutes of driving.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hal/compass/os5000.h"
#include "hal/odometry/wheel_odometry.h"
#include "hal/servo/quicksilver.h"
#include "tests/emulators/os5000_device.h"
#include "tests/emulators/quicksilver_drive.h"
#include "tests/support/line_device_port.h"
#include "tests/support/manual_clock.h"

namespace lakshya {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTrack = 0.5;

// Wheels of 0.6 m a turn, motors of 10 turns for it.
QuickSilverSettings drives() {
  QuickSilverSettings settings;
  settings.left.radius_m = settings.right.radius_m = 0.3 / kPi;
  settings.right.direction = -1;
  settings.max_acceleration_mps2 = 2;
  return settings;
}

// Where the emulated wheels have really carried the vehicle: small steps, each straight on.
struct TruePath {
  double east = 0;
  double north = 0;
  double yaw = 0;
  double length = 0;

  void step(double left, double right) {
    const double way = (left + right) / 2;
    east += way * std::cos(yaw);
    north += way * std::sin(yaw);
    yaw += (right - left) / kTrack;
    length += std::abs(way);
  }
};

class OdometryEmulatedTest : public testing::Test {
 protected:
  void start(bool has_compass) {
    odometry_ = WheelOdometry({.track_m = kTrack, .has_compass = has_compass, .max_speed_mps = 2});
    ASSERT_EQ(servo_.open(), Status::ok) << servo_.problem();
    if (has_compass) {
      ASSERT_EQ(compass_.open(), Status::ok) << compass_.problem();
    }
    (void)follow_truth();
    truth_ = {.yaw = has_compass ? kStartYaw : 0};
  }

  // 60 ms: a command, a reading of the wheels and one of the compass; the truth in steps of at most 5 ms where nobody talks.
  void period(const WheelVelocities& wanted, bool has_compass) {
    const Nanoseconds end = clock_.now() + 60 * kMillisecond;
    ASSERT_EQ(servo_.drive(wanted, clock_.now() + 25 * kMillisecond), Status::ok) << servo_.problem();
    follow_truth();
    WheelTravel travel;
    ASSERT_EQ(servo_.read_travel(clock_.now() + 25 * kMillisecond, travel), Status::ok) << servo_.problem();
    ASSERT_EQ(odometry_.add(travel), Status::ok);
    follow_truth();
    HeadingSample heading;
    if (has_compass && compass_.read(clock_.now(), heading) == Status::ok) {
      ++headings_;
      ASSERT_EQ(odometry_.add(heading), Status::ok);
    }
    while (clock_.now() < end) {
      clock_.sleep_until(std::min(end, clock_.now() + 5 * kMillisecond));
      follow_truth();
    }
  }

  void drive(double seconds, double left_mps, double right_mps, bool has_compass) {
    for (int i = 0; i < std::lround(seconds / 0.06); ++i)
      ASSERT_NO_FATAL_FAILURE(period({left_mps, right_mps}, has_compass));
  }

  // Round a course with straights, wide and tight turns, a turn on the spot and a way back; then what the odometry says
  // of it is compared with where the vehicle is.
  void drive_the_course_and_compare(bool has_compass) {
    ASSERT_NO_FATAL_FAILURE(start(has_compass));
    for (int round = 0; round < 3; ++round) {
      ASSERT_NO_FATAL_FAILURE(drive(10, 0.8, 0.8, has_compass));
      ASSERT_NO_FATAL_FAILURE(drive(6, 0.5, 0.7, has_compass));
      ASSERT_NO_FATAL_FAILURE(drive(5, 0.6, 0.2, has_compass));
      ASSERT_NO_FATAL_FAILURE(drive(3, -0.2, 0.2, has_compass));
      ASSERT_NO_FATAL_FAILURE(drive(4, -0.4, -0.5, has_compass));
    }
    ASSERT_NO_FATAL_FAILURE(drive(2, 0, 0, has_compass));
    PoseSample pose;
    ASSERT_EQ(odometry_.pose(pose), Status::ok);
    const double error = std::hypot(pose.east_m - truth_.east, pose.north_m - truth_.north);
    RecordProperty("path_m", std::to_string(truth_.length));
    RecordProperty("error_m", std::to_string(error));
    EXPECT_GT(truth_.length, 40);
    EXPECT_LT(error, 0.01 * truth_.length);
    EXPECT_NEAR(std::remainder(pose.yaw - truth_.yaw, 2 * kPi), 0, 2 * kPi / 180);
  }

  void follow_truth() {
    const double left = line_.state(0, clock_.now()).position * 0.06 / 8000;
    const double right = -line_.state(1, clock_.now()).position * 0.06 / 8000;
    truth_.step(left - left_, right - right_);
    left_ = left;
    right_ = right;
    compass_device_.heading_deg = 90 - truth_.yaw * 180 / kPi;
  }

  static constexpr double kStartYaw = 0.7;

  ManualClock clock_;
  emulator::QuickSilverLine line_;
  emulator::Os5000Device compass_device_;
  LineDevicePort servo_port_{line_, clock_};
  LineDevicePort compass_port_{compass_device_, clock_};
  QuickSilver servo_{drives(), servo_port_, clock_};
  Os5000 compass_{{}, compass_port_, clock_};
  WheelOdometry odometry_{{}};
  TruePath truth_{.yaw = kStartYaw};
  double left_ = 0;
  double right_ = 0;
  int headings_ = 0;
};

TEST_F(OdometryEmulatedTest, FromTheDrivesAloneWithinAPercentOfThePath) {
  drive_the_course_and_compare(false);
}

TEST_F(OdometryEmulatedTest, WithTheCompassTheHeadingIsTheWorlds) {
  drive_the_course_and_compare(true);
  EXPECT_GT(headings_, 500);
}

}  // namespace
}  // namespace lakshya

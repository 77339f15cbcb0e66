#include "app/tools/compass_command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "app/core/devices.h"
#include "app/core/vehicle_config_file.h"

namespace lakshya {
namespace {

constexpr double kPi = std::numbers::pi;

// A turn through `degrees`, disturbed by iron: moved by 0.3 and -0.1 gauss, twice as sensitive forward as to the left.
std::vector<Vector3> turn(int degrees) {
  std::vector<Vector3> samples;
  for (int i = 0; i < degrees; ++i) {
    const double a = i * kPi / 180;
    samples.push_back({0.3 + 0.25 * std::cos(a), -0.1 + 0.2 * std::sin(a), -0.4});
  }
  return samples;
}

TEST(CompassCalibration, WhatIsPrintedIsReadAgainAndStraightensTheField) {
  const std::vector<Vector3> samples = turn(360);
  MagnetometerFit fit;
  ASSERT_EQ(fit_magnetometer(samples, {}, fit), Status::ok) << to_string(fit.refusal);
  const VehicleConfig config = parse_vehicle_config(calibration_yaml(fit), "calibration", "", {});
  const IioCompassSettings settings = iio_settings(config);
  double least = 1;
  double most = 0;
  for (const Vector3& sample : samples) {
    const Vector3 field = settings.soft_iron * (sample - settings.hard_iron);
    least = std::min(least, std::hypot(field[0], field[1]));
    most = std::max(most, std::hypot(field[0], field[1]));
  }
  EXPECT_GT(least, 0.2);
  EXPECT_LT(most / least, 1.001);
}

TEST(CompassCalibration, DirectionsSeenGrowWithTheTurn) {
  EXPECT_EQ(directions_seen_deg({}), 0);
  EXPECT_EQ(directions_seen_deg(turn(1)), 10);
  EXPECT_EQ(directions_seen_deg(turn(360)), 360);
  EXPECT_NEAR(directions_seen_deg(turn(270)), 270, 20);
}

TEST(CompassCalibration, AxesAreThoseOfTheConfiguration) {
  VehicleConfig config;
  config.iio.axes = "-y,x,z";
  const Vector3 forward = iio_settings(config).axes * Vector3{0, -1, 0};
  EXPECT_EQ(forward, (Vector3{1, 0, 0}));
  for (const char* text : {"", "x", "x,y", "x,y,y", "x,y,-z", "x,y,z,", "x y z", "+x,y,z", "y,x,z"}) {
    config.iio.axes = text;
    EXPECT_THROW((void)iio_settings(config), std::exception) << text;
  }
}

}  // namespace
}  // namespace lakshya

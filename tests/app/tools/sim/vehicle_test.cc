// The simulated vehicle moves, measures and feels as its settings say.
#include "app/tools/sim/vehicle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lakshya::sim {
namespace {

VehicleSettings perfect() {
  VehicleSettings s;
  s.slip = s.slip_wander = s.heading_bias_deg = s.heading_noise_deg = s.heading_jumps_per_s = s.shake_deg = 0;
  return s;
}

World flat() {
  World world;
  world.start = {1, 2, std::numbers::pi / 2};
  world.goals = {{1, 5}};
  return world;
}

TEST(Vehicle, DrivesAsItIsTold) {
  const World world = flat();
  Vehicle vehicle(perfect(), world, 1, 0);
  ASSERT_EQ(vehicle.command(0, {0.5, 0.5}), Status::ok);
  const VehicleState state = vehicle.at(4 * kSecond);
  // Latency and the motors' lag cost 0.04 + 0.08 s of the way, their acceleration a little more.
  EXPECT_NEAR(state.y, 2 + 0.5 * (4 - 0.12), 0.03);
  EXPECT_NEAR(state.x, 1, 1e-9);
  EXPECT_NEAR(state.speed_mps, 0.5, 1e-3);
}

TEST(Vehicle, DoesNothingBeforeTheLatencyIsOver) {
  const World world = flat();
  Vehicle vehicle(perfect(), world, 1, 0);
  ASSERT_EQ(vehicle.command(0, {1, 1}), Status::ok);
  EXPECT_EQ(vehicle.at(39 * kMillisecond).speed_mps, 0);
  EXPECT_GT(vehicle.at(60 * kMillisecond).speed_mps, 0);
}

TEST(Vehicle, TurnsOnTheSpotByTheTrack) {
  const World world = flat();
  Vehicle vehicle(perfect(), world, 1, 0);
  ASSERT_EQ(vehicle.command(0, {-0.1, 0.1}), Status::ok);
  const VehicleState state = vehicle.at(2 * kSecond);
  EXPECT_NEAR(state.turn_rate_rps, 0.2 / 0.5, 1e-3);
  EXPECT_NEAR(std::hypot(state.x - 1, state.y - 2), 0, 1e-6);
}

TEST(Vehicle, SlipCostsWayThatTheEncodersDoNotSee) {
  VehicleSettings slips = perfect();
  slips.slip = 0.1;
  const World world = flat();
  Vehicle vehicle(slips, world, 1, 0);
  ASSERT_EQ(vehicle.command(0, {0.5, 0.5}), Status::ok);
  WheelTravel travel;
  ASSERT_EQ(vehicle.travel(4 * kSecond, travel), Status::ok);
  EXPECT_NEAR((vehicle.at(4 * kSecond).y - 2) / travel.left_m, 0.9, 0.002);
  const double steps = travel.left_m / slips.encoder_step_m;
  EXPECT_NEAR(steps, std::round(steps), 1e-6);
}

TEST(Vehicle, CompassHasTheNoiseThatItsSettingsSay) {
  VehicleSettings noisy = perfect();
  noisy.heading_noise_deg = 0.5;
  const World world = flat();
  Vehicle vehicle(noisy, world, 1, 0);
  double sum = 0;
  double squares = 0;
  constexpr int kReadings = 4000;
  for (int i = 0; i < kReadings; ++i) {
    HeadingSample sample;
    ASSERT_EQ(vehicle.heading(i * 50 * kMillisecond, sample), Status::ok);
    const double error = (sample.yaw - std::numbers::pi / 2) * 180 / std::numbers::pi;
    sum += error;
    squares += error * error;
  }
  EXPECT_NEAR(sum / kReadings, 0, 0.03);
  EXPECT_NEAR(std::sqrt(squares / kReadings), 0.5, 0.03);
}

TEST(Vehicle, LeansAsTheGroundDoes) {
  World world = flat();
  GroundPatch ramp;
  ramp.x0 = 0;
  ramp.x1 = 10;
  ramp.y0 = -10;
  ramp.y1 = 10;
  ramp.slope_x = std::tan(8 * std::numbers::pi / 180);
  world.ground.patches.push_back(ramp);
  world.start = {5, 0, 0};
  Vehicle up(perfect(), world, 1, 0);
  EXPECT_NEAR(up.at(0).pitch * 180 / std::numbers::pi, 8, 1e-6);
  EXPECT_NEAR(up.at(0).z, 5 * ramp.slope_x, 1e-9);
  world.start.yaw = std::numbers::pi / 2;  // the slope falls to the left
  Vehicle across(perfect(), world, 1, 0);
  EXPECT_NEAR(across.at(0).roll * 180 / std::numbers::pi, -8, 1e-6);
}

TEST(Vehicle, SameSeedSameDrive) {
  const World world = flat();
  const auto drive = [&](std::uint64_t seed) {
    Vehicle vehicle({}, world, seed, 0);
    (void)vehicle.command(0, {0.4, 0.5});
    return vehicle.at(5 * kSecond).x;
  };
  EXPECT_EQ(drive(1), drive(1));
  EXPECT_NE(drive(1), drive(2));
}

}  // namespace
}  // namespace lakshya::sim

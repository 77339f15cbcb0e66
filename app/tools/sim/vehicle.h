// The simulated vehicle: two driven wheels on true ground, with what separates a real one from its model.
//
// A command reaches the motors after a latency; each wheel follows with a first-order lag within its acceleration. The ground
// passes on a little less than what the wheels turn (slip, more in turns), a share that wanders. Encoders count whole steps of
// what the wheels turned; the compass has a bias, noise and, now and then, iron near it.
#pragma once

#include <array>
#include <cstdint>

#include "app/tools/sim/random.h"
#include "app/tools/sim/world.h"
#include "hal/compass/sim_compass.h"
#include "hal/servo/sim_servo.h"

namespace lakshya::sim {

struct VehicleSettings {
  double track_m = 0.5;
  double command_latency_s = 0.04;
  double motor_time_s = 0.08;         // of the lag
  double most_acceleration_mps2 = 4;  // of a wheel
  double slip = 0.02;                 // share of the way that is lost, mean; turning twice as much
  double slip_wander = 0.01;          // its standard deviation
  double encoder_step_m = 0.0005;
  double heading_bias_deg = 1.0;      // standard deviation; one draw for a run
  double heading_noise_deg = 0.5;     // standard deviation of a reading
  double heading_jumps_per_s = 0.01;  // of 5 to 15 degrees, for half a second
  double shake_deg = 0.1;             // pitch and roll of the body while it drives, standard deviation
};

struct VehicleState {
  double x = 0, y = 0, z = 0;  // turning centre on the ground, world frame, metres
  double yaw = 0;              // rad
  double pitch = 0;            // of the body, nose up positive, rad
  double roll = 0;             // right side down positive
  double speed_mps = 0;        // over the ground, forward
  double turn_rate_rps = 0;
  double path_m = 0;  // gone so far, without sign
};

class Vehicle final : public WheelProducer, public HeadingProducer {
 public:
  // Stands at world.start at `time`. `world` outlives it.
  Vehicle(const VehicleSettings& settings, const World& world, std::uint64_t seed, Nanoseconds time);

  Status command(Nanoseconds time, const WheelVelocities& wanted) override;
  Status travel(Nanoseconds time, WheelTravel& travel) override;
  Status heading(Nanoseconds time, HeadingSample& sample) override;

  // In order of time; earlier times give the newest state.
  const VehicleState& at(Nanoseconds time);

 private:
  struct Command {
    Nanoseconds due = 0;
    WheelVelocities wanted;
  };
  static constexpr Nanoseconds kStep = kMillisecond;
  static constexpr std::size_t kMostWaiting = 64;

  void step();
  void settle_on_ground();

  const VehicleSettings settings_;
  const World* world_;
  Random slips_;
  Random readings_;
  Nanoseconds time_;
  std::array<Command, kMostWaiting> waiting_{};  // a ring, in order of time
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  WheelVelocities wanted_;
  std::array<double, 2> wheel_mps_{};  // turned, left and right
  std::array<double, 2> wheel_m_{};
  std::array<double, 2> slip_{};
  double bias_ = 0;
  double jump_ = 0;
  Nanoseconds jump_until_ = 0;
  std::array<double, 2> shake_{};  // pitch, roll
  VehicleState state_;
};

}  // namespace lakshya::sim

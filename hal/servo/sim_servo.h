// The seam that a simulator fills: drives whose wheels turn in the simulator.
#pragma once

#include "hal/servo.h"

namespace lakshya {

class WheelProducer {
 public:
  virtual ~WheelProducer() = default;
  // Commands come in order of time.
  virtual Status command(Nanoseconds time, const WheelVelocities& wanted) = 0;
  // What the encoders of the simulated vehicle say at `time`; `travel.time` is set by who asks.
  virtual Status travel(Nanoseconds time, WheelTravel& travel) = 0;
};

class SimServo final : public Servo {
 public:
  // Both outlive the servo.
  SimServo(double max_speed_mps, WheelProducer& producer, Clock& clock)
      : max_speed_mps_(max_speed_mps), producer_(&producer), clock_(&clock) {}

  Status open() override;
  void close() override;
  // refused_commands
  std::span<const Counter> counters() const override { return counters_; }

  Status drive(const WheelVelocities& wanted, Nanoseconds deadline) override;
  Status read_travel(Nanoseconds deadline, WheelTravel& travel) override;
  Status stop(Nanoseconds deadline) override;
  double max_speed_mps() const override { return max_speed_mps_; }
  bool is_supervised() const override { return true; }

 private:
  const double max_speed_mps_;
  WheelProducer* producer_;
  Clock* clock_;
  bool open_ = false;
  Counter counters_[1] = {{"refused_commands"}};
};

}  // namespace lakshya

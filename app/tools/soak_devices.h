// The vehicle of the endurance test: a recording as its camera, drives that only count, a compass that follows them, and around
// each what spoils it when its time has come. None of them allocates after open().
#pragma once

#include <memory>
#include <vector>

#include "app/core/image.h"
#include "app/core/vehicle_config.h"
#include "app/loop/machinery.h"
#include "app/tools/soak_faults.h"
#include "hal/camera/folder_camera.h"

namespace lakshya {

// A recording's pairs, decoded once and kept: the first of them that fit into `most_bytes`, at least one.
class KeptPairs final : public RecordedPairs {
 public:
  // Throws InputError where a pair cannot be read.
  KeptPairs(RecordedPairs& recording, std::size_t most_bytes);

  int count() const override { return static_cast<int>(left_.size()); }
  int width() const override { return left_.front().width(); }
  int height() const override { return left_.front().height(); }
  std::optional<Nanoseconds> time(int /*n*/) const override { return {}; }
  Status load(int n, ImageView<std::uint8_t> left, ImageView<std::uint8_t> right) override;

 private:
  std::vector<Image<std::uint8_t>> left_;
  std::vector<Image<std::uint8_t>> right_;
};

class FaultyServo final : public Servo {
 public:
  FaultyServo(std::unique_ptr<Servo> inner, FaultPlan& plan, Clock& clock)
      : inner_(std::move(inner)), plan_(&plan), clock_(&clock) {}

  Status open() override { return inner_->open(); }
  void close() override { inner_->close(); }
  std::span<const Counter> counters() const override { return inner_->counters(); }
  // What cannot reach the drives makes them stop: they are supervised.
  Status drive(const WheelVelocities& wanted, Nanoseconds deadline) override;
  Status read_travel(Nanoseconds deadline, WheelTravel& travel) override;
  Status stop(Nanoseconds deadline) override;
  double max_speed_mps() const override { return inner_->max_speed_mps(); }
  bool is_supervised() const override { return true; }

  // Whether the newest command, obeyed or not, was to turn.
  bool is_told_to_turn() const { return told_to_turn_; }
  // Where the wheels have really got to, and their way without sign.
  WheelTravel true_travel();
  double way_m();

 private:
  Status exchange(Nanoseconds deadline);

  std::unique_ptr<Servo> inner_;
  FaultPlan* plan_;
  Clock* clock_;
  bool told_to_turn_ = false;
  WheelTravel seen_;
  double way_m_ = 0;
};

struct SoakVehicle {
  VehicleDevices devices;
  FaultyServo* servo = nullptr;  // devices.servo
  int pairs = 0;                 // of the recording that are kept
};

// `config` names a recording. `plan` and `clock` outlive the devices.
SoakVehicle make_soak_vehicle(const VehicleConfig& config, FaultPlan& plan, Clock& clock);

}  // namespace lakshya

// No motors: writes down what it is told. For trying a vehicle without wheels, and for tests.
#pragma once

#include <string>

#include "hal/linux/system_calls.h"
#include "hal/servo.h"
#include "hal/servo/commanded_travel.h"

namespace lakshya {

struct RecordServoSettings {
  std::string path;  // file with a line "time_s,left_mps,right_mps" per command, begun anew by open(); empty: none
  double max_speed_mps = 20;
};

class RecordServo final : public Servo {
 public:
  // `clock` and `system` outlive the servo.
  RecordServo(RecordServoSettings settings, Clock& clock, SystemCalls& system = linux_system_calls());
  ~RecordServo() override;
  RecordServo(const RecordServo&) = delete;
  RecordServo& operator=(const RecordServo&) = delete;

  Status open() override;
  void close() override;
  // commands; refused_commands; write_failures
  std::span<const Counter> counters() const override { return counters_; }

  // disconnected: the line could not be written (a full disk); the command holds all the same.
  Status drive(const WheelVelocities& wanted, Nanoseconds deadline) override;
  // The way of wheels that obey at once.
  Status read_travel(Nanoseconds deadline, WheelTravel& travel) override;
  Status stop(Nanoseconds deadline) override;
  double max_speed_mps() const override { return settings_.max_speed_mps; }
  bool is_supervised() const override { return true; }  // nothing turns

  const WheelVelocities& last() const { return travel_.speeds(); }

 private:
  Status write_line();

  const RecordServoSettings settings_;
  Clock* clock_;
  SystemCalls* system_;
  bool open_ = false;
  int fd_ = -1;
  CommandedTravel travel_;
  Counter counters_[3] = {{"commands"}, {"refused_commands"}, {"write_failures"}};
};

}  // namespace lakshya

// Two hobby drives (electronic speed controls) on two channels of a PWM chip of the kernel's: pulses of 1000 to 2000 us, in
// proportion to the speed. Linux: Documentation/driver-api/pwm.rst, "Using PWMs with the sysfs interface".
//
// The kernel goes on making pulses when this program dies, so that a drive that knows no better goes on turning: unless
// `supervised` says that something in the vehicle stops it, the speed is limited to `unsupervised_mps`.
#pragma once

#include <array>
#include <string>

#include "hal/linux/system_calls.h"
#include "hal/retry.h"
#include "hal/servo.h"
#include "hal/servo/commanded_travel.h"

namespace lakshya {

struct PwmServoSettings {
  std::string root = "/sys/class/pwm";
  int chip = 0;                                 // pwmchip0
  std::array<int, 2> channel = {0, 1};          // left, right
  std::array<int, 2> direction = {1, 1};        // 1, or -1 for a motor that is mounted the other way round
  std::array<int, 2> center_us = {1500, 1500};  // pulse of a wheel at rest, 800 .. 2200
  int span_us = 500;                            // from the centre to full speed, 1 .. 1000
  int period_us = 20000;                        // 2500 .. 50000, longer than the longest pulse
  double full_speed_mps = 1;                    // at center +- span, > 0
  double max_speed_mps = 1;                     // what is asked for at most, <= full_speed_mps
  double slew_mps2 = 2;  // largest change of a wheel's speed, > 0; stop() does not wait for it
  bool supervised = false;
  double unsupervised_mps = 0.3;
};

class PwmServo final : public Servo {
 public:
  // `clock` and `system` outlive the servo.
  PwmServo(PwmServoSettings settings, Clock& clock, SystemCalls& system = linux_system_calls());
  ~PwmServo() override;
  PwmServo(const PwmServo&) = delete;
  PwmServo& operator=(const PwmServo&) = delete;

  // Exports both channels, waits at most half a second for their files, and makes pulses of rest. Pulses that were being made
  // before go on until then.
  Status open() override;
  // Pulses of rest, then none.
  void close() override;
  // refused_commands; write_failures; disconnections
  std::span<const Counter> counters() const override { return counters_; }

  // One step towards the wanted speeds, as far as the slew allows since the last call, for at most 100 ms of it; to be called
  // again and again. Does not wait. When a channel does not take its pulse, both wheels are set to rest. disconnected: the chip is
  // gone; it is looked for again every 200 ms.
  Status drive(const WheelVelocities& wanted, Nanoseconds deadline) override;
  // The way of wheels that do as the pulses say: measured is false.
  Status read_travel(Nanoseconds deadline, WheelTravel& travel) override;
  Status stop(Nanoseconds deadline) override;
  double max_speed_mps() const override;
  bool is_supervised() const override { return settings_.supervised; }

 private:
  bool settings_ok();
  Status open_channel(int side, Nanoseconds deadline);
  Status write_attribute(int side, const char* name, int value);
  int open_attribute(int side, const char* name);
  Status write_number(int fd, int side, const char* name, int value);
  Status rest();
  Status set_pulses(const WheelVelocities& speeds);
  Status reopen_when_due();
  void release();

  const PwmServoSettings settings_;
  Clock* clock_;
  SystemCalls* system_;
  Retry retry_;
  std::array<int, 2> duty_fd_ = {-1, -1};
  bool wanted_open_ = false;  // between open() and close(), the chip there or not
  CommandedTravel travel_;
  Nanoseconds pulses_since_ = 0;
  Counter counters_[3] = {{"refused_commands"}, {"write_failures"}, {"disconnections"}};
};

}  // namespace lakshya

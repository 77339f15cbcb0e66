// Two QuickSilver drives (SilverDust, SilverNugget, SilverLode), one a wheel, on one serial line: 8-bit ASCII protocol,
// 57600 baud as delivered. What runs in the drives, registers and wiring: docs/quicksilver.md.
//
// Under the maker's velocity command VMI a drive keeps turning when this computer dies. So, unless told otherwise, each drive
// runs a resident program from power-up, which takes its velocity from a register and zeroes it when a second register, the
// counter, has not moved for 200 ms. drive() writes both. open() believes in no program: it reads its signature, sees
// its heartbeat move, and sees it zero a velocity of 1 unit (0.000002 rpm) that nobody kept alive; refused where that fails.
// Later, read_travel() sees each second that the heartbeats still move, and after a pause of 200 ms before it believes that
// a wheel has moved: a drive that was without power counts from zero, and its heartbeat, too. STP, HLT and VMI end a
// resident program, so a supervised drive is stopped by velocity 0; HLT comes only after it answered that with a nak other
// than "busy", and the program must then be started again (power off and on).
//
// Line time at 57600 baud with 2 stop bits (11 bits or 0.191 ms a character; 10 % less with 1 stop bit), both drives
// together, longest numbers, without the drives' own delay (about a millisecond a command):
//   drive()        supervised  4 commands,  88 characters  16.8 ms
//                  by VMI      2 commands,  78 characters  14.9 ms
//   stop()         supervised  2 commands,  34 characters   6.5 ms
//   read_travel()              2 commands,  58 characters  11.1 ms, and 5.7 ms more once a second for each drive;
//                                                          after a pause 11.4 ms more where both have moved
// One of them fits a period of 20 ms, both together take 28 ms: for both in every such period, set drives and port to
// 115200 baud. After a reply that was lost or late, drive() answers timeout unless 23 ms are left before its deadline.
//
// After the port was lost, drive() and read_travel() look for it every 200 ms and then set the drives up as open() does,
// as far as each call's deadline reaches: about 0.4 s in all, in which they answer timeout and the wheels stand.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

#include "hal/clock.h"
#include "hal/serial_port.h"
#include "hal/servo.h"
#include "hal/servo/quicksilver_link.h"
#include "hal/servo/quicksilver_settings.h"
#include "hal/servo/quicksilver_travel.h"

namespace lakshya {

class QuickSilver final : public Servo {
 public:
  // `port` and `clock` outlive the driver, which opens and closes the port.
  QuickSilver(const QuickSilverSettings& settings, SerialPort& port, Clock& clock);
  ~QuickSilver() override;
  QuickSilver(const QuickSilver&) = delete;
  QuickSilver& operator=(const QuickSilver&) = delete;

  // Takes about 0.4 s with resident programs, at most 2 s. refused: no resident program runs, or it does not act.
  Status open() override;
  void close() override;
  std::span<const Counter> counters() const override { return counters_.all; }

  // When one drive fails, both are stopped with the time that is left, and the failure is reported.
  Status drive(const WheelVelocities& wanted, Nanoseconds deadline) override;
  // bad_data: a position that the wheel cannot have reached (hal/servo/quicksilver_travel.h); when it turns out that the drive
  // has started anew, the wheels are stopped and the drives set up again. refused: the same, because a resident program no
  // longer runs, or has started anew. Travel goes on from where it was; what the wheel did meanwhile is not in it.
  Status read_travel(Nanoseconds deadline, WheelTravel& travel) override;
  // With the set acceleration. A command that a drive does not confirm is sent again, and reported. Sends nothing while a resident
  // program is on trial: the drives have confirmed that they stand.
  Status stop(Nanoseconds deadline) override;
  double max_speed_mps() const override;
  bool is_supervised() const override { return settings_.supervised; }

 private:
  enum class Step : std::uint8_t {
    stop,
    signature,
    position,
    acceleration,
    acceleration_again,
    heartbeat,
    trial,
    heartbeat_again,
    trial_again,
    done
  };
  struct Drive {
    std::int32_t acceleration = 0;  // units
    bool told_to_stop = false;      // and not to move since
    QuickSilverTravel travel;
    std::int32_t heartbeat = 0;
    Nanoseconds heartbeat_time = 0;
    double beats_per_s = 0;    // 0: not known yet
    Nanoseconds known_at = 0;  // when its position or its heartbeat last said that it goes on as it was
    int missed_checks = 0;
  };

  const QuickSilverWheel& wheel(std::size_t drive) const { return drive == 0 ? settings_.left : settings_.right; }
  quicksilver::CommandText to(std::size_t drive, quicksilver::Command command,
                              std::initializer_list<std::int32_t> parameters) const;

  Status reopen();
  Status be_ready(Nanoseconds deadline);
  Status set_up(Nanoseconds deadline);
  Status take_step(std::size_t drive, Nanoseconds deadline);
  Status see_signature(std::size_t drive, Nanoseconds deadline);
  Status see_acceleration(std::size_t drive, Nanoseconds deadline);
  // `beats` since the last look; below 0 where the drive has started anew, and its next position is where travel goes on.
  Status see_heartbeat(std::size_t drive, Nanoseconds deadline, std::int64_t& beats);
  bool is_unknown(std::size_t drive) const;
  Status see_unknown_ones(const std::array<std::int32_t, 2>& positions, Nanoseconds deadline);
  void rebase(std::size_t drive);
  Status see_position(std::size_t drive, Nanoseconds deadline);
  Status see_heartbeat_move(std::size_t drive, Nanoseconds deadline);
  Status see_velocity_zeroed(std::size_t drive, Nanoseconds deadline);
  void finish_step();
  bool trial_is_on() const;
  void start_over();

  Status refuse(Nanoseconds deadline);
  Status set_velocity(std::size_t drive, double speed_mps, Nanoseconds deadline);
  Status feed(std::size_t drive, Nanoseconds deadline);
  Status stop_drive(std::size_t drive, Nanoseconds deadline);
  Status stop_both(std::size_t first, Nanoseconds deadline);
  Status stop_after(Status failure, std::size_t first, Nanoseconds deadline);

  Status take_positions(const std::array<std::int32_t, 2>& positions, Nanoseconds time, Nanoseconds deadline);
  Status watch_programs(Nanoseconds deadline);
  Status program_is_dead(std::size_t drive, const char* why);

  const QuickSilverSettings settings_;
  Clock* clock_;
  QuickSilverCounters counters_;
  QuickSilverLink link_;
  std::array<Drive, 2> drives_;
  std::int32_t counter_ = 0;
  bool opened_ = false;
  Nanoseconds next_try_ = 0;      // to find the port or to set up the drives
  Status last_try_ = Status::ok;  // how the last one ended
  Step step_ = Step::stop;        // of setting up, for drive step_drive_
  std::size_t step_drive_ = 0;
  Nanoseconds trial_end_ = 0;
};

}  // namespace lakshya

// QuickSilver drives on one serial line, as their manuals describe them: 8-bit ASCII protocol, velocity mode, registers, and a
// resident program that stops a motor whose host has gone silent.
//
// Facts: commands are decimal, "@16 12 1\r"; replies hexadecimal, "* 10\r", "# 10 000C 0005 06A3\r", "! 10 000C 0002\r".
// A velocity is 2^31 at 4000 rpm, an acceleration 3865.47 for 1 rev/s^2. Register 1 is the position, which wraps at 32 bits.
// STP, HLT and VMI end a program. Where the manuals are silent, this device: begins a command anew at every '@', ignores what
// it cannot give to an address, answers "bad format" for registers that do not exist or cannot be written, and turns a motor
// whose acceleration is 0 at once.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "tests/emulators/line.h"

namespace lakshya::emulator {

// What QuickSilverDrive::state() says.
struct QuickSilverState {
  int address = 0;
  double position = 0;      // counts since power-up, without the wrap
  double velocity_rpm = 0;  // of the motor, now
  bool program_runs = false;
  bool tripped = false;  // the program has zeroed the velocity, and the counter has not moved since
  int trips = 0;
  int commands = 0;  // complete ones addressed to it
  int naks = 0;
};

// The registers of the resident program. `acceleration` is followed by `velocity`.
struct QuickSilverProgram {
  bool at_power_up = true;
  int acceleration = 29;
  int velocity = 30;
  int counter = 31;
  int heartbeat = 32;
  int signature = 33;
  std::int32_t signature_value = 1280004401;
  std::int64_t period_ns = 10'000'000;
  std::int64_t patience_ns = 200'000'000;
  bool zeroes_velocity = true;  // false: a program that looks alive and does not do its work
};

// One drive and its motor: commands in, replies out, without the line's time.
class QuickSilverDrive {
 public:
  static constexpr int kRegisters = 199;  // 0 to 198; from 11 on they may be written

  QuickSilverDrive(int address, const QuickSilverProgram& program);

  int address() const { return address_; }
  // Without its \r.
  std::string execute(std::string_view parameters, std::int64_t now_ns);
  std::string nak(int command, int code);
  // Power off and on: registers and position are zero, the program starts.
  void restart();
  // Time passes up to `now_ns`.
  void advance(std::int64_t now_ns);
  QuickSilverState state() const;
  std::int32_t value(int number) const;
  void set_position(std::int64_t counts) { position_ = static_cast<double>(counts); }
  void end_program();

  int counts_per_rev = 8000;

 private:
  std::string perform(int command, const std::vector<std::int64_t>& parameters);
  std::string done() const;
  std::string data(int command, std::uint32_t value, int words) const;
  std::string velocity_mode(const std::vector<std::int64_t>& parameters);
  std::string read(std::int64_t number);
  std::string write(std::int64_t number, std::int64_t value);
  void run_program();
  void turn(double seconds);

  const int address_;
  QuickSilverProgram program_;
  std::array<std::int32_t, kRegisters> registers_{};
  std::uint16_t poll_status_ = 0;
  double position_ = 0;      // counts
  double velocity_ = 0;      // revolutions a second
  double wanted_ = 0;        // revolutions a second
  double acceleration_ = 0;  // revolutions a second squared
  bool program_runs_ = false;
  std::int32_t last_counter_ = 0;
  std::int64_t unmoved_ns_ = 0;
  std::int64_t now_ns_ = -1;  // nothing has happened yet
  std::int64_t next_round_ns_ = 0;
  bool tripped_ = false;
  int trips_ = 0;
  int commands_ = 0;
  int naks_ = 0;
};

class QuickSilverLine final : public LineDevice {
 public:
  explicit QuickSilverLine(const std::vector<int>& addresses = {16, 17}, const QuickSilverProgram& program = {});

  void hear(std::string_view bytes, std::int64_t now_ns) override;
  std::string say(std::int64_t now_ns) override;

  QuickSilverDrive& drive(std::size_t index) { return drives_.at(index); }
  std::size_t drives() const { return drives_.size(); }
  // Up to date at `now_ns`.
  QuickSilverState state(std::size_t index, std::int64_t now_ns);

  // Knobs. "Every N" counts the commands of all drives; 0 is never.
  int nak_every = 0;                    // not carried out, answered by nak_code
  int nak_code = 2;                     // busy
  int silent_every = 0;                 // carried out, not answered
  int silent_address = 0;               // this drive has no power: it hears nothing and its motor is not looked at
  bool has_power = true;                // false: no drive hears anything
  int garbage_every = 0;                // a damaged line comes before the reply
  bool split = false;                   // every reply comes in two pieces with 3 ms between them
  bool merge = false;                   // every reply comes in one piece with a repetition of itself
  int answers_as = 0;                   // replies say that they come from this address
  bool damaged = false;                 // instead of every reply comes something like it
  bool checksum_errors = false;         // the drives want checksums: nak 10 for everything
  std::int64_t slow_ns = 0;             // replies come this much later
  std::int64_t latency_ns = 500'000;    // from a command's end to its reply's beginning
  std::int64_t character_ns = 190'972;  // 11 bits at 57600 baud

 private:
  struct Piece {
    std::int64_t time_ns;
    std::string bytes;
  };
  void take_line(std::int64_t heard_ns);
  void answer(QuickSilverDrive& drive, std::string_view rest, std::int64_t heard_ns);
  void reply(const std::string& line, std::int64_t heard_ns);
  void put(const std::string& bytes, std::int64_t& time_ns, bool at_once);
  bool is_nth(int every) const { return every > 0 && commands_ % every == 0; }

  std::vector<QuickSilverDrive> drives_;
  std::string line_;
  bool in_command_ = false;
  int commands_ = 0;
  std::int64_t heard_until_ns_ = 0;
  std::int64_t said_until_ns_ = 0;
  std::deque<Piece> pieces_;
};

}  // namespace lakshya::emulator

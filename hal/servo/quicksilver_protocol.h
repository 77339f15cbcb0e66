// The 8-bit ASCII protocol of QuickSilver's drives (SilverDust, SilverNugget, SilverLode, SilverMax) as functions of bytes.
// Sources: the maker's Command Reference and the technical document QCI-TD053, Serial Communications.
//
//   command  "@16 12 1\r"              decimal: address, command, parameters
//   replies  "* 10\r"                  done, of drive 16: every number of a reply is hexadecimal
//            "# 10 000C 0005 06A3\r"   data: command, then 16-bit words, the high one of a register first
//            "! 10 000C 0002\r"        nak: command, reason
//
// Where the sources are silent: numbers of a reply have 1 to 4 digits of either case, an address 1 or 2; between them, and
// at the end of a line, there may be more than one space; nothing else is taken.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>

#include "kernels/base/status.h"

namespace lakshya::quicksilver {

enum class Command : std::uint8_t {
  halt = 2,             // HLT, no parameter: stops at once; ends the drive's program
  stop = 3,             // STP, deceleration (0: the one in force); ends the drive's program
  write_register = 11,  // WRI, register, value
  read_register = 12,   // RRG, register
  velocity = 15,        // VMI, acceleration, velocity, stop enable, stop state; ends the drive's program
};

inline constexpr int kPositionRegister = 1;  // counts, 32 bits that wrap
inline constexpr int kNakBusy = 2;

// The text of a command with its \r. At most four parameters.
class CommandText {
 public:
  CommandText(int address, Command command, std::initializer_list<std::int32_t> parameters);
  Command command() const { return command_; }
  std::span<const std::uint8_t> bytes() const { return {text_.data(), size_}; }

 private:
  void append(char mark, std::int32_t number);

  Command command_;
  std::array<std::uint8_t, 80> text_{};  // room for six numbers of 11 characters
  std::size_t size_ = 0;
};

struct Reply {
  enum class Kind : std::uint8_t { done, data, nak };
  Kind kind = Kind::done;
  int address = 0;
  int command = 0;   // of data and nak
  int nak_code = 0;  // of nak
  std::array<std::uint16_t, 8> words{};
  std::size_t word_count = 0;  // of data, 1 to 8
};

// `line` is without its \r. bad_data: no reply by the rules above; `reply` is then unspecified.
Status parse_reply(std::string_view line, Reply& reply);

// The 32-bit value that RRG answers. bad_data unless it is two words.
Status register_value(const Reply& reply, std::int32_t& value);

// "busy" for 2; "unknown" for a number that the sources do not give.
const char* nak_name(int code);

// Cuts a stream of bytes into lines at \r. A line longer than kLongest is thrown away up to its \r.
class LineCollector {
 public:
  static constexpr std::size_t kLongest = 64;

  // Takes bytes off the front up to the first \r. true: line() is complete until the next call; false: `bytes` is used up.
  bool take(std::span<const std::uint8_t>& bytes);
  // Empty, which is no reply, for one that was too long.
  std::string_view line() const { return {text_.data(), too_long_ ? 0 : size_}; }
  void clear();

 private:
  std::array<char, kLongest> text_{};
  std::size_t size_ = 0;
  bool too_long_ = false;
  bool complete_ = false;
};

// ---- units

// A velocity of VMI is 2^31 at 4000 rpm, 536870.9 a rpm.
inline constexpr double kVelocityPerRpm = 2147483648.0 / 4000.0;
// An acceleration of VMI, for 1 rev/s^2.
inline constexpr double kAccelerationPerRevPerS2 = 3865.47;

// Rounded to the nearest. bad_argument: not finite or not within +-2^31 - 1, which is 4000 rpm.
Status velocity_units(double rpm, std::int32_t& units);
// bad_argument: not within 1 to 2^30.
Status acceleration_units(double rev_per_s2, std::int32_t& units);

// From `before` to `after` the short way round: right while less than 2^31 counts lie between them.
constexpr std::int64_t counts_between(std::int32_t before, std::int32_t after) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(after) - static_cast<std::uint32_t>(before));
}

}  // namespace lakshya::quicksilver

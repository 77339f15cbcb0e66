#include "tests/emulators/quicksilver_drive.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <system_error>

namespace lakshya::emulator {
namespace {

constexpr double kUnitsPerRevPerS = 2147483648.0 / 4000.0 * 60.0;
constexpr double kUnitsPerRevPerS2 = 3865.47;
constexpr int kFirstWritable = 11;
constexpr std::size_t kLongestLine = 80;
constexpr std::int64_t kTurnStep = 1'000'000;
constexpr std::uint16_t kProgramEnded = 0x2000;  // bit 13 of the polling status word

enum Nak : int { bad_command = 1, bad_format = 5, buffer_full = 6, bad_checksum = 10 };

std::string printed(const char* format, int a, int b = 0, int c = 0, int d = 0) {
  char text[64];
  const int size = std::snprintf(text, sizeof text, format, a, b, c, d);
  return {text, static_cast<std::size_t>(size)};
}

// Decimal numbers with one space or more before each; false for anything else.
bool read_numbers(std::string_view text, std::vector<std::int64_t>& numbers) {
  for (;;) {
    const std::size_t begin = text.find_first_not_of(' ');
    if (begin == std::string_view::npos) return true;
    if (begin == 0) return false;
    text.remove_prefix(begin);
    std::int64_t number = 0;
    const auto [stopped, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) return false;
    numbers.push_back(number);
    text.remove_prefix(static_cast<std::size_t>(stopped - text.data()));
  }
}

// Signed or unsigned.
bool fits_32_bits(std::int64_t value) {
  return value >= std::numeric_limits<std::int32_t>::min() && value <= std::numeric_limits<std::uint32_t>::max();
}

}  // namespace

// ---- one drive

QuickSilverDrive::QuickSilverDrive(int address, const QuickSilverProgram& program)
    : address_(address), program_(program) {
  restart();
}

void QuickSilverDrive::restart() {
  registers_.fill(0);
  position_ = velocity_ = wanted_ = acceleration_ = 0;
  poll_status_ = 0;
  program_runs_ = program_.at_power_up;
  tripped_ = false;
  unmoved_ns_ = 0;
  last_counter_ = 0;
  next_round_ns_ = std::max<std::int64_t>(now_ns_, 0);
}

std::string QuickSilverDrive::done() const {
  return printed("* %02X", address_);
}

std::string QuickSilverDrive::data(int command, std::uint32_t value, int words) const {
  if (words == 1) return printed("# %02X %04X %04X", address_, command, static_cast<int>(value));
  return printed("# %02X %04X %04X %04X", address_, command, static_cast<int>(value >> 16),
                 static_cast<int>(value & 0xFFFF));
}

std::string QuickSilverDrive::nak(int command, int code) {
  ++naks_;
  return printed("! %02X %04X %04X", address_, command & 0xFFFF, code);
}

std::string QuickSilverDrive::execute(std::string_view parameters, std::int64_t now_ns) {
  advance(now_ns);
  ++commands_;
  std::vector<std::int64_t> numbers;
  const bool good = read_numbers(parameters, numbers);
  if (numbers.empty()) return nak(0, bad_format);
  const auto command = static_cast<int>(numbers.front() & 0xFFFF);
  if (!good || !std::all_of(numbers.begin(), numbers.end(), fits_32_bits)) return nak(command, bad_format);
  numbers.erase(numbers.begin());
  return perform(command, numbers);
}

std::string QuickSilverDrive::perform(int command, const std::vector<std::int64_t>& parameters) {
  struct Known {
    int command;
    std::size_t parameters;
  };
  constexpr Known kKnown[] = {{0, 0}, {1, 1}, {2, 0}, {3, 1}, {11, 2}, {12, 1}, {15, 4}};
  const auto* known =
      std::find_if(std::begin(kKnown), std::end(kKnown), [&](const Known& k) { return k.command == command; });
  if (known == std::end(kKnown)) return nak(command, bad_command);
  if (parameters.size() != known->parameters) return nak(command, bad_format);
  switch (command) {
    case 0:  // POL
      return poll_status_ == 0 ? done() : data(command, poll_status_, 1);
    case 1:  // CPL
      poll_status_ = static_cast<std::uint16_t>(poll_status_ & ~parameters[0]);
      return done();
    case 2:  // HLT
      end_program();
      velocity_ = wanted_ = 0;
      return done();
    case 3:  // STP
      end_program();
      wanted_ = 0;
      if (parameters[0] < 0) velocity_ = 0;
      if (parameters[0] > 0) acceleration_ = static_cast<double>(parameters[0]) / kUnitsPerRevPerS2;
      return done();
    case 11:
      return write(parameters[0], parameters[1]);
    case 12:
      return read(parameters[0]);
    default:
      return velocity_mode(parameters);
  }
}

std::string QuickSilverDrive::velocity_mode(const std::vector<std::int64_t>& parameters) {
  const std::int64_t acceleration = std::abs(parameters[0]);
  if (acceleration < 1 || acceleration > 1 << 30) return nak(15, bad_format);
  end_program();
  acceleration_ = static_cast<double>(acceleration) / kUnitsPerRevPerS2;
  wanted_ = static_cast<double>(static_cast<std::int32_t>(parameters[1])) / kUnitsPerRevPerS;
  return done();
}

std::int32_t QuickSilverDrive::value(int number) const {
  if (number == 1) {
    const auto counts = static_cast<std::int64_t>(std::floor(position_));
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(counts));
  }
  return registers_.at(static_cast<std::size_t>(number));
}

std::string QuickSilverDrive::read(std::int64_t number) {
  if (number < 0 || number >= kRegisters) return nak(12, bad_format);
  return data(12, static_cast<std::uint32_t>(value(static_cast<int>(number))), 2);
}

std::string QuickSilverDrive::write(std::int64_t number, std::int64_t value) {
  if (number < kFirstWritable || number >= kRegisters) return nak(11, bad_format);
  registers_[static_cast<std::size_t>(number)] = static_cast<std::int32_t>(static_cast<std::uint32_t>(value));
  return done();
}

void QuickSilverDrive::end_program() {
  if (program_runs_) poll_status_ |= kProgramEnded;
  program_runs_ = false;
}

// One round of the loop in docs/quicksilver.md.
void QuickSilverDrive::run_program() {
  const auto at = [&](int number) -> std::int32_t& { return registers_.at(static_cast<std::size_t>(number)); };
  at(program_.signature) = program_.signature_value;
  at(program_.heartbeat) = static_cast<std::int32_t>(static_cast<std::uint32_t>(at(program_.heartbeat)) + 1U);
  if (at(program_.counter) != last_counter_) {
    last_counter_ = at(program_.counter);
    unmoved_ns_ = 0;
    tripped_ = false;
    return;
  }
  unmoved_ns_ += program_.period_ns;
  if (unmoved_ns_ < program_.patience_ns || !program_.zeroes_velocity) return;
  unmoved_ns_ = 0;
  at(program_.velocity) = 0;
  if (!tripped_) ++trips_;
  tripped_ = true;
}

// The motor follows the trajectory exactly; what it does between two steps is a ramp, then a constant.
void QuickSilverDrive::turn(double seconds) {
  if (program_runs_) {
    acceleration_ = std::abs(registers_.at(static_cast<std::size_t>(program_.acceleration))) / kUnitsPerRevPerS2;
    wanted_ = registers_.at(static_cast<std::size_t>(program_.velocity)) / kUnitsPerRevPerS;
  }
  const double change = wanted_ - velocity_;
  const double ramp_s = acceleration_ > 0 ? std::min(seconds, std::abs(change) / acceleration_) : 0;
  const double before = velocity_;
  velocity_ = ramp_s < seconds ? wanted_ : before + std::copysign(acceleration_ * seconds, change);
  position_ += ((before + velocity_) / 2 * ramp_s + velocity_ * (seconds - ramp_s)) * counts_per_rev;
}

void QuickSilverDrive::advance(std::int64_t now_ns) {
  if (now_ns_ < 0) now_ns_ = next_round_ns_ = now_ns;
  while (now_ns_ < now_ns) {
    if (now_ns_ >= next_round_ns_) {
      if (program_runs_) run_program();
      next_round_ns_ += program_.period_ns;
    }
    const std::int64_t end = std::min({now_ns, now_ns_ + kTurnStep, next_round_ns_});
    turn(static_cast<double>(end - now_ns_) / 1e9);
    now_ns_ = end;
  }
}

QuickSilverState QuickSilverDrive::state() const {
  return {.address = address_,
          .position = position_,
          .velocity_rpm = velocity_ * 60,
          .program_runs = program_runs_,
          .tripped = tripped_,
          .trips = trips_,
          .commands = commands_,
          .naks = naks_};
}

// ---- the line

QuickSilverLine::QuickSilverLine(const std::vector<int>& addresses, const QuickSilverProgram& program) {
  for (const int address : addresses)
    drives_.emplace_back(address, program);
}

QuickSilverState QuickSilverLine::state(std::size_t index, std::int64_t now_ns) {
  drives_.at(index).advance(now_ns);
  return drives_.at(index).state();
}

// The bytes are handed over at once; on the line they take their time from now on.
void QuickSilverLine::hear(std::string_view bytes, std::int64_t now_ns) {
  heard_until_ns_ = std::max(heard_until_ns_, now_ns);
  for (const char byte : bytes) {
    heard_until_ns_ += character_ns;
    if (byte == '@') {
      in_command_ = true;
      line_.clear();
    } else if (byte == '\r') {
      if (in_command_) take_line(heard_until_ns_);
      in_command_ = false;
    } else if (line_.size() <= kLongestLine) {
      line_ += byte;
    }
  }
}

void QuickSilverLine::take_line(std::int64_t heard_ns) {
  int address = 0;
  const auto [end, error] = std::from_chars(line_.data(), line_.data() + line_.size(), address);
  if (error != std::errc()) return;
  for (QuickSilverDrive& drive : drives_) {
    if (drive.address() != address || address == silent_address || !has_power) continue;
    answer(drive, std::string_view(line_).substr(static_cast<std::size_t>(end - line_.data())), heard_ns);
  }
}

void QuickSilverLine::answer(QuickSilverDrive& drive, std::string_view rest, std::int64_t heard_ns) {
  ++commands_;
  std::vector<std::int64_t> numbers;
  (void)read_numbers(rest, numbers);
  const int command = numbers.empty() ? 0 : static_cast<int>(numbers.front() & 0xFFFF);
  std::string line;
  if (line_.size() > kLongestLine) {
    line = drive.nak(command, buffer_full);
  } else if (checksum_errors) {
    line = drive.nak(command, bad_checksum);
  } else if (is_nth(nak_every)) {
    line = drive.nak(command, nak_code);
  } else {
    line = drive.execute(rest, heard_ns);
  }
  if (answers_as != 0) {
    constexpr char kDigits[] = "0123456789ABCDEF";
    line[2] = kDigits[answers_as / 16 % 16];
    line[3] = kDigits[answers_as % 16];
  }
  if (damaged) line = "# 1\x7f 00ZC";
  if (!is_nth(silent_every)) reply(line + '\r', heard_ns);
}

void QuickSilverLine::reply(const std::string& line, std::int64_t heard_ns) {
  std::int64_t time_ns = std::max(heard_ns + latency_ns + slow_ns, said_until_ns_);
  if (is_nth(garbage_every)) put("# 1\x7f 00ZC \xff?\r", time_ns, false);
  if (merge) {
    put(line + line, time_ns, true);
  } else if (split) {
    const std::size_t half = line.size() / 2;
    put(line.substr(0, half), time_ns, true);
    time_ns += 3'000'000;
    put(line.substr(half), time_ns, true);
  } else {
    put(line, time_ns, false);
  }
  said_until_ns_ = time_ns;
}

void QuickSilverLine::put(const std::string& bytes, std::int64_t& time_ns, bool at_once) {
  if (at_once) {
    time_ns += character_ns * static_cast<std::int64_t>(bytes.size());
    pieces_.push_back({time_ns, bytes});
    return;
  }
  for (const char byte : bytes) {
    time_ns += character_ns;
    pieces_.push_back({time_ns, std::string(1, byte)});
  }
}

std::string QuickSilverLine::say(std::int64_t now_ns) {
  for (QuickSilverDrive& drive : drives_)
    drive.advance(now_ns);
  std::string said;
  while (!pieces_.empty() && pieces_.front().time_ns <= now_ns) {
    said += pieces_.front().bytes;
    pieces_.pop_front();
  }
  return said;
}

}  // namespace lakshya::emulator

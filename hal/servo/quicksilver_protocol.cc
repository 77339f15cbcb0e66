#include "hal/servo/quicksilver_protocol.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace lakshya::quicksilver {
namespace {

// What a reply consists of after its mark: spaces and hexadecimal numbers.
class Fields {
 public:
  explicit Fields(std::string_view text) : rest_(text.substr(0, text.find_last_not_of(' ') + 1)) {}

  bool at_end() const { return rest_.empty(); }

  // At least one space, then a number of 1 to `digits` digits that ends at a space or with the line.
  bool number(std::size_t digits, std::uint16_t& value) {
    const std::size_t begin = rest_.find_first_not_of(' ');
    if (begin == 0 || begin == std::string_view::npos) return false;
    rest_.remove_prefix(begin);
    const std::string_view field = rest_.substr(0, rest_.find(' '));
    const char* end = field.data() + field.size();
    const auto [stopped, error] = std::from_chars(field.data(), end, value, 16);
    if (field.size() > digits || error != std::errc() || stopped != end) return false;
    rest_.remove_prefix(field.size());
    return true;
  }

 private:
  std::string_view rest_;
};

bool parse_data(Fields& fields, Reply& reply) {
  for (reply.word_count = 0; !fields.at_end(); ++reply.word_count) {
    if (reply.word_count == reply.words.size()) return false;
    if (!fields.number(4, reply.words[reply.word_count])) return false;
  }
  return reply.word_count > 0;
}

bool parse_nak(Fields& fields, Reply& reply) {
  std::uint16_t code = 0;
  if (!fields.number(4, code) || !fields.at_end()) return false;
  reply.nak_code = code;
  return true;
}

bool parse_rest(Reply::Kind kind, Fields& fields, Reply& reply) {
  std::uint16_t address = 0;
  if (!fields.number(2, address)) return false;
  reply.kind = kind;
  reply.address = address;
  if (kind == Reply::Kind::done) return fields.at_end();
  std::uint16_t command = 0;
  if (!fields.number(4, command)) return false;
  reply.command = command;
  return kind == Reply::Kind::data ? parse_data(fields, reply) : parse_nak(fields, reply);
}

Status rounded(double value, double lowest, double highest, std::int32_t& units) {
  const double nearest = std::round(value);
  if (!(nearest >= lowest && nearest <= highest)) return Status::bad_argument;
  units = static_cast<std::int32_t>(nearest);
  return Status::ok;
}

}  // namespace

CommandText::CommandText(int address, Command command, std::initializer_list<std::int32_t> parameters)
    : command_(command) {
  append('@', address);
  append(' ', static_cast<int>(command));
  for (const std::int32_t parameter : parameters)
    append(' ', parameter);
  text_[size_++] = '\r';
}

void CommandText::append(char mark, std::int32_t number) {
  std::array<char, 12> digits{};
  const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  const auto count = static_cast<std::size_t>(end - digits.data());
  if (size_ + 1 + count >= text_.size()) return;
  text_[size_++] = static_cast<std::uint8_t>(mark);
  std::copy_n(digits.data(), count, text_.data() + size_);
  size_ += count;
}

Status parse_reply(std::string_view line, Reply& reply) {
  if (line.empty()) return Status::bad_data;
  Fields fields(line.substr(1));
  bool good = false;
  if (line[0] == '*') good = parse_rest(Reply::Kind::done, fields, reply);
  if (line[0] == '#') good = parse_rest(Reply::Kind::data, fields, reply);
  if (line[0] == '!') good = parse_rest(Reply::Kind::nak, fields, reply);
  return good ? Status::ok : Status::bad_data;
}

Status register_value(const Reply& reply, std::int32_t& value) {
  if (reply.kind != Reply::Kind::data || reply.word_count != 2) return Status::bad_data;
  value = static_cast<std::int32_t>(std::uint32_t{reply.words[0]} << 16 | reply.words[1]);
  return Status::ok;
}

const char* nak_name(int code) {
  switch (code) {
    case 1:
      return "bad command";
    case kNakBusy:
      return "busy";
    case 5:
      return "bad format";
    case 6:
      return "buffer full";
    case 7:
      return "bad address";
    case 8:
      return "bad response packet request";
    case 9:
      return "locked out";
    case 10:
      return "bad checksum";
    default:
      return "unknown";
  }
}

bool LineCollector::take(std::span<const std::uint8_t>& bytes) {
  if (complete_) clear();
  while (!bytes.empty()) {
    const auto byte = static_cast<char>(bytes.front());
    bytes = bytes.subspan(1);
    if (byte == '\r') {
      complete_ = true;
      return true;
    }
    if (size_ < text_.size()) {
      text_[size_++] = byte;
    } else {
      too_long_ = true;
    }
  }
  return false;
}

void LineCollector::clear() {
  size_ = 0;
  too_long_ = false;
  complete_ = false;
}

Status velocity_units(double rpm, std::int32_t& units) {
  return rounded(rpm * kVelocityPerRpm, -2147483647.0, 2147483647.0, units);
}

Status acceleration_units(double rev_per_s2, std::int32_t& units) {
  return rounded(rev_per_s2 * kAccelerationPerRevPerS2, 1.0, 1073741824.0, units);
}

}  // namespace lakshya::quicksilver

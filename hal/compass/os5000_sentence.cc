#include "hal/compass/os5000_sentence.h"

#include <charconv>
#include <cmath>
#include <span>
#include <system_error>

namespace lakshya {
namespace {

bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}

bool is_small(char c) {
  return c >= 'a' && c <= 'z';
}

bool read_number(std::string_view text, double& value) {
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, std::chars_format::fixed);
  return error == std::errc() && stop == end && std::isfinite(value);
}

// Takes a tag off the front.
std::string_view take_tag(std::string_view& rest) {
  const std::size_t size = rest.size() > 1 && is_small(rest[1]) ? 2 : 1;
  const std::string_view tag = rest.substr(0, size);
  rest.remove_prefix(size);
  return tag;
}

std::string_view take_until(std::string_view& rest, std::size_t end) {
  const std::string_view taken = rest.substr(0, end);
  rest.remove_prefix(taken.size());
  return taken;
}

std::string_view take_field(std::string_view& rest) {
  const std::string_view field = take_until(rest, rest.find(','));
  if (!rest.empty()) rest.remove_prefix(1);
  return field;
}

double* place_of(std::string_view tag, Os5000Sentence& s) {
  struct Place {
    std::string_view tag;
    double* value;
  };
  const Place places[] = {{"C", &s.heading_deg},
                          {"P", &s.pitch_deg},
                          {"R", &s.roll_deg},
                          {"T", &s.temperature_c},
                          {"D", &s.depth},
                          {"Mx", s.field_mg.data()},
                          {"My", &s.field_mg[1]},
                          {"Mz", &s.field_mg[2]},
                          {"Ax", s.acceleration_g.data()},
                          {"Ay", &s.acceleration_g[1]},
                          {"Az", &s.acceleration_g[2]}};
  for (const Place& place : places) {
    if (place.tag == tag) return place.value;
  }
  return nullptr;
}

Status parse_tags(std::string_view rest, Os5000Sentence& sentence) {
  while (!rest.empty()) {
    if (!is_capital(rest.front())) return Status::bad_data;
    const std::string_view tag = take_tag(rest);
    double value = 0;
    if (!read_number(take_until(rest, rest.find_first_not_of("-.0123456789")), value)) return Status::bad_data;
    double* const place = place_of(tag, sentence);
    if (place == nullptr) continue;
    if (!std::isnan(*place)) return Status::bad_data;
    *place = value;
  }
  return Status::ok;
}

// An empty field is something that the device does not measure.
Status parse_fields(std::string_view rest, Os5000Sentence& s) {
  double* const places[] = {&s.heading_deg, &s.pitch_deg, &s.roll_deg, &s.temperature_c, &s.depth};
  for (double* const place : places) {
    const std::string_view field = take_field(rest);
    if (!field.empty() && !read_number(field, *place)) return Status::bad_data;
  }
  return Status::ok;
}

Status parse_true_heading(std::string_view rest, Os5000Sentence& sentence) {
  sentence.heading_is_true = true;
  const std::string_view heading = take_field(rest);
  if (!read_number(heading, sentence.heading_deg)) return Status::bad_data;
  return take_field(rest) == "T" ? Status::ok : Status::bad_data;
}

bool is_within(double value, double low, double high) {
  return std::isnan(value) || (value >= low && value <= high);
}

int digit_of(char hex) {
  if (hex >= '0' && hex <= '9') return hex - '0';
  if (hex >= 'A' && hex <= 'F') return hex - 'A' + 10;
  if (hex >= 'a' && hex <= 'f') return hex - 'a' + 10;
  return -1;
}

}  // namespace

Status nmea_content(std::string_view line, std::string_view& content) {
  constexpr std::size_t kAround = 4;  // '$', '*' and two digits
  if (line.size() < kAround || line.front() != '$' || line[line.size() - 3] != '*') return Status::bad_data;
  const int high = digit_of(line[line.size() - 2]);
  const int low = digit_of(line[line.size() - 1]);
  if (high < 0 || low < 0) return Status::bad_data;
  const std::string_view inside = line.substr(1, line.size() - kAround);
  unsigned sum = 0;
  for (const char c : inside)
    sum ^= static_cast<unsigned char>(c);
  if (sum != static_cast<unsigned>(16 * high + low)) return Status::bad_data;
  content = inside;
  return Status::ok;
}

Status parse_os5000(std::string_view content, Os5000Sentence& sentence) {
  constexpr std::string_view kByPlace = "OHPR,";
  constexpr std::string_view kTrueHeading = "HCHDT,";
  sentence = {};
  Status status = Status::ok;
  if (content.starts_with(kByPlace)) {
    status = parse_fields(content.substr(kByPlace.size()), sentence);
  } else if (content.starts_with(kTrueHeading)) {
    status = parse_true_heading(content.substr(kTrueHeading.size()), sentence);
  } else {
    status = parse_tags(content, sentence);
  }
  if (status != Status::ok) return status;
  const bool plausible = is_within(sentence.heading_deg, 0, 360) && is_within(sentence.pitch_deg, -90, 90) &&
                         is_within(sentence.roll_deg, -180, 180);
  return plausible && !std::isnan(sentence.heading_deg) ? Status::ok : Status::bad_data;
}

bool NmeaLines::push(std::uint8_t byte) {
  if (state_ == State::complete) state_ = State::skipping;
  if (byte == '$') {
    if (state_ == State::reading) ++given_up_;
    state_ = State::reading;
    size_ = 0;
  }
  if (state_ == State::skipping) return false;
  if (byte == '\r' || byte == '\n') {
    state_ = State::complete;
    return true;
  }
  if (size_ == kLongest) {
    ++given_up_;
    state_ = State::skipping;
    return false;
  }
  text_[size_++] = static_cast<char>(byte);
  return false;
}

}  // namespace lakshya

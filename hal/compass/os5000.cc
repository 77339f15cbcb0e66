#include "hal/compass/os5000.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "hal/compass/attitude.h"

namespace lakshya {
namespace {

constexpr Nanoseconds kBetweenCharacters = 100 * kMillisecond;
constexpr int kHeadingPitchRoll = 1 + 2 + 4;
// "$C359.9P-89.9R-179.9*hh" and its end: what the rate and the line's speed must have room for.
constexpr int kLongestAskedFor = 25;
constexpr int kBitsPerByte = 10;
// Reads of what is waiting, in one call: 8192 bytes, more than comes in kLongestPause (40 sentences of 82 bytes a second).
constexpr int kMostDrains = 32;
// A terminal that is full keeps the oldest bytes, and how many it keeps (4096, and what lies before them in the kernel) is
// not to be relied on. For so long it holds everything, so that the newest sentence is a new one.
constexpr Nanoseconds kLongestPause = kSecond;

enum { kBadChecksums, kBadSentences, kTimeouts, kDisconnections };

bool is_angle(double deg) {
  return deg >= -180 && deg <= 180;
}

bool is_sign(int sign) {
  return sign == 1 || sign == -1;
}

}  // namespace

Os5000::Os5000(const Os5000Settings& settings, SerialPort& port, Clock& clock)
    : settings_(settings), port_(&port), clock_(&clock) {}

Os5000::~Os5000() {
  Os5000::close();
}

Status Os5000::check_settings() {
  const Os5000Settings& s = settings_;
  const struct {
    bool holds;
    const char* otherwise;
  } rules[] = {
      {s.baud >= 1200 && s.baud <= 230400, "baud is not 1200 to 230400"},
      {s.rate_hz >= 1 && s.rate_hz <= 40, "rate_hz is not 1 to 40"},
      {s.rate_hz <= s.baud / (kLongestAskedFor * kBitsPerByte), "rate_hz is more than the line can carry"},
      {is_angle(s.declination_deg), "declination_deg is not -180 to 180"},
      {is_angle(s.mounting_deg), "mounting_deg is not -180 to 180"},
      {is_sign(s.pitch_sign) && is_sign(s.roll_sign), "pitch_sign or roll_sign is not 1 or -1"},
  };
  for (const auto& rule : rules) {
    if (rule.holds) continue;
    problem_.set("OS5000: settings: %s", rule.otherwise);
    return Status::bad_argument;
  }
  return Status::ok;
}

void Os5000::write_commands() {
  commands_size_ = 0;
  if (!settings_.set_up) return;
  const char end = settings_.commands_end_with_space ? ' ' : '\r';
  const int size = std::snprintf(commands_.data(), commands_.size(), "\x1bR%d%c\x1bX%d%c", settings_.rate_hz, end,
                                 kHeadingPitchRoll, end);
  commands_size_ = static_cast<std::size_t>(size);
}

// On a port that has just been opened.
void Os5000::begin() {
  port_->discard_input();
  lines_.clear();
  has_newest_ = has_damage_ = false;
  sent_ = 0;
  next_character_ = clock_->now();
}

Status Os5000::open() {
  close();
  Status status = check_settings();
  if (status != Status::ok) return status;
  write_commands();
  status = port_->open();
  if (status != Status::ok) {
    problem_.set("OS5000: %s", port_->problem());
    return status;
  }
  begin();
  status = send_all();
  // What has come until now may have been made before the commands.
  port_->discard_input();
  if (status == Status::ok) status = receive(clock_->now() + kSecond + 2 * kSecond / settings_.rate_hz);
  if (status != Status::ok) {
    port_->close();
    return status;
  }
  is_open_ = true;
  listened_ = clock_->now();
  return Status::ok;
}

void Os5000::close() {
  is_open_ = false;
  port_->close();
}

// The next character of the commands, if it is time for it.
Status Os5000::send_next(Nanoseconds deadline) {
  const Nanoseconds now = clock_->now();
  if (sent_ == commands_size_ || now < next_character_) return Status::ok;
  next_character_ = now + kBetweenCharacters;
  const auto character = static_cast<std::uint8_t>(commands_[sent_]);
  const Status status = port_->write({&character, 1}, std::min(deadline, next_character_));
  if (status == Status::ok) ++sent_;
  return status;
}

Status Os5000::send_all() {
  while (sent_ < commands_size_) {
    const Status status = send_next(next_character_ + kBetweenCharacters);
    if (status == Status::timeout) problem_.set("OS5000: the port takes no bytes");
    if (status == Status::timeout) ++counters_[kTimeouts].value;
    if (status == Status::disconnected) return lose();
    if (status != Status::ok) return status;
    clock_->sleep_until(next_character_);
  }
  return Status::ok;
}

Status Os5000::read(Nanoseconds deadline, HeadingSample& sample) {
  if (!is_open_) {
    problem_.set("OS5000: is not open");
    return Status::disconnected;
  }
  if (!port_->is_open() && !look_again(deadline)) return Status::disconnected;
  if (clock_->now() - listened_ > kLongestPause) {
    port_->discard_input();
    lines_.clear();
  }
  const Status status = receive(deadline);
  listened_ = clock_->now();
  if (status == Status::ok) sample = newest_;
  return status;
}

// Waits for a sentence; when there is one, takes what else is waiting and keeps the newest.
Status Os5000::receive(Nanoseconds deadline) {
  has_newest_ = has_damage_ = false;
  for (int drains = 0; drains < kMostDrains;) {
    const Nanoseconds now = clock_->now();
    const bool waits = !has_newest_ && now < deadline;
    if (!waits) ++drains;
    if (send_next(deadline) == Status::disconnected) return lose();
    Nanoseconds until = waits ? deadline : now;
    if (waits && sent_ < commands_size_) until = std::min(deadline, next_character_);
    std::size_t count = 0;
    const Status status = port_->read(buffer_, until, count);
    if (status == Status::ok) {
      take({buffer_.data(), count}, clock_->now());
    } else if (status != Status::timeout) {
      return lose();
    } else if (!waits) {
      break;
    }
  }
  if (has_newest_) return Status::ok;
  if (has_damage_) {
    problem_.set("OS5000: no sentence that can be used");
    return Status::bad_data;
  }
  ++counters_[kTimeouts].value;
  problem_.set("OS5000: no sentence came");
  return Status::timeout;
}

void Os5000::take(std::span<const std::uint8_t> bytes, Nanoseconds arrival) {
  const std::uint64_t given_up = lines_.given_up();
  auto still_to_come = static_cast<Nanoseconds>(bytes.size());  // when this byte began to be sent
  for (const std::uint8_t byte : bytes) {
    if (byte == '$') line_time_ = arrival - still_to_come * kBitsPerByte * kSecond / settings_.baud;
    --still_to_come;
    if (lines_.push(byte)) take_line(lines_.line());
  }
  counters_[kBadSentences].value += lines_.given_up() - given_up;
  has_damage_ = has_damage_ || lines_.given_up() != given_up;
}

void Os5000::take_line(std::string_view line) {
  std::string_view content;
  Os5000Sentence sentence;
  const bool is_whole = nmea_content(line, content) == Status::ok;
  if (!is_whole || parse_os5000(content, sentence) != Status::ok) {
    ++counters_[is_whole ? kBadSentences : kBadChecksums].value;
    has_damage_ = true;
    return;
  }
  const double heading_deg = sentence.heading_deg + (sentence.heading_is_true ? 0 : settings_.declination_deg);
  const HeadingSample device = {.yaw = std::numbers::pi / 2 - heading_deg * kRadiansPerDegree,
                                .pitch = settings_.pitch_sign * sentence.pitch_deg * kRadiansPerDegree,
                                .roll = settings_.roll_sign * sentence.roll_deg * kRadiansPerDegree,
                                .time = std::max(line_time_, newest_.time)};
  newest_ = seen_from_vehicle(device, settings_.mounting_deg * kRadiansPerDegree);
  has_newest_ = true;
}

bool Os5000::look_again(Nanoseconds deadline) {
  if (!retry_.wait(*clock_, deadline)) return false;
  if (port_->open() != Status::ok) {
    problem_.set("OS5000: %s", port_->problem());
    return false;
  }
  begin();
  return true;
}

// What was understood before the port went is still given.
Status Os5000::lose() {
  problem_.set("OS5000: %s", port_->problem());
  port_->close();
  retry_.lost(clock_->now());
  ++counters_[kDisconnections].value;
  return has_newest_ ? Status::ok : Status::disconnected;
}

}  // namespace lakshya

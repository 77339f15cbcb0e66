#include "tests/emulators/os5000_device.h"

#include <cmath>
#include <cstdio>

namespace lakshya::emulator {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;
constexpr char kEscape = '\x1b';

std::string tenths(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

bool every(int count, int n) {
  return n > 0 && count % n == n - 1;
}

std::string framed(const std::string& content, bool wrongly) {
  int sum = wrongly ? 1 : 0;
  for (const char c : content)
    sum ^= c;
  char end[8];
  std::snprintf(end, sizeof end, "*%02X\r\n", static_cast<unsigned>(sum & 0xff));
  return "$" + content + end;
}

}  // namespace

void Os5000Device::hear(std::string_view bytes, std::int64_t now_ns) {
  for (const char c : bytes)
    hear_character(c, now_ns);
}

void Os5000Device::hear_character(char c, std::int64_t now_ns) {
  const bool too_soon = last_heard_ns_ != 0 && now_ns - last_heard_ns_ < deaf_ms * (kSecondNs / 1000);
  last_heard_ns_ = now_ns;
  if (too_soon) {
    ++characters_lost;
    return;
  }
  if (c == kEscape) {
    hears_ = Hears::letter;
  } else if (hears_ == Hears::letter) {
    letter_ = c;
    number_.clear();
    hears_ = Hears::number;
  } else if (hears_ == Hears::number && (c == ' ' || c == '\r')) {
    if (number_.empty()) return;
    hears_ = Hears::nothing;
    obey();
  } else if (hears_ == Hears::number && ((c >= '0' && c <= '9') || c == '-') && number_.size() < 6) {
    number_ += c;
  } else {
    hears_ = Hears::nothing;
  }
}

void Os5000Device::obey() {
  int value = 0;
  if (std::sscanf(number_.c_str(), "%d", &value) != 1) return;
  if (letter_ == 'R' && value >= -50 && value <= 40) {
    rate_hz = value;
  } else if (letter_ == 'X' && value >= 0) {
    fields = value;
  } else {
    return;
  }
  ++commands_obeyed;
  next_ns_ = last_heard_ns_ + period_ns();
}

std::int64_t Os5000Device::period_ns() const {
  return rate_hz > 0 ? kSecondNs / rate_hz : kSecondNs * (rate_hz < 0 ? -rate_hz : 1);
}

double Os5000Device::heading_at(std::int64_t now_ns) const {
  const double turned = runs_ ? turn_dps * static_cast<double>(now_ns - start_ns_) / kSecondNs : 0;
  const double heading = std::fmod(heading_deg + turned, 360.0);
  return heading < 0 ? heading + 360 : heading;
}

std::string Os5000Device::sentence(std::int64_t now_ns) {
  const std::string heading = tenths(heading_at(now_ns));
  std::string content;
  if (format == Format::true_heading) {
    content = "HCHDT," + heading + ",T";
  } else if (format == Format::by_place) {
    content = "OHPR," + heading + "," + tenths(pitch_deg) + "," + tenths(roll_deg) + "," + tenths(temperature_c) +
              ",0.0,0,0,0";
  } else {
    content = "C";
    if ((fields & 1) != 0) content += heading;
    if ((fields & 2) != 0) content += "P" + tenths(pitch_deg);
    if ((fields & 4) != 0) content += "R" + tenths(roll_deg);
    if ((fields & 8) != 0) content += "T" + tenths(temperature_c);
  }
  std::string text = framed(content, every(said_, wrong_checksum_every));
  if (every(said_, garbage_every)) text.insert(0, "\xff\x80*7\r$C12");
  ++said_;
  return text;
}

// Byte after byte, each when its stop bit has passed.
void Os5000Device::send(const std::string& text, std::int64_t now_ns) {
  line_free_ns_ = std::max(line_free_ns_, now_ns);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (split && i == text.size() / 2) line_free_ns_ += period_ns() / 3;
    line_free_ns_ += 10 * kSecondNs / baud;
    line_.push_back({line_free_ns_, text[i]});
  }
}

std::string Os5000Device::say(std::int64_t now_ns) {
  if (!runs_) {
    runs_ = true;
    start_ns_ = now_ns;
    next_ns_ = now_ns + period_ns();
  }
  for (; next_ns_ <= now_ns; next_ns_ += period_ns()) {
    if (rate_hz == 0 || silent) continue;
    held_ += sentence(next_ns_);
    if (merge && said_ % 2 == 1) continue;
    send(held_, next_ns_);
    held_.clear();
  }
  if (merge && !line_.empty() && line_.back().time_ns > now_ns) return {};
  std::string out;
  for (; !line_.empty() && line_.front().time_ns <= now_ns; line_.pop_front())
    out += line_.front().value;
  return out;
}

}  // namespace lakshya::emulator

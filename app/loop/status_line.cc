#include "app/loop/status_line.h"

#include <spdlog/spdlog.h>

#include <cstdio>

#include "hal/angle.h"

namespace lakshya {
namespace {

constexpr Nanoseconds kLivePeriod = 100 * kMillisecond;
constexpr Nanoseconds kLogPeriod = 5 * kSecond;

}  // namespace

std::string status_text(const StatusNote& s, Nanoseconds start) {
  const double speed = (s.wheels.left_mps + s.wheels.right_mps) / 2;
  const std::string way =
      s.blocked ? "no way open"
                : fmt::format("to {:+.0f} deg, clear {:.1f} m", s.direction / kRadiansPerDegree, s.clear_m);
  std::string text = fmt::format(
      "{:<8} {:6.1f} s  at {:.2f} {:.2f} m, {:.0f} deg  {:.2f} m/s  {}  nearest {}  frame {} {:.1f} ms",
      to_string(s.state), static_cast<double>(s.time - start) / 1e9, s.pose.east_m, s.pose.north_m,
      s.pose.yaw / kRadiansPerDegree, speed, way, s.nearest_m < 0 ? "-" : fmt::format("{:.1f} m", s.nearest_m),
      s.frames, static_cast<double>(s.frame_time) / 1e6);
  if (s.reason != Event::all_well) text += fmt::format("  {}", to_string(s.reason));
  return text;
}

std::string note_text(const StateNote& n) {
  if (n.from == n.to) return fmt::format("{}: {} ({})", to_string(n.to), to_string(n.event), meaning(n.event));
  return fmt::format("{} -> {}: {} ({})", to_string(n.from), to_string(n.to), to_string(n.event), meaning(n.event));
}

void StatusLine::clear() {
  if (is_shown_) std::fputs("\r\033[K", stderr);
  is_shown_ = false;
}

void StatusLine::show(const StatusNote& status) {
  if (status.time < next_) return;
  next_ = status.time + (live_ ? kLivePeriod : kLogPeriod);
  if (!live_) {
    spdlog::info("{}", status_text(status, start_));
    return;
  }
  std::fputs(("\r" + status_text(status, start_) + "\033[K").c_str(), stderr);
  std::fflush(stderr);
  is_shown_ = true;
}

void StatusLine::log(const StateNote& note) {
  clear();
  const bool bad = kind_of(note.event) != Kind::course;
  spdlog::log(bad ? spdlog::level::warn : spdlog::level::info, "{:.3f} s: {}",
              static_cast<double>(note.time - start_) / 1e9, note_text(note));
}

}  // namespace lakshya

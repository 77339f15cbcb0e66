// One line on stderr that is written over while a long command runs: [#####.....] 12/34 name, 1 min 20 s left
#pragma once

#include <cstdint>
#include <iostream>
#include <string>

#include "hal/clock/monotonic_clock.h"

namespace lakshya {

// "45 s", "3 min 5 s", "2 h 10 min"
inline std::string duration_text(std::int64_t seconds) {
  if (seconds < 60) return std::to_string(seconds) + " s";
  if (seconds < 3600) return std::to_string(seconds / 60) + " min " + std::to_string(seconds % 60) + " s";
  return std::to_string(seconds / 3600) + " h " + std::to_string(seconds % 3600 / 60) + " min";
}

class Progress {
 public:
  explicit Progress(std::size_t steps) : steps_(steps), start_(clock_.now()) {}
  ~Progress() { std::cerr << "\r\033[K" << std::flush; }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // The next step begins.
  void next(const std::string& what) {
    const std::string text = what + time_left();
    show(done_, done_ + 1, text);
    ++done_;
  }
  // So many steps are done.
  void done(std::size_t steps, const std::string& what) {
    done_ = steps;
    show(done_, done_, what + time_left());
  }

 private:
  // As if all steps took the same time.
  std::string time_left() const {
    if (done_ == 0 || done_ >= steps_) return "";
    const double per_step = static_cast<double>(clock_.now() - start_) / static_cast<double>(done_);
    return ", " + duration_text(static_cast<std::int64_t>(per_step * static_cast<double>(steps_ - done_) / 1e9)) +
           " left";
  }
  void show(std::size_t done, std::size_t number, const std::string& what) const {
    constexpr std::size_t kWidth = 30;
    const std::size_t filled = kWidth * done / steps_;
    std::cerr << "\r\033[K[" << std::string(filled, '#') << std::string(kWidth - filled, '.') << "] " << number
              << "/" << steps_ << " " << what << std::flush;
  }

  const MonotonicClock clock_;
  std::size_t steps_;
  Nanoseconds start_;
  std::size_t done_ = 0;
};

}  // namespace lakshya

// One line on stderr that is written over while a long command runs: [#####.....] 12/34 name
#pragma once

#include <iostream>
#include <string>

namespace lakshya {

class Progress {
 public:
  explicit Progress(std::size_t steps) : steps_(steps) {}
  ~Progress() { std::cerr << "\r\033[K" << std::flush; }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void next(const std::string& what) {
    constexpr std::size_t kWidth = 30;
    const std::size_t filled = kWidth * done_ / steps_;
    std::cerr << "\r\033[K[" << std::string(filled, '#') << std::string(kWidth - filled, '.') << "] " << ++done_
              << "/" << steps_ << " " << what << std::flush;
  }

 private:
  std::size_t steps_;
  std::size_t done_ = 0;
};

}  // namespace lakshya

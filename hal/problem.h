// A line of text about the last failure, in fixed memory.
#pragma once

#include <array>
#include <cstdarg>
#include <cstdio>

namespace lakshya {

class Problem {
 public:
  const char* text() const { return text_.data(); }
  void clear() { text_[0] = '\0'; }

  // As printf; cut after 159 characters.
  [[gnu::format(printf, 2, 3)]] void set(const char* format, ...) {
    std::va_list arguments;
    va_start(arguments, format);
    (void)std::vsnprintf(text_.data(), text_.size(), format, arguments);
    va_end(arguments);
  }

 private:
  std::array<char, 160> text_{};
};

}  // namespace lakshya

// For readers of text files: lines, numbers, and how a refusal names a value.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lakshya {

// Where a value comes from, for messages.
struct InputKey {
  const std::string& source;
  std::string name;

  [[noreturn]] void refuse(const std::string& reason) const;
};

std::string_view trimmed(std::string_view text);

// Calls f(line) for every line, without its line end.
template <class F>
void for_each_line(std::string_view text, F f) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    f(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  }
}

// Short and printable, whatever the file holds.
std::string shown(std::string_view text);
std::string shown(double value);

// A finite decimal number and nothing else.
double parse_number(const InputKey& key, std::string_view text);

}  // namespace lakshya

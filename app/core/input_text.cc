#include "app/core/input_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <system_error>

#include "app/core/input_error.h"

namespace lakshya {

void InputKey::refuse(const std::string& reason) const {
  throw InputError(source, name + ": " + reason);
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\f\v";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

std::string shown(std::string_view text) {
  constexpr std::size_t kLength = 24;
  std::string out(text.substr(0, kLength));
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + out + (text.size() > kLength ? "...'" : "'");
}

std::string shown(double value) {
  std::array<char, 32> out{};
  const int length = std::snprintf(out.data(), out.size(), "%.10g", value);
  return {out.data(), static_cast<std::size_t>(length)};
}

double parse_number(const InputKey& key, std::string_view text) {
  std::string_view digits = trimmed(text);
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) key.refuse(shown(text) + " is out of range (write decimal numbers)");
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    key.refuse(shown(text) + " is not a number (write decimal numbers)");
  }
  if (!std::isfinite(value)) key.refuse(shown(text) + " is not a finite number (write decimal numbers)");
  return value;
}

}  // namespace lakshya

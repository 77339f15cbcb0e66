#include "hal/compass/iio_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace lakshya {

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kAround = " \t\r\n";
  const std::size_t begin = std::min(text.find_first_not_of(kAround), text.size());
  const std::size_t end = text.find_last_not_of(kAround);
  return end == std::string_view::npos ? std::string_view() : text.substr(begin, end + 1 - begin);
}

Status parse_iio_number(std::string_view text, double& value) {
  const std::string_view number = without_blanks(text);
  const char* const end = number.data() + number.size();
  const auto [stop, error] = std::from_chars(number.data(), end, value);
  return error == std::errc() && stop == end && std::isfinite(value) ? Status::ok : Status::bad_data;
}

Status parse_iio_matrix(std::string_view text, Matrix3& matrix) {
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    const bool is_last = i + 1 == matrix.size();
    const std::size_t end = is_last ? text.size() : text.find_first_of(",;");
    if (end == std::string_view::npos || (!is_last && text[end] != (i % 3 == 2 ? ';' : ',')))
      return Status::bad_data;
    if (parse_iio_number(text.substr(0, end), matrix[i]) != Status::ok) return Status::bad_data;
    if (!is_last) text.remove_prefix(end + 1);
  }
  return Status::ok;
}

}  // namespace lakshya

// How one line of the list of configuration keys is made.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace lakshya {

struct Key {
  std::string_view name;     // "group.field"
  std::string_view unit;     // empty: a pure number or a name
  std::string_view meaning;  // one sentence without its full stop
};

// Allowed values: min and max included; step 0: any, else min plus whole steps.
struct Range {
  double min = 0;
  double max = 0;
  double step = 0;
};

using Names = std::span<const std::string_view>;

// Any text of at most so many bytes without control characters, quotes and backslashes; it may be empty.
struct Text {
  std::size_t longest = 200;
};

inline constexpr std::array<std::string_view, 2> kNoYes{"no", "yes"};

}  // namespace lakshya

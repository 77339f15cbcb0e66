// A fuzz target is one file tests/fuzz/NAME_fuzz.cc that defines the two functions below; fuzz_main.cc calls them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lakshya::fuzz {

using Bytes = std::span<const std::uint8_t>;

// Hands the bytes to the reader. Only InputError may come out.
void read(Bytes bytes);

// Small valid inputs to start from: read() accepts each of them.
std::vector<std::string> seeds();

inline std::string text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

inline Bytes bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace lakshya::fuzz

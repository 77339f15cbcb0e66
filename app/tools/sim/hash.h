// Integer hashes: the simulator's only source of chance. The same numbers on every machine and for any number of threads.
#pragma once

#include <cstdint>

namespace lakshya::sim {

// Mixes all bits (the finaliser "lowbias32" of C. Wellons, "Prospecting for Hash Functions", 2018).
constexpr std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7FEB352DU;
  x = (x ^ (x >> 15)) * 0x846CA68BU;
  return x ^ (x >> 16);
}

constexpr std::uint32_t hash_of(std::uint32_t a, std::uint32_t b = 0, std::uint32_t c = 0) {
  return mixed(mixed(mixed(a) + 0x9E3779B9U + b) + 0x85EBCA6BU + c);
}

// 0 <= value < 1, of the upper 24 bits.
constexpr float unit_of(std::uint32_t hash) {
  return static_cast<float>(hash >> 8) * 0x1p-24F;
}

}  // namespace lakshya::sim

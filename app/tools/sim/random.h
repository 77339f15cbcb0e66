// Random numbers that are the same on every machine and with every standard library: splitmix64 (Steele, Lea, Flood 2014).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace lakshya::sim {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(next() >> 11) * 0x1p-53);
  }

  struct Range {
    double low;
    double high;
  };

  // One of each range, the last range first. For the arguments of one call, whose order is else the compiler's choice: a world would
  // not be the same on every processor.
  template <std::size_t count>
  std::array<double, count> from_last(const Range (&ranges)[count]) {
    std::array<double, count> drawn{};
    for (std::size_t i = count; i-- > 0;)
      drawn[i] = uniform(ranges[i].low, ranges[i].high);
    return drawn;
  }

  // low..high, both included.
  int integer(int low, int high) {
    return low + static_cast<int>(next() % static_cast<std::uint64_t>(high - low + 1));
  }

  bool chance(double share) { return uniform(0, 1) < share; }

  // Standard normal (Box and Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2 * std::log(uniform(1e-300, 1)));
    return radius * std::cos(uniform(0, 2 * std::numbers::pi));
  }

  std::uint32_t seed() { return static_cast<std::uint32_t>(next() >> 32); }

 private:
  std::uint64_t state_;
};

}  // namespace lakshya::sim

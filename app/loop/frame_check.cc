#include "app/loop/frame_check.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace lakshya {
namespace {

constexpr std::uint64_t kPrime = 0x100000001b3;
constexpr std::uint64_t kBasis = 0xcbf29ce484222325;
constexpr std::size_t kLanes = 4;
using Lanes = std::array<std::uint64_t, kLanes>;

void mix(std::uint64_t& hash, std::uint64_t word) {
  hash = (hash ^ word) * kPrime;
  hash ^= hash >> 32;  // the product's upper half must reach the lower one
}

void hash_row(const std::uint8_t* bytes, std::size_t count, Lanes& lanes) {
  std::size_t i = 0;
  for (; i + kLanes * sizeof(std::uint64_t) <= count; i += kLanes * sizeof(std::uint64_t)) {
    Lanes words;
    std::memcpy(words.data(), bytes + i, sizeof words);
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      mix(lanes[lane], words[lane]);
  }
  for (; i < count; ++i)
    mix(lanes[i % kLanes], bytes[i]);
}

}  // namespace

BrightnessShares brightness_shares(ImageView<const std::uint8_t> image, const BrightnessLevels& levels) {
  std::uint64_t dark = 0;
  std::uint64_t bright = 0;
  for (int v = 0; v < image.height; ++v) {
    const std::uint8_t* row = image.row(v);
    std::uint32_t row_dark = 0;
    std::uint32_t row_bright = 0;
    for (int u = 0; u < image.width; ++u) {
      row_dark += row[u] <= levels.dark ? 1U : 0U;
      row_bright += row[u] >= levels.bright ? 1U : 0U;
    }
    dark += row_dark;
    bright += row_bright;
  }
  const double pixels = std::max(1.0, static_cast<double>(image.width) * image.height);
  return {static_cast<double>(dark) / pixels, static_cast<double>(bright) / pixels};
}

std::uint64_t copy_and_hash(ImageView<const std::uint8_t> from, ImageView<std::uint8_t> to) {
  Lanes lanes;
  lanes.fill(kBasis);
  for (int v = 0; v < from.height; ++v) {
    const auto bytes = static_cast<std::size_t>(from.width);
    std::memcpy(to.row(v), from.row(v), bytes);
    hash_row(to.row(v), bytes, lanes);
  }
  std::uint64_t hash = kBasis;
  for (const std::uint64_t lane : lanes)
    mix(hash, lane);
  return hash;
}

}  // namespace lakshya

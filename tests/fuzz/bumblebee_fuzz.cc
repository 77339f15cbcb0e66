// A frame of Point Grey's stereo format: pattern, size and bytes per line in the first 4 bytes, then the bytes of the frame.
#include <algorithm>
#include <cstdlib>
#include <memory>

#include "hal/camera/bumblebee.h"
#include "tests/fuzz/fuzz.h"

namespace lakshya::fuzz {
namespace {

constexpr std::size_t kHead = 4;

void require(bool holds) {
  if (!holds) std::abort();
}

// On the heap to the byte, so that the sanitizer sees every step outside.
struct Plane {
  Plane(int width, int height)
      : memory(new std::uint8_t[static_cast<std::size_t>(width) * static_cast<std::size_t>(height)]),
        view(memory.get(), width, height) {}
  std::unique_ptr<std::uint8_t[]> memory;
  ImageView<std::uint8_t> view;
};

// The luma of a mosaic lies between its least and its greatest byte.
void check_range(const Plane& mosaic, const Plane& grey) {
  const std::ptrdiff_t count = mosaic.view.stride * mosaic.view.height;
  const auto [least, most] = std::minmax_element(mosaic.memory.get(), mosaic.memory.get() + count);
  const auto [darkest, brightest] = std::minmax_element(grey.memory.get(), grey.memory.get() + count);
  require(*darkest >= *least && *brightest <= *most);
}

}  // namespace

void read(Bytes bytes) {
  if (bytes.size() < kHead) return;
  const auto pattern = static_cast<BayerPattern>(bytes[0] % 5);
  const int width = bytes[1];
  const int height = bytes[2];
  const std::size_t line = std::size_t{bytes[3]} * 2;
  const std::size_t size = bytes.size() - kHead;
  const auto copy = std::make_unique<std::uint8_t[]>(size);
  std::copy(bytes.begin() + kHead, bytes.end(), copy.get());

  const Plane first(width, height);
  const Plane second(width, height);
  const Status split = split_bytes({copy.get(), size}, line, first.view, second.view);
  if (split != Status::ok) return;
  require(line * static_cast<std::size_t>(height - 1) + 2 * static_cast<std::size_t>(width) <= size);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const std::size_t at = static_cast<std::size_t>(v) * line + 2 * static_cast<std::size_t>(u);
      require(first.view.at(u, v) == copy[at] && second.view.at(u, v) == copy[at + 1]);
    }
  }
  const Plane grey(width, height);
  if (grey_of_bayer(first.view, pattern, grey.view) == Status::ok) check_range(first, grey);
}

std::vector<std::string> seeds() {
  std::string pixels;
  for (int i = 0; i < 12 * 8; ++i)
    pixels += static_cast<char>(i * i / 7);
  const auto seed = [&](char pattern) { return std::string{pattern, 6, 8, 6} + pixels; };
  return {seed(0), seed(1), seed(4)};
}

}  // namespace lakshya::fuzz

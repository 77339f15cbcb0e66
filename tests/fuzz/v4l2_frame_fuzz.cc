// A capture buffer: format, size and bytes per line in the first 5 bytes, then what the driver filled.
#include <algorithm>
#include <cstdlib>
#include <memory>

#include "hal/camera/v4l2_frame.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/jpeg_picture.h"

namespace lakshya::fuzz {
namespace {

constexpr std::size_t kHead = 5;

void require(bool holds) {
  if (!holds) std::abort();
}

// On the heap to the byte, so that the sanitizer sees every step outside.
struct Outcome {
  Outcome(const V4l2Picture& picture, Bytes used)
      : size(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height)),
        memory(new std::uint8_t[size]) {
    std::fill_n(memory.get(), size, std::uint8_t{0});
    status = grey_picture(picture, used, {memory.get(), picture.width, picture.height}, grey);
  }
  std::size_t size;
  std::unique_ptr<std::uint8_t[]> memory;
  ImageView<const std::uint8_t> grey;
  Status status;
};

void check_pixels(const V4l2Picture& picture, Bytes used, const Outcome& outcome) {
  const std::size_t step = picture.format == V4l2Format::yuyv ? 2 : 1;
  for (int v = 0; v < picture.height; ++v) {
    for (int u = 0; u < picture.width; ++u) {
      const std::uint8_t seen = half(outcome.grey, u >= picture.width / 2 ? 1 : 0)
                                    .at(u >= picture.width / 2 ? u - picture.width / 2 : u, v);
      const std::size_t at =
          static_cast<std::size_t>(v) * picture.bytes_per_line + static_cast<std::size_t>(u) * step;
      if (picture.format != V4l2Format::mjpg) require(seen == used[at]);
      require(seen == outcome.grey.at(u, v));
    }
  }
}

std::string seed(char format, int width, int height, int bytes_per_line, const std::string& used) {
  return std::string{format, static_cast<char>(width), static_cast<char>(height),
                     static_cast<char>(bytes_per_line & 0xFF), static_cast<char>(bytes_per_line >> 8)} +
         used;
}

}  // namespace

void read(Bytes bytes) {
  if (bytes.size() < kHead) return;
  V4l2Picture picture;
  picture.format = static_cast<V4l2Format>(bytes[0] % 3);
  picture.width = bytes[1] & ~1;
  picture.height = bytes[2];
  picture.bytes_per_line = bytes[3] | std::size_t{bytes[4]} << 8;
  const auto copy = std::make_unique<std::uint8_t[]>(bytes.size() - kHead);
  std::copy(bytes.begin() + kHead, bytes.end(), copy.get());
  const Bytes used(copy.get(), bytes.size() - kHead);

  const Outcome outcome(picture, used);
  const Outcome again(picture, used);
  require(outcome.status == again.status);
  require(is_possible(picture) == (outcome.status != Status::bad_argument));
  if (outcome.status != Status::ok) return;
  require(used.size() >= picture_bytes(picture));
  require(std::equal(outcome.memory.get(), outcome.memory.get() + outcome.size, again.memory.get()));
  check_pixels(picture, used, outcome);
}

std::vector<std::string> seeds() {
  std::string luma;
  for (int i = 0; i < 24 * 16 * 2; ++i)
    luma += static_cast<char>(i * i / 7);
  const ImageView<const std::uint8_t> grey(bytes_of(luma).data(), 24, 16);
  const auto text = [](const test::JpegBytes& jpeg) { return std::string(jpeg.begin(), jpeg.end()); };
  return {seed(0, 24, 16, 30, luma), seed(1, 24, 16, 48, luma), seed(2, 24, 16, 0, text(test::jpeg_of(grey))),
          seed(2, 24, 16, 0, text(test::without_tables(test::jpeg_of(grey, TJSAMP_420))))};
}

}  // namespace lakshya::fuzz

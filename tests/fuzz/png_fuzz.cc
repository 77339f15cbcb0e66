#include <zlib.h>

#include <cstddef>

#include "app/core/file_bytes.h"
#include "app/core/image_codecs.h"
#include "app/core/image_file.h"
#include "app/core/input_error.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/temp_folder.h"

namespace lakshya::fuzz {
namespace {

constexpr std::size_t kSignature = 8;
constexpr std::size_t kAroundData = 12;  // length, type and checksum of a chunk

std::uint32_t big_endian(const std::vector<std::uint8_t>& file, std::size_t at) {
  return std::uint32_t{file[at]} << 24 | std::uint32_t{file[at + 1]} << 16 | std::uint32_t{file[at + 2]} << 8 |
         file[at + 3];
}

// Wrong checksums would stop nearly every damaged file at its first chunk.
void mend_checksums(std::vector<std::uint8_t>& file) {
  for (std::size_t at = kSignature; at + kAroundData <= file.size();) {
    const std::size_t length = big_endian(file, at);
    if (length > file.size() - at - kAroundData) return;
    const auto sum = static_cast<std::uint32_t>(crc32(0, &file[at + 4], static_cast<uInt>(length + 4)));
    for (int i = 0; i < 4; ++i)
      file[at + 8 + length + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    at += length + kAroundData;
  }
}

template <class T>
std::string png(const Image<T>& image) {
  const TempFolder folder;
  write_png(folder.path("a.png"), image.view());
  return read_text(folder.path("a.png"), 1U << 20);
}

}  // namespace

void read(Bytes bytes) {
  if (!is_png(bytes)) return;
  std::vector<std::uint8_t> file(bytes.begin(), bytes.end());
  mend_checksums(file);
  try {
    decode_png_gray("fuzz", file);
  } catch (const InputError&) {  // the other reader takes other kinds
    decode_png_gray16("fuzz", file);
  }
}

std::vector<std::string> seeds() {
  Image<std::uint8_t> grey(5, 3, 40);
  Image<std::uint16_t> deep(4, 2, 4000);
  Image<Rgb8> color(3, 3, Rgb8{1, 2, 3});
  return {png(grey), png(deep), png(color)};
}

}  // namespace lakshya::fuzz

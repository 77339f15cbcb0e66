#include <turbojpeg.h>

#include <array>

#include "app/core/image_codecs.h"
#include "tests/fuzz/fuzz.h"

namespace lakshya::fuzz {
namespace {

// 24 x 16 pixels with some structure; grey or colour, baseline or progressive.
std::string jpeg(int subsampling, int flags) {
  constexpr int kWidth = 24;
  constexpr int kHeight = 16;
  std::array<std::uint8_t, std::size_t{3} * kWidth * kHeight> rgb{};
  for (std::size_t i = 0; i < rgb.size(); ++i)
    rgb[i] = static_cast<std::uint8_t>(i * i / 7);
  tjhandle handle = tjInitCompress();
  unsigned char* data = nullptr;
  unsigned long size = 0;
  tjCompress2(handle, rgb.data(), kWidth, 0, kHeight, TJPF_RGB, &data, &size, subsampling, 80, flags);
  std::string bytes(reinterpret_cast<const char*>(data), size);
  tjFree(data);
  tjDestroy(handle);
  return bytes;
}

}  // namespace

void read(Bytes bytes) {
  if (is_jpeg(bytes)) decode_jpeg_gray("fuzz", bytes);
}

std::vector<std::string> seeds() {
  return {jpeg(TJSAMP_GRAY, 0), jpeg(TJSAMP_420, 0), jpeg(TJSAMP_444, TJFLAG_PROGRESSIVE)};
}

}  // namespace lakshya::fuzz

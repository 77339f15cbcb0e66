#include "hal/camera/jpeg_grey.h"

#include <turbojpeg.h>

#include <memory>

namespace lakshya {
namespace {

struct DestroyHandle {
  void operator()(void* handle) const { tjDestroy(handle); }
};
using Handle = std::unique_ptr<void, DestroyHandle>;

// Walks the segments (ITU-T T.81, B.1.1) to the frame header: false unless that is SOF0 or SOF1 (sequential, Huffman).
bool is_sequential(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 4 || bytes[0] != 0xFF || bytes[1] != 0xD8) return false;
  for (std::size_t at = 2; at + 4 <= bytes.size();) {
    if (bytes[at] != 0xFF) return false;
    const std::uint8_t marker = bytes[at + 1];
    if (marker == 0xC0 || marker == 0xC1) return true;
    if (marker == 0xFF) {  // fill byte
      ++at;
      continue;
    }
    const bool other_frame = marker >= 0xC2 && marker <= 0xCF && marker != 0xC4 && marker != 0xCC;
    if (other_frame || marker <= 0x01 || (marker >= 0xD0 && marker <= 0xDA)) return false;
    const std::size_t length = std::size_t{bytes[at + 2]} << 8 | bytes[at + 3];
    if (length < 2) return false;
    at += 2 + length;
  }
  return false;
}

}  // namespace

Status decode_jpeg_grey(std::span<const std::uint8_t> bytes, ImageView<std::uint8_t> grey) {
  if (!is_sequential(bytes)) return Status::bad_data;
  const Handle handle(tjInitDecompress());
  if (!handle) return Status::unsupported;
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int color_space = 0;
  if (tjDecompressHeader3(handle.get(), bytes.data(), bytes.size(), &width, &height, &subsampling, &color_space) !=
          0 ||
      width != grey.width || height != grey.height || color_space == TJCS_CMYK || color_space == TJCS_YCCK) {
    return Status::bad_data;
  }
  // To the library a premature end is only a warning, and the missing part would be grey.
  const int flags = TJFLAG_ACCURATEDCT | TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;
  return tjDecompress2(handle.get(), bytes.data(), bytes.size(), grey.data, grey.width,
                       static_cast<int>(grey.stride), grey.height, TJPF_GRAY, flags) == 0
             ? Status::ok
             : Status::bad_data;
}

}  // namespace lakshya

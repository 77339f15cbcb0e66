#include <turbojpeg.h>

#include <memory>

#include "app/core/image_codecs.h"
#include "app/core/input_error.h"

namespace lakshya {
namespace {

struct CloseHandle {
  void operator()(void* handle) const { tjDestroy(handle); }
};
using Handle = std::unique_ptr<void, CloseHandle>;

// Huffman coding (ITU-T T.81) spends at least one bit on each 8x8 block: 8 bits, 64 pixels each.
constexpr std::uint64_t kMaxPixelsPerByte = 512;

[[noreturn]] void refuse(const std::string& path, tjhandle handle) {
  throw InputError(path,
                   std::string("jpeg: ") + tjGetErrorStr2(handle) + " (the file is cut off, damaged or unusual)");
}

}  // namespace

bool is_jpeg(Bytes bytes) {
  return bytes.size() >= 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF;
}

Image<std::uint8_t> decode_jpeg_gray(const std::string& path, Bytes bytes) {
  const Handle handle(tjInitDecompress());
  if (!handle) refuse(path, nullptr);
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int color_space = 0;
  if (tjDecompressHeader3(handle.get(), bytes.data(), bytes.size(), &width, &height, &subsampling, &color_space) !=
      0) {
    refuse(path, handle.get());
  }
  if (color_space == TJCS_CMYK || color_space == TJCS_YCCK) {
    throw InputError(path, "jpeg: has CMYK colours (convert it to RGB or grey)");
  }
  check_image_size(path, width, height);
  if (static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) > bytes.size() * kMaxPixelsPerByte) {
    throw InputError(path, "jpeg: is too short for its " + std::to_string(width) + " x " + std::to_string(height) +
                               " pixels (the file is cut off)");
  }
  Image<std::uint8_t> image(width, height);
  // A premature end is only a warning to the library, and the missing part would be grey.
  const int flags = TJFLAG_ACCURATEDCT | TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;
  if (tjDecompress2(handle.get(), bytes.data(), bytes.size(), image.view().data, width, width, height, TJPF_GRAY,
                    flags) != 0) {
    refuse(path, handle.get());
  }
  return image;
}

}  // namespace lakshya

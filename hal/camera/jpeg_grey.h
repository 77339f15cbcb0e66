// The luma of JPEG pictures as cameras send them (Motion-JPEG), by libjpeg-turbo.
#pragma once

#include <cstdint>
#include <span>

#include "kernels/base/image_view.h"
#include "kernels/base/status.h"

namespace lakshya {

// Decoding is the one thing in a camera driver that may allocate after open(): libjpeg-turbo takes its tables and rows of each
// picture from malloc and gives them back. Progressive pictures, which would want memory for the whole picture, are refused.
class JpegGrey {
 public:
  JpegGrey() = default;
  ~JpegGrey();
  JpegGrey(const JpegGrey&) = delete;
  JpegGrey& operator=(const JpegGrey&) = delete;

  // Takes the library's handle; doing it again does nothing. unsupported: it could not be had.
  Status open();

  // The Y plane (accurate integer DCT) of a picture of exactly `grey`'s size. Bytes after the end of the picture are ignored;
  // the Huffman tables may be absent, as Motion-JPEG has it (then those of ITU-T T.81, annex K). bad_data: no baseline or
  // extended JPEG, of another size, CMYK, cut off or damaged, also where the library would only warn; what `grey` then holds is
  // not specified.
  Status decode(std::span<const std::uint8_t> bytes, ImageView<std::uint8_t> grey);

 private:
  void* handle_ = nullptr;
};

}  // namespace lakshya

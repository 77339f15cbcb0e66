// JPEG pictures as a camera makes them, for tests. Needs libturbojpeg.
#pragma once

#include <turbojpeg.h>

#include <cstdint>
#include <string>
#include <vector>

#include "kernels/base/image_view.h"

namespace lakshya::test {

using JpegBytes = std::vector<std::uint8_t>;

// Grey, or colour without chroma (as 4:2:2, what webcams send); a TJFLAG_... in `flags`.
inline JpegBytes jpeg_of(ImageView<const std::uint8_t> grey, int subsampling = TJSAMP_422, int quality = 95,
                         int flags = 0) {
  std::vector<std::uint8_t> rgb;
  for (int v = 0; v < grey.height; ++v) {
    for (int u = 0; u < grey.width; ++u)
      rgb.insert(rgb.end(), 3, grey.at(u, v));
  }
  tjhandle handle = tjInitCompress();
  unsigned char* data = nullptr;
  unsigned long size = 0;
  (void)tjCompress2(handle, rgb.data(), grey.width, 0, grey.height, TJPF_RGB, &data, &size, subsampling, quality,
                    flags);
  JpegBytes bytes(data, data + size);
  tjFree(data);
  tjDestroy(handle);
  return bytes;
}

// Without its Huffman tables (segments DHT, ITU-T T.81 B.2.4.2): Motion-JPEG.
inline JpegBytes without_tables(const JpegBytes& jpeg) {
  JpegBytes out(jpeg.begin(), jpeg.begin() + 2);
  for (std::size_t at = 2; at + 4 <= jpeg.size();) {
    const std::size_t length = 2 + (std::size_t{jpeg[at + 2]} << 8 | jpeg[at + 3]);
    const bool scan = jpeg[at + 1] == 0xDA;
    const std::size_t end = scan ? jpeg.size() : at + length;
    if (jpeg[at + 1] != 0xC4) {
      out.insert(out.end(), jpeg.begin() + static_cast<std::ptrdiff_t>(at),
                 jpeg.begin() + static_cast<std::ptrdiff_t>(end));
    }
    at = end;
  }
  return out;
}

}  // namespace lakshya::test

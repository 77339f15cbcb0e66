// The luma of JPEG pictures as cameras send them (Motion-JPEG), by libjpeg-turbo.
#pragma once

#include <cstdint>
#include <span>

#include "kernels/base/image_view.h"
#include "kernels/base/status.h"

namespace lakshya {

// The Y plane (accurate integer DCT) of a sequential picture of exactly `grey`'s size. Bytes after the end of the picture are
// ignored; the Huffman tables may be absent, as Motion-JPEG has it (then those of ITU-T T.81, annex K). bad_data: no such
// JPEG, of another size, CMYK, cut off or damaged, also where the library would only warn; what `grey` then holds is not
// specified. unsupported: the library cannot be had.
//
// This is the one thing in a camera driver that allocates after open(): libjpeg-turbo takes its state, tables and rows from
// malloc and gives them back. Its state is made anew for each picture, because it would keep the tables of the last one: a
// damaged picture's would decode all that come after it without tables of their own. Progressive pictures, which want memory
// for the whole picture, are refused.
Status decode_jpeg_grey(std::span<const std::uint8_t> bytes, ImageView<std::uint8_t> grey);

}  // namespace lakshya

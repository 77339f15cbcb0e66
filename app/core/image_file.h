// Image files in and out: PNG, PGM, PPM and JPEG, recognised by content, never by name. Start-up, recordings and
// host tools only: everything here allocates and throws InputError.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "app/core/image.h"

namespace lakshya {

// A file that claims more is refused before its pixels are allocated, and so is one that has too few bytes to hold
// what it claims (PNG: deflate's limit of 1032:1; JPEG: Huffman coding's one bit for each 8x8 block; PGM, PPM: the
// samples).
inline constexpr int kMaxImageSide = 16384;  // px
inline constexpr std::int64_t kMaxImagePixels = 128'000'000;

// 8-bit grey, one byte per pixel, 0 black.
//  PNG: any type of at most 8 bits per sample; 1, 2 and 4-bit grey spread over 0..255, palettes expanded, alpha
//    dropped, gamma and colour profiles ignored (the raw samples).
//  PGM, PPM (P2, P3, P5, P6): maxval M 1..255, sample s becomes round(255 s / M); what follows the last sample is
//    ignored (Netpbm: another image may follow).
//  JPEG: the Y plane as libjpeg-turbo decodes it (accurate integer DCT); orientation tags are ignored.
// Colour of PNG and PPM becomes the luma of ITU-R BT.601 in 1/256: (77 R + 150 G + 29 B + 128) >> 8.
// Throws InputError for anything else, for 16-bit samples, CMYK, and for a file that is truncated or damaged; a
// JPEG that libjpeg-turbo would only warn about counts as damaged.
Image<std::uint8_t> read_gray(const std::string& path);

// The same for a file's content; `path` serves the messages.
Image<std::uint8_t> decode_gray(const std::string& path, std::span<const std::uint8_t> bytes);

// A grey PNG of 16 bits (KITTI disparity) or 8 bits (the values as they are; also as a palette or three channels that
// are equal everywhere). Throws InputError as
// read_gray does, and for every other kind of image.
Image<std::uint16_t> read_gray16(const std::string& path);

// A PFM file of one channel (Pf), top row first as everywhere here (the file has it last). The sign of the header's
// scale is the byte order; its size is ignored, since files disagree about it. Any float may be in it, infinities and
// NaN too. Throws InputError as read_gray does.
Image<float> read_pfm(const std::string& path);

// PNG files: 8-bit grey, 16-bit grey, 8-bit RGB; lossless. Written through write_file_atomically (path + ".part",
// then renamed). Throws InputError for a size outside the limits above and when the file cannot be written.
void write_png(const std::string& path, ImageView<const std::uint8_t> image);
void write_png(const std::string& path, ImageView<const std::uint16_t> image);
void write_png(const std::string& path, ImageView<const Rgb8> image);

}  // namespace lakshya

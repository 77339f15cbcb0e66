// Private to image_*.cc: one decoder per file format, from bytes in memory. `path` serves the messages only.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "app/core/image.h"

namespace lakshya {

using Bytes = std::span<const std::uint8_t>;

bool is_png(Bytes bytes);
bool is_pnm(Bytes bytes);  // P2, P3, P5 or P6
bool is_jpeg(Bytes bytes);
bool is_pfm(Bytes bytes);

Image<std::uint8_t> decode_png_gray(const std::string& path, Bytes bytes);
Image<std::uint16_t> decode_png_gray16(const std::string& path, Bytes bytes);
Image<std::uint8_t> decode_pnm_gray(const std::string& path, Bytes bytes);
Image<std::uint8_t> decode_jpeg_gray(const std::string& path, Bytes bytes);
Image<float> decode_pfm(const std::string& path, Bytes bytes);

// Throws InputError unless both sides are 1..kMaxImageSide and the area is at most kMaxImagePixels.
void check_image_size(const std::string& path, std::int64_t width, std::int64_t height);

// ITU-R BT.601 luma in 1/256: 0.299, 0.587 and 0.114 rounded so that the sum is 256, hence grey stays grey.
constexpr std::uint8_t luma(int r, int g, int b) {
  return static_cast<std::uint8_t>((77 * r + 150 * g + 29 * b + 128) >> 8);
}

}  // namespace lakshya

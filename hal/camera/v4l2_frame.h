// From the bytes of a Video4Linux2 capture buffer to a grey picture, and from that to two eyes. Functions of the bytes.
// Formats: Linux kernel, "Video for Linux API", Image Formats: GREY, YUYV, MJPEG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/base/image_view.h"
#include "kernels/base/status.h"

namespace lakshya {

enum class V4l2Format : std::uint8_t {
  grey,  // GREY: one byte per pixel
  yuyv,  // YUYV: Y0 U Y1 V for two pixels
  mjpg,  // MJPG: one JPEG picture
};

inline constexpr int kV4l2LeastSide = 16;    // px, of a picture
inline constexpr int kV4l2MostSide = 16384;  // px

// One picture as the device gives it: both eyes where they come side by side.
struct V4l2Picture {
  V4l2Format format = V4l2Format::grey;
  int width = 0;                   // px, even for yuyv
  int height = 0;                  // px
  std::size_t bytes_per_line = 0;  // grey: at least width; yuyv: at least 2 width; mjpg: ignored
};

bool is_possible(const V4l2Picture& picture);

// What a buffer needs at least to hold the picture; 0 for MJPG.
std::size_t picture_bytes(const V4l2Picture& picture);

// `used`: the bytes that the driver filled. `memory`: of the picture's size, or empty for GREY, whose answer lies in `used`;
// that of the others lies in `memory`. bad_argument: is_possible() says no, or no such memory; bad_data: too few bytes, or no
// JPEG of that size.
Status grey_picture(const V4l2Picture& picture, std::span<const std::uint8_t> used, ImageView<std::uint8_t> memory,
                    ImageView<const std::uint8_t>& grey);

// The left half (index 0) or the right half (index 1) of a picture of even width.
ImageView<const std::uint8_t> half(ImageView<const std::uint8_t> picture, int index);

}  // namespace lakshya

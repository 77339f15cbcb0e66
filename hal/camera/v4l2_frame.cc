#include "hal/camera/v4l2_frame.h"

#include "hal/camera/jpeg_grey.h"

namespace lakshya {
namespace {

std::size_t bytes_of_line(const V4l2Picture& picture) {
  if (picture.format == V4l2Format::mjpg) return 0;
  return static_cast<std::size_t>(picture.width) * (picture.format == V4l2Format::yuyv ? 2 : 1);
}

void copy_luma(const V4l2Picture& picture, const std::uint8_t* from, ImageView<std::uint8_t> to) {
  const std::ptrdiff_t width = picture.width;  // a byte stored might change a member
  for (int v = 0; v < picture.height; ++v, from += picture.bytes_per_line) {
    const std::uint8_t* __restrict line = from;
    std::uint8_t* __restrict row = to.row(v);
    for (std::ptrdiff_t u = 0; u < width; ++u)
      row[u] = line[2 * u];
  }
}

}  // namespace

bool is_possible(const V4l2Picture& picture) {
  const auto in_range = [](int side) { return side >= kV4l2LeastSide && side <= kV4l2MostSide; };
  if (!in_range(picture.width) || !in_range(picture.height)) return false;
  if (picture.format == V4l2Format::mjpg) return true;
  if (picture.format == V4l2Format::yuyv && picture.width % 2 != 0) return false;
  return picture.bytes_per_line >= bytes_of_line(picture) &&
         picture.bytes_per_line <= std::size_t{8} * kV4l2MostSide;
}

// The last line ends where its pixels do: a driver need not give its padding.
std::size_t picture_bytes(const V4l2Picture& picture) {
  if (picture.format == V4l2Format::mjpg) return 0;
  return picture.bytes_per_line * static_cast<std::size_t>(picture.height - 1) + bytes_of_line(picture);
}

Status grey_picture(const V4l2Picture& picture, std::span<const std::uint8_t> used, ImageView<std::uint8_t> memory,
                    ImageView<const std::uint8_t>& grey) {
  if (!is_possible(picture)) return Status::bad_argument;
  const bool in_place = picture.format == V4l2Format::grey;
  if (!in_place && (memory.width != picture.width || memory.height != picture.height)) return Status::bad_argument;
  if (used.empty() || used.size() < picture_bytes(picture)) return Status::bad_data;

  if (in_place) {
    grey = {used.data(), picture.width, picture.height, static_cast<std::ptrdiff_t>(picture.bytes_per_line)};
    return Status::ok;
  }
  if (picture.format == V4l2Format::mjpg) {
    const Status decoded = decode_jpeg_grey(used, memory);
    if (decoded != Status::ok) return decoded;
  } else {
    copy_luma(picture, used.data(), memory);
  }
  grey = memory;
  return Status::ok;
}

ImageView<const std::uint8_t> half(ImageView<const std::uint8_t> picture, int index) {
  const int width = picture.width / 2;
  return {picture.data + static_cast<std::ptrdiff_t>(index) * width, width, picture.height, picture.stride};
}

}  // namespace lakshya

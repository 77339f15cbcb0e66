#include "kernels/rectify/rectify.h"

namespace lakshya {
namespace {

constexpr std::int32_t kOne = 1 << kRectifyFractionBits;

std::int32_t pixel_or_zero(const ImageView<const std::uint8_t>& raw, std::int32_t x, std::int32_t y) {
  const bool inside = x >= 0 && y >= 0 && x < raw.width && y < raw.height;
  return inside ? raw.at(x, y) : 0;
}

std::uint8_t bilinear(const ImageView<const std::uint8_t>& raw, std::int32_t map_x, std::int32_t map_y) {
  const std::int32_t x = map_x >> kRectifyFractionBits;
  const std::int32_t y = map_y >> kRectifyFractionBits;
  const std::int32_t a = map_x & (kOne - 1);
  const std::int32_t b = map_y & (kOne - 1);
  const std::int32_t top = (kOne - a) * pixel_or_zero(raw, x, y) + a * pixel_or_zero(raw, x + 1, y);
  const std::int32_t bottom = (kOne - a) * pixel_or_zero(raw, x, y + 1) + a * pixel_or_zero(raw, x + 1, y + 1);
  const std::int32_t sum = (kOne - b) * top + b * bottom;
  return static_cast<std::uint8_t>((sum + (1 << 13)) >> 14);
}

}  // namespace

Status rectify_ref(ImageView<const std::uint8_t> raw, ImageView<const std::int32_t> map_x,
                   ImageView<const std::int32_t> map_y, Rows rows, ImageView<std::uint8_t> out) {
  if (!same_size(map_x, map_y) || !same_size(map_x, out)) return Status::size_mismatch;
  if (!rows_inside(rows, out)) return Status::bad_argument;
  for (int v = rows.begin; v < rows.end; ++v) {
    for (int u = 0; u < out.width; ++u)
      out.at(u, v) = bilinear(raw, map_x.at(u, v), map_y.at(u, v));
  }
  return Status::ok;
}

}  // namespace lakshya

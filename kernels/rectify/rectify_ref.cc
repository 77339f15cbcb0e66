#include "kernels/rectify/rectify.h"

namespace lakshya {
namespace {

constexpr int kOne = 1 << kRectifyFractionBits;

int pixel_or_zero(const ImageView<const std::uint8_t>& raw, int x, int y) {
  const bool inside = x >= 0 && y >= 0 && x < raw.width && y < raw.height;
  return inside ? raw.at(x, y) : 0;
}

std::uint8_t bilinear(const ImageView<const std::uint8_t>& raw, int x, int y, std::uint16_t fraction) {
  const int a = rectify_fraction_x(fraction);
  const int b = rectify_fraction_y(fraction);
  const int top = (kOne - a) * pixel_or_zero(raw, x, y) + a * pixel_or_zero(raw, x + 1, y);
  const int bottom = (kOne - a) * pixel_or_zero(raw, x, y + 1) + a * pixel_or_zero(raw, x + 1, y + 1);
  const int sum = (kOne - b) * top + b * bottom;
  return static_cast<std::uint8_t>((sum + (1 << 13)) >> 14);
}

}  // namespace

void rectify_columns_ref(const ImageView<const std::uint8_t>& raw, const RectifyMap& map, int v, int begin, int end,
                         const ImageView<std::uint8_t>& out) {
  for (int u = begin; u < end; ++u)
    out.at(u, v) = bilinear(raw, map.x.at(u, v), map.y.at(u, v), map.fraction.at(u, v));
}

Status rectify_ref(ImageView<const std::uint8_t> raw, const RectifyMap& map, Rows rows,
                   ImageView<std::uint8_t> out) {
  if (!same_size(map.x, out) || !same_size(map.y, out) || !same_size(map.fraction, out)) {
    return Status::size_mismatch;
  }
  if (!rows_inside(rows, out)) return Status::bad_argument;
  for (int v = rows.begin; v < rows.end; ++v)
    rectify_columns_ref(raw, map, v, 0, out.width, out);
  return Status::ok;
}

}  // namespace lakshya

#include "kernels/census/census.h"

namespace lakshya {
namespace {

// Pixel: how a pixel of the window is read.
template <class Pixel>
CensusCode census_code(int u, int v, const Pixel& pixel) {
  unsigned code = 0;
  for (unsigned k = 0; k < kCensusBits; ++k) {
    const auto [x, y] = kCensusOffsets[k];
    if (pixel(u + x, v + y) >= pixel(u - x, v - y)) code |= 1U << k;
  }
  return static_cast<CensusCode>(code);
}

}  // namespace

Status census_ref(ImageView<const std::uint8_t> image, Rows rows, ImageView<CensusCode> codes) {
  if (!same_size(image, codes)) return Status::size_mismatch;
  if (!rows_inside(rows, image)) return Status::bad_argument;
  const auto inside_pixel = [&](int u, int v) { return image.at(u, v); };
  const auto repeated_pixel = [&](int u, int v) { return at_repeated(image, u, v); };
  for (int v = rows.begin; v < rows.end; ++v) {
    const bool row_inside = v >= kCensusRadiusV && v < image.height - kCensusRadiusV;
    for (int u = 0; u < image.width; ++u) {
      const bool inside = row_inside && u >= kCensusRadiusU && u < image.width - kCensusRadiusU;
      codes.at(u, v) = inside ? census_code(u, v, inside_pixel) : census_code(u, v, repeated_pixel);
    }
  }
  return Status::ok;
}

}  // namespace lakshya

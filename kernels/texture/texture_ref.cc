#include <cstdlib>

#include "kernels/texture/texture.h"

namespace lakshya {
namespace {

// Pixel: how a pixel of the window is read.
template <class Pixel>
int gradient_sum(int u, int v, const Pixel& pixel) {
  int sum = 0;
  for (int y = v - kTextureRadiusV; y <= v + kTextureRadiusV; ++y) {
    for (int x = u - kTextureRadiusU; x <= u + kTextureRadiusU; ++x) {
      sum += std::abs(int{pixel(x + 1, y)} - int{pixel(x - 1, y)});
    }
  }
  return sum;
}

}  // namespace

Status texture_ref(ImageView<const std::uint8_t> image, int threshold, Rows rows,
                   ImageView<std::uint8_t> textured) {
  if (!same_size(image, textured)) return Status::size_mismatch;
  if (threshold < 0 || !rows_inside(rows, image)) return Status::bad_argument;
  const auto inside_pixel = [&](int u, int v) { return image.at(u, v); };
  const auto repeated_pixel = [&](int u, int v) { return at_repeated(image, u, v); };
  for (int v = rows.begin; v < rows.end; ++v) {
    const bool row_inside = v >= kTextureRadiusV && v < image.height - kTextureRadiusV;
    for (int u = 0; u < image.width; ++u) {
      const bool inside = row_inside && u > kTextureRadiusU && u < image.width - kTextureRadiusU - 1;
      const int sum = inside ? gradient_sum(u, v, inside_pixel) : gradient_sum(u, v, repeated_pixel);
      textured.at(u, v) = sum >= threshold ? 1 : 0;
    }
  }
  return Status::ok;
}

}  // namespace lakshya

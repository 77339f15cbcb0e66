#include <cstdlib>

#include "kernels/texture/texture.h"

namespace lakshya {
namespace {

int gradient_sum(const ImageView<const std::uint8_t>& image, int u, int v) {
  int sum = 0;
  for (int y = v - kTextureRadiusV; y <= v + kTextureRadiusV; ++y) {
    for (int x = u - kTextureRadiusU; x <= u + kTextureRadiusU; ++x) {
      sum += std::abs(int{image.at(x + 1, y)} - int{image.at(x - 1, y)});
    }
  }
  return sum;
}

}  // namespace

Status texture_ref(ImageView<const std::uint8_t> image, int threshold, Rows rows,
                   ImageView<std::uint8_t> textured) {
  if (!same_size(image, textured)) return Status::size_mismatch;
  if (threshold < 0 || !rows_inside(rows, image)) return Status::bad_argument;
  for (int v = rows.begin; v < rows.end; ++v) {
    const bool row_inside = v >= kTextureRadiusV && v < image.height - kTextureRadiusV;
    for (int u = 0; u < image.width; ++u) {
      const bool inside = row_inside && u > kTextureRadiusU && u < image.width - kTextureRadiusU - 1;
      textured.at(u, v) = inside && gradient_sum(image, u, v) >= threshold ? 1 : 0;
    }
  }
  return Status::ok;
}

}  // namespace lakshya

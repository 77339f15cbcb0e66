// A made-up raw pair for the cameras' tests: a textured surface that comes nearer from the top of the image to its bottom.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "kernels/base/image_view.h"
#include "tests/support/surface_texture.h"

namespace lakshya::test {

struct EyePairShape {
  int width = 320;
  int height = 240;
  double top_px = 3;  // u_left - u_right in the first row and in the last
  double bottom_px = 24;
  int rows_apart = 0;  // v_right - v_left
  double right_gain = 1;
  double right_offset = 0;  // grey levels
  std::uint32_t seed = 1;
};

// Both images in one buffer, the left one in its left half.
class EyePair {
 public:
  explicit EyePair(const EyePairShape& shape)
      : shape_(shape), pixels_(static_cast<std::size_t>(2 * shape.width) * static_cast<std::size_t>(shape.height)) {
    for (int v = 0; v < shape.height; ++v) {
      for (int u = 0; u < shape.width; ++u) {
        at(u, v) = grey(u, v);
        const int row = v - shape.rows_apart;
        const double shift = shape.top_px + (shape.bottom_px - shape.top_px) * row / shape.height;
        at(shape.width + u, v) = clamped(shape.right_gain * grey(u + shift, row) + shape.right_offset);
      }
    }
  }

  ImageView<const std::uint8_t> left() const {
    return {pixels_.data(), shape_.width, shape_.height, std::ptrdiff_t{2} * shape_.width};
  }
  ImageView<const std::uint8_t> right() const {
    return {pixels_.data() + shape_.width, shape_.width, shape_.height, std::ptrdiff_t{2} * shape_.width};
  }
  const std::vector<std::uint8_t>& side_by_side() const { return pixels_; }

 private:
  static std::uint8_t clamped(double grey) {
    return static_cast<std::uint8_t>(std::lround(std::fmin(std::fmax(grey, 0), 255)));
  }
  std::uint8_t grey(double u, int v) const {
    const SurfaceTexture texture{.gray = 128, .contrast = 60, .finest_m = 4, .seed = shape_.seed};
    return clamped(gray_at(texture, u, v, 1));
  }
  std::uint8_t& at(int u, int v) {
    return pixels_[static_cast<std::size_t>(v) * static_cast<std::size_t>(2 * shape_.width) +
                   static_cast<std::size_t>(u)];
  }

  EyePairShape shape_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace lakshya::test

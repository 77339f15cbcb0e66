// Pictures that keep the camera's pixels: disparity in colour, classes as tints.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "app/tools/picture_colors.h"
#include "app/tools/picture_panels.h"
#include "app/tools/pictures.h"

namespace lakshya {

DisparityScale disparity_scale(ImageView<const std::int16_t> disparity) {
  std::vector<std::int16_t> present;
  for (int v = 0; v < disparity.height; ++v) {
    std::copy_if(disparity.row(v), disparity.row(v) + disparity.width, std::back_inserter(present),
                 [](std::int16_t d) { return d >= 0; });
  }
  if (present.empty()) return {0, 1};
  const auto per_mille = [&present](std::size_t share) {
    const auto rank = static_cast<std::ptrdiff_t>((present.size() - 1) * share / 1000);
    std::nth_element(present.begin(), present.begin() + rank, present.end());
    return static_cast<double>(present[static_cast<std::size_t>(rank)]) / kDisparityScale;
  };
  const double last = std::max(1.0, per_mille(995));
  const double first = per_mille(5);
  return {first > last / 2 ? std::min(first, last - 1) : 0, last};
}

Image<Rgb8> disparity_picture(const PictureInput& input) {
  const ImageView<const std::int16_t>& disparity = input.frame.disparity;
  const DisparityScale scale = disparity_scale(disparity);
  Image<Rgb8> picture(disparity.width, disparity.height, kNoDisparityColor);
  const auto out = picture.view();
  for (int v = 0; v < disparity.height; ++v) {
    for (int u = 0; u < disparity.width; ++u) {
      const double d = static_cast<double>(disparity.at(u, v)) / kDisparityScale;
      if (d >= 0) out.at(u, v) = disparity_color(d - scale.first, scale.last - scale.first);
    }
  }
  return picture;
}

Image<Rgb8> classes_picture(const PictureInput& input) {
  const FrameResult& frame = input.frame;
  Image<Rgb8> picture(frame.left.width, frame.left.height);
  const auto out = picture.view();
  for (int v = 0; v < out.height; ++v) {
    for (int u = 0; u < out.width; ++u) {
      out.at(u, v) = class_color(frame.classes.at(u, v), frame.disparity.at(u, v), frame.left.at(u, v));
    }
  }
  return picture;
}

Image<Rgb8> gray_picture(ImageView<const std::uint8_t> gray) {
  Image<Rgb8> picture(gray.width, gray.height);
  const auto out = picture.view();
  for (int v = 0; v < out.height; ++v) {
    for (int u = 0; u < out.width; ++u)
      out.at(u, v) = {gray.at(u, v), gray.at(u, v), gray.at(u, v)};
  }
  return picture;
}

}  // namespace lakshya

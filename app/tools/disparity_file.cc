#include "app/tools/disparity_file.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lakshya {
namespace {

constexpr int kKittiPerStep = 256 / kDisparityScale;

void append_float(std::string& out, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8)
    out.push_back(static_cast<char>((bits >> shift) & 0xFF));
}

Rgb8 class_colour(PixelClass c) {
  switch (c) {
    case PixelClass::obstacle:
      return {213, 94, 0};
    case PixelClass::floor:
      return {0, 158, 115};
    case PixelClass::ceiling:
      return {86, 180, 233};
    case PixelClass::drop_off:
      return {204, 121, 167};
    case PixelClass::no_disparity:
    case PixelClass::too_far:
      break;
  }
  return {128, 128, 128};
}

void append_vertex(std::string& out, const ObstaclePoint& p, const Rgb8& colour) {
  append_float(out, static_cast<float>(p.forward_mm) / 1000);
  append_float(out, static_cast<float>(p.left_mm) / 1000);
  append_float(out, static_cast<float>(p.height_mm) / 1000);
  for (const std::uint8_t channel : {colour.r, colour.g, colour.b})
    out.push_back(static_cast<char>(channel));
}

}  // namespace

KittiDisparity kitti_disparity(ImageView<const std::int16_t> stored, double doffs) {
  const int doffs16 = static_cast<int>(std::lround(doffs * kDisparityScale));
  KittiDisparity out{Image<std::uint16_t>(stored.width, stored.height), 0};
  for (int v = 0; v < stored.height; ++v) {
    for (int u = 0; u < stored.width; ++u) {
      if (stored.at(u, v) < 0) continue;
      const int value = (stored.at(u, v) - doffs16) * kKittiPerStep;
      if (value < 0 || value > 65535) ++out.clipped;
      out.image.view().at(u, v) = static_cast<std::uint16_t>(std::clamp(value, 1, 65535));
    }
  }
  return out;
}

std::string ply_points(const FrameResult& frame, const PruneModel& model) {
  std::string vertices;
  std::size_t count = 0;
  for (int v = 0; v < frame.classes.height; ++v) {
    for (int u = 0; u < frame.classes.width; ++u) {
      const PixelClass c = frame.classes.at(u, v);
      if (c == PixelClass::no_disparity || c == PixelClass::too_far) continue;
      append_vertex(vertices, reproject_pixel(model, u, v, frame.disparity.at(u, v)), class_colour(c));
      ++count;
    }
  }
  return "ply\nformat binary_little_endian 1.0\ncomment body frame: x forward, y left, z up, metres\nelement "
         "vertex " +
         std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n" +
         vertices;
}

}  // namespace lakshya

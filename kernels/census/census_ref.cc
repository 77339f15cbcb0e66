#include "kernels/census/census.h"

namespace lakshya {
namespace {

std::uint32_t census_code(const ImageView<const std::uint8_t>& image, int u, int v) {
  std::uint32_t code = 0;
  int bit = 0;
  for (int y = -kCensusRadiusV; y <= 0; ++y) {
    const int last_x = y < 0 ? kCensusRadiusU : -1;
    for (int x = -kCensusRadiusU; x <= last_x; ++x, ++bit) {
      if (image.at(u + x, v + y) >= image.at(u - x, v - y)) code |= 1U << bit;
    }
  }
  return code;
}

}  // namespace

Status census_ref(ImageView<const std::uint8_t> image, Rows rows, ImageView<std::uint32_t> codes) {
  if (!same_size(image, codes)) return Status::size_mismatch;
  if (!rows_inside(rows, image)) return Status::bad_argument;
  for (int v = rows.begin; v < rows.end; ++v) {
    const bool row_inside = v >= kCensusRadiusV && v < image.height - kCensusRadiusV;
    for (int u = 0; u < image.width; ++u) {
      const bool inside = row_inside && u >= kCensusRadiusU && u < image.width - kCensusRadiusU;
      codes.at(u, v) = inside ? census_code(image, u, v) : 0;
    }
  }
  return Status::ok;
}

}  // namespace lakshya

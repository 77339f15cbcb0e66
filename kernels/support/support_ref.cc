#include <algorithm>
#include <cstdlib>

#include "kernels/base/units.h"
#include "kernels/support/support.h"

namespace lakshya {
namespace {

int supporters(const ImageView<const std::int16_t>& disparity, int u, int v, const SupportParams& p) {
  const int d = disparity.at(u, v);
  int count = 0;
  for (int y = std::max(v - p.radius, 0); y <= std::min(v + p.radius, disparity.height - 1); ++y) {
    for (int x = std::max(u - p.radius, 0); x <= std::min(u + p.radius, disparity.width - 1); ++x) {
      const int other = disparity.at(x, y);
      if (other >= 0 && std::abs(other - d) <= p.max_difference) ++count;
    }
  }
  return count;
}

}  // namespace

Status support_ref(ImageView<const std::int16_t> disparity, const SupportParams& params, Rows rows,
                   ImageView<std::int16_t> out) {
  if (!same_size(disparity, out)) return Status::size_mismatch;
  const int window = (2 * params.radius + 1) * (2 * params.radius + 1);
  if (params.radius < 0 || params.radius > 15 || params.min_count < 1 || params.min_count > window ||
      params.max_difference < 0 || !rows_inside(rows, disparity)) {
    return Status::bad_argument;
  }
  for (int v = rows.begin; v < rows.end; ++v) {
    for (int u = 0; u < disparity.width; ++u) {
      const std::int16_t d = disparity.at(u, v);
      const bool keep = d < 0 || supporters(disparity, u, v, params) >= params.min_count;
      out.at(u, v) = keep ? d : std::int16_t{kNoSupport};
    }
  }
  return Status::ok;
}

}  // namespace lakshya

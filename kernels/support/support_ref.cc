#include <algorithm>
#include <cstdlib>

#include "kernels/base/units.h"
#include "kernels/support/support.h"

namespace lakshya {
namespace {

bool supported(const ImageView<const std::int16_t>& disparity, int u, int v, const SupportParams& p) {
  const int d = disparity.at(u, v);
  const Rows rows{std::max(v - p.radius, 0), std::min(v + p.radius + 1, disparity.height)};
  const int begin = std::max(u - p.radius, 0);
  const int end = std::min(u + p.radius + 1, disparity.width);
  int count = 0;
  for (int y = rows.begin; y < rows.end; ++y) {
    for (int x = begin; x < end; ++x) {
      const int other = disparity.at(x, y);
      if (other >= 0 && std::abs(other - d) <= p.max_difference) ++count;
    }
  }
  return 100 * count >= p.min_percent * (rows.end - rows.begin) * (end - begin);
}

}  // namespace

Status support_ref(ImageView<const std::int16_t> disparity, const SupportParams& params, Rows rows,
                   ImageView<std::int16_t> out) {
  if (!same_size(disparity, out)) return Status::size_mismatch;
  if (params.radius < 0 || params.radius > 15 || params.min_percent < 0 || params.min_percent > 100 ||
      params.max_difference < 0 || !rows_inside(rows, disparity)) {
    return Status::bad_argument;
  }
  for (int v = rows.begin; v < rows.end; ++v) {
    for (int u = 0; u < disparity.width; ++u) {
      const std::int16_t d = disparity.at(u, v);
      const bool keep = d < 0 || supported(disparity, u, v, params);
      out.at(u, v) = keep ? d : std::int16_t{kNoSupport};
    }
  }
  return Status::ok;
}

}  // namespace lakshya

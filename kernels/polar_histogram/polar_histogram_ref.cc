#include <algorithm>

#include "kernels/base/units.h"
#include "kernels/polar_histogram/polar_histogram.h"

namespace lakshya {

Status polar_histogram_ref(ImageView<const std::uint8_t> type, std::span<const PolarEntry> table,
                           std::span<std::uint32_t, kPolarSectors> histogram, const PolarWindow& window) {
  if (type.width < 0 || type.height < 0 || type.width > kPolarMaxSide || type.height > kPolarMaxSide)
    return Status::bad_argument;
  const auto cols = static_cast<std::size_t>(type.width);
  if (table.size() != cols * static_cast<std::size_t>(type.height)) return Status::size_mismatch;

  std::ranges::fill(histogram, 0U);
  const int row_end = std::min(window.row_end, type.height);
  const int col_end = std::min(window.col_end, type.width);
  for (int r = std::max(window.row_begin, 0); r < row_end; ++r) {
    const std::uint8_t* cells = type.row(r);
    const PolarEntry* entries = table.data() + static_cast<std::size_t>(r) * cols;
    for (int c = std::max(window.col_begin, 0); c < col_end; ++c) {
      if (cells[c] != kCellObstacle) continue;
      for (int i = 0; i < entries[c].count; ++i)
        histogram[static_cast<std::size_t>((entries[c].first + i) % kPolarSectors)] += entries[c].weight;
    }
  }
  return Status::ok;
}

}  // namespace lakshya

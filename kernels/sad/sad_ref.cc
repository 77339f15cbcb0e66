#include <cstdlib>

#include "kernels/sad/sad.h"

namespace lakshya {

Status sad_row_ref(std::span<const std::uint8_t> left, std::span<const std::uint8_t> right,
                   const SearchRange& range, std::uint8_t outside_cost, std::span<std::uint8_t> cost) {
  const int width = static_cast<int>(left.size());
  if (!search_range_ok(range, width)) return Status::bad_argument;
  const auto disparities = static_cast<std::size_t>(range.disparities);
  if (right.size() != left.size() || cost.size() != left.size() * disparities) return Status::size_mismatch;
  for (int u = range.valid_begin; u < range.valid_end; ++u) {
    const auto column = static_cast<std::size_t>(u);
    for (int i = 0; i < range.disparities; ++i) {
      const int u_right = u - (range.first + i);
      const bool inside = u_right >= range.valid_begin && u_right < range.valid_end;
      const int difference = inside ? std::abs(left[column] - right[static_cast<std::size_t>(u_right)]) : 0;
      cost[column * disparities + static_cast<std::size_t>(i)] =
          inside ? static_cast<std::uint8_t>(difference) : outside_cost;
    }
  }
  return Status::ok;
}

}  // namespace lakshya

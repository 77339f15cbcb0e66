#include <algorithm>
#include <bit>

#include "kernels/hamming/hamming.h"

namespace lakshya {

Status hamming_row_ref(std::span<const CensusCode> left, std::span<const CensusCode> right,
                       const SearchRange& range, std::span<std::uint8_t> cost) {
  const int width = static_cast<int>(left.size());
  if (!search_range_ok(range, width)) return Status::bad_argument;
  const auto disparities = static_cast<std::size_t>(range.disparities);
  if (right.size() != left.size() || cost.size() != left.size() * disparities) return Status::size_mismatch;
  for (int u = range.valid_begin; u < range.valid_end; ++u) {
    const auto column = static_cast<std::size_t>(u);
    for (int i = 0; i < range.disparities; ++i) {
      const int u_right = u - (range.first + i);
      const bool inside = u_right >= range.valid_begin && u_right < range.valid_end;
      const int distance =
          inside ? std::popcount(static_cast<CensusCode>(left[column] ^ right[static_cast<std::size_t>(u_right)]))
                 : 0;
      cost[column * disparities + static_cast<std::size_t>(i)] =
          inside ? static_cast<std::uint8_t>(distance) : kOutsideCost;
    }
  }
  return Status::ok;
}

Status smooth_cost_row_ref(std::span<const std::uint8_t> above, std::span<const std::uint8_t> here,
                           std::span<const std::uint8_t> below, const SearchRange& range,
                           std::span<std::uint8_t> out) {
  const auto disparities = static_cast<std::size_t>(range.disparities);
  if (range.disparities <= 0 || !search_range_ok(range, static_cast<int>(here.size() / disparities))) {
    return Status::bad_argument;
  }
  if (above.size() != here.size() || below.size() != here.size() || out.size() != here.size()) {
    return Status::size_mismatch;
  }
  for (int u = range.valid_begin; u < range.valid_end; ++u) {
    const std::size_t columns[3] = {static_cast<std::size_t>(std::max(u - 1, range.valid_begin)) * disparities,
                                    static_cast<std::size_t>(u) * disparities,
                                    static_cast<std::size_t>(std::min(u + 1, range.valid_end - 1)) * disparities};
    for (std::size_t i = 0; i < disparities; ++i) {
      int sum = 0;
      for (const std::size_t column : columns)
        sum += above[column + i] + here[column + i] + below[column + i];
      out[columns[1] + i] = static_cast<std::uint8_t>((sum + 1) >> 1);
    }
  }
  return Status::ok;
}

}  // namespace lakshya

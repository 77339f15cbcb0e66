// What the window matchers' implementations have in common besides the contract.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels/base/units.h"
#include "kernels/block/block.h"
#include "kernels/census/census.h"
#include "kernels/edge/edge.h"
#include "kernels/hamming/hamming.h"
#include "kernels/sad/sad.h"

namespace lakshya {

constexpr int window_rows(int radius_v) {
  return 2 * radius_v + 1;
}

struct CensusTraits {
  using Descriptor = CensusCode;
  static bool params_ok(const BlockParams& /*p*/) { return true; }
  static int largest(const BlockParams& /*p*/) { return kCensusBits; }
  static std::uint8_t outside(const BlockParams& /*p*/) { return kOutsideCost; }
};

struct SadTraits {
  using Descriptor = std::uint8_t;
  static bool params_ok(const BlockParams& p) { return 1 <= p.edge_cap && p.edge_cap <= kMaxEdgeCap; }
  static int largest(const BlockParams& p) { return 2 * p.edge_cap; }
  static std::uint8_t outside(const BlockParams& p) { return sad_outside_cost(p.edge_cap); }
};

// What a window matcher is called with.
template <class Traits>
struct BlockCall {
  ImageView<const typename Traits::Descriptor> left;
  ImageView<const typename Traits::Descriptor> right;
  ImageView<const std::uint8_t> textured;
  Rows descriptor_rows;
  const BlockParams& params;
  Rows rows;
  std::span<std::byte> scratch;
  ImageView<std::int16_t> disparity;
};

template <class Traits>
Status check(const BlockCall<Traits>& c) {
  constexpr int kLargestSum = 65535;
  const BlockParams& p = c.params;
  const auto radius_ok = [](int radius) { return 0 <= radius && radius <= kMaxBlockRadius; };
  if (!same_size(c.left, c.right) || !same_size(c.left, c.textured) || !same_size(c.left, c.disparity)) {
    return Status::size_mismatch;
  }
  if (!search_range_ok(p.range, c.left.width) || !radius_ok(p.radius_u) || !radius_ok(p.radius_v) ||
      !Traits::params_ok(p) || (2 * p.radius_u + 1) * window_rows(p.radius_v) * Traits::largest(p) > kLargestSum ||
      !rows_inside(c.rows, c.left) || !rows_inside(c.descriptor_rows, c.left)) {
    return Status::bad_argument;
  }
  if (c.scratch.size() < block_scratch_bytes(c.left.width, p.range.disparities, p.radius_v)) {
    return Status::scratch_too_small;
  }
  return Status::ok;
}

// The rows to match; the others of c.rows become kNotSearched.
template <class Traits>
Rows blank_rows_without_descriptors(const BlockCall<Traits>& c) {
  const Rows matched{std::max(c.descriptor_rows.begin, c.rows.begin), std::min(c.descriptor_rows.end, c.rows.end)};
  for (int v = c.rows.begin; v < c.rows.end; ++v) {
    if (v < matched.begin || v >= matched.end)
      std::fill_n(c.disparity.row(v), c.disparity.width, std::int16_t{kNotSearched});
  }
  return matched;
}

}  // namespace lakshya

#include <cstdlib>

#include "kernels/base/integer.h"
#include "kernels/base/units.h"
#include "kernels/select/select.h"

namespace lakshya {
namespace {

// One row's costs with the shape that goes with them.
template <class Sum>
struct CostRow {
  std::span<const Sum> sums;
  const SearchRange& range;

  std::int32_t at(int u, int i) const {
    return sums[static_cast<std::size_t>(u) * static_cast<std::size_t>(range.disparities) +
                static_cast<std::size_t>(i)];
  }
  bool valid(int u) const { return u >= range.valid_begin && u < range.valid_end; }
  int right_column(int u, int i) const { return u - (range.first + i); }
};

template <class Sum>
int winner(const CostRow<Sum>& row, int u) {
  int best = 0;
  for (int i = 1; i < row.range.disparities; ++i) {
    if (row.at(u, i) < row.at(u, best)) best = i;
  }
  return best;
}

template <class Sum>
bool unique(const CostRow<Sum>& row, int u, int best, int uniqueness_percent) {
  const std::int32_t limit = 100 * row.at(u, best);
  for (int i = 0; i < row.range.disparities; ++i) {
    if (std::abs(i - best) > 1 && row.at(u, i) * (100 - uniqueness_percent) < limit) return false;
  }
  return true;
}

// Winner of a right-image pixel along the diagonal of the same costs; -1 when no left pixel can match it.
template <class Sum>
std::int16_t right_winner(const CostRow<Sum>& row, int u_right) {
  int best = -1;
  for (int i = 0; i < row.range.disparities; ++i) {
    const int u = u_right + row.range.first + i;
    if (!row.valid(u)) continue;
    if (best < 0 || row.at(u, i) < row.at(u_right + row.range.first + best, best)) best = i;
  }
  return static_cast<std::int16_t>(best);
}

// In 1/16 px relative to candidate `best`.
template <class Sum>
std::int32_t sub_pixel(const CostRow<Sum>& row, int u, int best) {
  if (best == 0 || best == row.range.disparities - 1) return 0;
  const std::int32_t before = row.at(u, best - 1);
  const std::int32_t after = row.at(u, best + 1);
  const std::int32_t numerator = before - after;
  const std::int32_t curvature = before + after - 2 * row.at(u, best);
  const std::int32_t denominator = curvature > 1 ? curvature : 1;
  return floor_divide(kDisparityScale * numerator + denominator, 2 * denominator);
}

template <class Sum>
bool left_right_agree(const CostRow<Sum>& row, int u, int best, int fraction16, std::span<const std::int16_t> right,
                      int left_right_max) {
  const int down = best + (fraction16 < 0 ? -1 : 0);
  const int up = best + (fraction16 > 0 ? 1 : 0);
  for (int i = down; i <= up; ++i) {
    const int u_right = row.right_column(u, i);
    if (row.valid(u_right) && std::abs(best - right[static_cast<std::size_t>(u_right)]) <= left_right_max)
      return true;
  }
  return false;
}

template <class Sum>
std::int16_t select_pixel(const CostRow<Sum>& row, int u, std::span<const std::int16_t> right,
                          const SelectParams& p) {
  const int best = winner(row, u);
  if (!row.valid(row.right_column(u, best))) return kNotSearched;
  if (!unique(row, u, best, p.uniqueness_percent)) return kNotUnique;
  const std::int32_t fraction16 = sub_pixel(row, u, best);
  if (p.left_right_max >= 0 && !left_right_agree(row, u, best, fraction16, right, p.left_right_max)) {
    return kLeftRightFailed;
  }
  return static_cast<std::int16_t>(kDisparityScale * (row.range.first + best) + fraction16 + p.offset16);
}

template <class Sum>
Status select_row(std::span<const Sum> sums, std::span<const std::uint8_t> textured, const SearchRange& range,
                  const SelectParams& params, std::span<std::int16_t> scratch, std::span<std::int16_t> disparity) {
  const int width = static_cast<int>(disparity.size());
  if (!search_range_ok(range, width)) return Status::bad_argument;
  if (params.uniqueness_percent < 0 || params.uniqueness_percent > 99) return Status::bad_argument;
  if (kDisparityScale * range.first + params.offset16 < 0) return Status::bad_argument;
  if (textured.size() != disparity.size()) return Status::size_mismatch;
  if (sums.size() != disparity.size() * static_cast<std::size_t>(range.disparities)) return Status::size_mismatch;
  if (scratch.size() < select_scratch_elements(width)) return Status::scratch_too_small;

  const CostRow<Sum> row{sums, range};
  for (int u = range.valid_begin; u < range.valid_end; ++u) {
    scratch[static_cast<std::size_t>(u)] = right_winner(row, u);
  }
  for (int u = 0; u < width; ++u) {
    std::int16_t& d = disparity[static_cast<std::size_t>(u)];
    if (!row.valid(u)) {
      d = kNotSearched;
    } else if (textured[static_cast<std::size_t>(u)] == 0) {
      d = kLowTexture;
    } else {
      d = select_pixel(row, u, scratch, params);
    }
  }
  return Status::ok;
}

}  // namespace

Status select_row_ref(std::span<const std::uint16_t> sums, std::span<const std::uint8_t> textured,
                      const SearchRange& range, const SelectParams& params, std::span<std::int16_t> scratch,
                      std::span<std::int16_t> disparity) {
  return select_row(sums, textured, range, params, scratch, disparity);
}

Status select_row_ref(std::span<const std::uint8_t> sums, std::span<const std::uint8_t> textured,
                      const SearchRange& range, const SelectParams& params, std::span<std::int16_t> scratch,
                      std::span<std::int16_t> disparity) {
  return select_row(sums, textured, range, params, scratch, disparity);
}

}  // namespace lakshya

// Finds the obstacle cells a vector of bytes at a time. Each adds its weight where its sectors begin and takes it away
// where they end, and one sum over the circle at the end makes the histogram of it: two additions for a cell instead of
// up to 37, modulo 2^32 like the reference's.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/polar_histogram/polar_histogram_simd.cc"
#include "hwy/foreach_target.h"
// foreach_target.h comes first, whatever the alphabet says.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "hwy/highway.h"
#include "kernels/base/units.h"
#include "kernels/polar_histogram/polar_histogram.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// What sector k has more than sector k - 1; an entry's sectors may run over the end of the circle.
struct Steps {
  std::uint32_t step[512] = {};
  void add(const PolarEntry& e) {
    step[e.first] += e.weight;
    step[e.first + e.count] -= e.weight;
  }
};

void add_row(const std::uint8_t* cells, const PolarEntry* entries, int count, Steps& steps) {
  const hn::ScalableTag<std::uint8_t> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  int c = 0;
  for (; c + lanes <= count; c += lanes) {
    const auto obstacle = hn::Eq(hn::LoadU(d, cells + c), hn::Set(d, std::uint8_t{kCellObstacle}));
    if (hn::AllFalse(d, obstacle)) continue;
    std::uint8_t bits[HWY_MAX_BYTES / 8 + 8] = {};
    hn::StoreMaskBits(d, obstacle, bits);
    for (int at = 0; at < lanes; at += 64) {
      std::uint64_t some;
      std::memcpy(&some, bits + at / 8, sizeof some);
      for (; some != 0; some &= some - 1)
        steps.add(entries[c + at + std::countr_zero(some)]);
    }
  }
  for (; c < count; ++c) {
    if (cells[c] == kCellObstacle) steps.add(entries[c]);
  }
}

void sum_window(ImageView<const std::uint8_t> type, std::span<const PolarEntry> table, const PolarWindow& window,
                std::span<std::uint32_t, kPolarSectors> histogram) {
  const int row_end = std::min(window.row_end, type.height);
  const int col_begin = std::max(window.col_begin, 0);
  const int count = std::min(window.col_end, type.width) - col_begin;
  Steps steps;
  for (int r = std::max(window.row_begin, 0); r < row_end && count > 0; ++r) {
    const std::size_t first =
        static_cast<std::size_t>(r) * static_cast<std::size_t>(type.width) + static_cast<std::size_t>(col_begin);
    add_row(type.row(r) + col_begin, table.data() + first, count, steps);
  }
  std::ranges::fill(histogram, 0U);
  std::uint32_t sum = 0;
  for (std::size_t k = 0; k < std::size(steps.step); ++k)
    histogram[k % kPolarSectors] += sum += steps.step[k];
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lakshya {

HWY_EXPORT(sum_window);

Status polar_histogram_simd(ImageView<const std::uint8_t> type, std::span<const PolarEntry> table,
                            std::span<std::uint32_t, kPolarSectors> histogram, const PolarWindow& window) {
  if (type.width < 0 || type.height < 0 || type.width > kPolarMaxSide || type.height > kPolarMaxSide)
    return Status::bad_argument;
  if (table.size() != static_cast<std::size_t>(type.width) * static_cast<std::size_t>(type.height))
    return Status::size_mismatch;
  HWY_DYNAMIC_DISPATCH(sum_window)(type, table, window, histogram);
  return Status::ok;
}

}  // namespace lakshya
#endif

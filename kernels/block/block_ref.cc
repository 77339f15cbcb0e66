#include <algorithm>

#include "kernels/base/scratch.h"
#include "kernels/block/block.h"
#include "kernels/block/block_checks.h"
#include "kernels/hamming/hamming.h"
#include "kernels/sad/sad.h"

namespace lakshya {
namespace {

// What one band keeps; the ring has window_rows(radius_v) rows of costs, image row v in slot v mod window_rows.
struct BlockRows {
  std::span<std::uint8_t> ring;
  std::span<std::uint16_t> columns;  // costs of the window's rows added up, per column
  std::span<std::uint16_t> window;   // S of one pixel
  std::span<std::uint16_t> sums;     // S of the current row
  std::span<std::int16_t> select;
};

BlockRows lay_out(int width, int disparities, int radius_v, ScratchLayout& scratch) {
  const auto candidates = static_cast<std::size_t>(disparities);
  const std::size_t row = static_cast<std::size_t>(width) * candidates;
  BlockRows r;
  r.ring = scratch.take<std::uint8_t>(row * static_cast<std::size_t>(window_rows(radius_v)));
  r.columns = scratch.take<std::uint16_t>(row);
  r.window = scratch.take<std::uint16_t>(candidates);
  r.sums = scratch.take<std::uint16_t>(row);
  r.select = scratch.take<std::int16_t>(select_scratch_elements(width));
  return r;
}

template <class T>
void add(std::span<const T> terms, std::span<std::uint16_t> sums) {
  for (std::size_t i = 0; i < sums.size(); ++i)
    sums[i] = static_cast<std::uint16_t>(sums[i] + terms[i]);
}

template <class T>
void subtract(std::span<const T> terms, std::span<std::uint16_t> sums) {
  for (std::size_t i = 0; i < sums.size(); ++i)
    sums[i] = static_cast<std::uint16_t>(sums[i] - terms[i]);
}

class Window {
 public:
  Window(const BlockParams& params, const BlockRows& rows) : p_(params), rows_(rows) {
    // The ring starts with rows of cost 0, so that the first rows that leave are none.
    std::fill(rows_.ring.begin(), rows_.ring.end(), std::uint8_t{0});
    std::fill(rows_.columns.begin(), rows_.columns.end(), std::uint16_t{0});
  }

  // The slot of image row v, all 0: the row that it held leaves the window.
  std::span<std::uint8_t> make_room(int v) {
    const std::size_t row = rows_.columns.size();
    const auto slot = static_cast<std::size_t>(v % window_rows(p_.radius_v));
    const std::span<std::uint8_t> cost = rows_.ring.subspan(slot * row, row);
    subtract<std::uint8_t>(cost, rows_.columns);
    std::fill(cost.begin(), cost.end(), std::uint8_t{0});
    return cost;
  }

  void enter(std::span<const std::uint8_t> cost) { add(cost, rows_.columns); }

  // S of the row in the middle of the window.
  std::span<const std::uint16_t> add_up_row() {
    std::fill(rows_.window.begin(), rows_.window.end(), std::uint16_t{0});
    const SearchRange& range = p_.range;
    for (int x = range.valid_begin; x < range.valid_end + p_.radius_u; ++x) {
      const int leaves = x - 2 * p_.radius_u - 1;
      if (leaves >= range.valid_begin) subtract<std::uint16_t>(pixel(rows_.columns, leaves), rows_.window);
      if (x < range.valid_end) add<std::uint16_t>(pixel(rows_.columns, x), rows_.window);
      const int u = x - p_.radius_u;
      if (u < range.valid_begin) continue;
      std::copy(rows_.window.begin(), rows_.window.end(), pixel(rows_.sums, u).begin());
    }
    return rows_.sums;
  }

  std::span<std::int16_t> select_scratch() const { return rows_.select; }

 private:
  std::span<std::uint16_t> pixel(std::span<std::uint16_t> row, int u) const {
    const auto n = static_cast<std::size_t>(p_.range.disparities);
    return row.subspan(static_cast<std::size_t>(u) * n, n);
  }

  const BlockParams& p_;
  BlockRows rows_;
};

struct CensusCost : CensusTraits {
  static Status row(std::span<const Descriptor> left, std::span<const Descriptor> right, const BlockParams& p,
                    std::span<std::uint8_t> cost) {
    return hamming_row_ref(left, right, p.range, cost);
  }
};

struct SadCost : SadTraits {
  static Status row(std::span<const Descriptor> left, std::span<const Descriptor> right, const BlockParams& p,
                    std::span<std::uint8_t> cost) {
    return sad_row_ref(left, right, p.range, outside(p), cost);
  }
};

template <class Cost>
Status block_match(const BlockCall<Cost>& c) {
  Status status = check(c);
  if (status != Status::ok) return status;
  const Rows matched = blank_rows_without_descriptors(c);
  if (matched.begin >= matched.end) return Status::ok;

  const BlockParams& params = c.params;
  ScratchLayout layout(c.scratch.data());
  Window window(params, lay_out(c.left.width, params.range.disparities, params.radius_v, layout));
  const int top = std::max(c.descriptor_rows.begin, matched.begin - params.radius_v);
  for (int below = top; below < matched.end + params.radius_v; ++below) {
    const std::span<std::uint8_t> cost = window.make_room(below);
    if (below < c.descriptor_rows.end)
      status = Cost::row(row_span(c.left, below), row_span(c.right, below), params, cost);
    if (status != Status::ok) return status;
    window.enter(cost);
    const int v = below - params.radius_v;
    if (v < matched.begin) continue;
    status = select_row_ref(window.add_up_row(), row_span(c.textured, v), params.range, params.select,
                            window.select_scratch(), row_span(c.disparity, v));
    if (status != Status::ok) return status;
  }
  return Status::ok;
}

}  // namespace

std::size_t block_scratch_bytes(int width, int disparities, int radius_v) {
  ScratchLayout layout;
  lay_out(width, disparities, radius_v, layout);
  return std::max(layout.used(), block_simd_scratch_bytes(width, disparities, radius_v));
}

Status census_block_ref(ImageView<const CensusCode> left, ImageView<const CensusCode> right,
                        ImageView<const std::uint8_t> textured, Rows descriptor_rows, const BlockParams& params,
                        Rows rows, std::span<std::byte> scratch, ImageView<std::int16_t> disparity) {
  return block_match<CensusCost>({left, right, textured, descriptor_rows, params, rows, scratch, disparity});
}

Status sad_block_ref(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                     ImageView<const std::uint8_t> textured, Rows descriptor_rows, const BlockParams& params,
                     Rows rows, std::span<std::byte> scratch, ImageView<std::int16_t> disparity) {
  return block_match<SadCost>({left, right, textured, descriptor_rows, params, rows, scratch, disparity});
}

}  // namespace lakshya

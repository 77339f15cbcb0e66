#include <algorithm>

#include "kernels/base/scratch.h"
#include "kernels/base/units.h"
#include "kernels/block/block.h"
#include "kernels/census/census.h"
#include "kernels/edge/edge.h"
#include "kernels/hamming/hamming.h"
#include "kernels/sad/sad.h"

namespace lakshya {
namespace {

constexpr int kLargestSum = 65535;

// What one band keeps; the ring has window_rows(radius_v) rows of costs, image row v in slot v mod window_rows.
struct BlockRows {
  std::span<std::uint8_t> ring;
  std::span<std::uint16_t> columns;  // costs of the window's rows added up, per column
  std::span<std::uint16_t> window;   // S of one pixel
  std::span<std::uint16_t> sums;     // S of the current row
  std::span<std::int16_t> select;
};

constexpr int window_rows(int radius_v) {
  return 2 * radius_v + 1;
}

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

struct CensusCost {
  using Descriptor = CensusCode;
  static bool params_ok(const BlockParams&) { return true; }
  static int largest(const BlockParams&) { return kCensusBits; }
  static Status row(std::span<const Descriptor> left, std::span<const Descriptor> right, const BlockParams& p,
                    std::span<std::uint8_t> cost) {
    return hamming_row_ref(left, right, p.range, cost);
  }
};

struct SadCost {
  using Descriptor = std::uint8_t;
  static bool params_ok(const BlockParams& p) { return 1 <= p.edge_cap && p.edge_cap <= kMaxEdgeCap; }
  static int largest(const BlockParams& p) { return 2 * p.edge_cap; }
  static Status row(std::span<const Descriptor> left, std::span<const Descriptor> right, const BlockParams& p,
                    std::span<std::uint8_t> cost) {
    return sad_row_ref(left, right, p.range, sad_outside_cost(p.edge_cap), cost);
  }
};

template <class Cost>
bool params_ok(const BlockParams& p, int width) {
  const auto radius_ok = [](int radius) { return 0 <= radius && radius <= kMaxBlockRadius; };
  return search_range_ok(p.range, width) && radius_ok(p.radius_u) && radius_ok(p.radius_v) && Cost::params_ok(p) &&
         (2 * p.radius_u + 1) * window_rows(p.radius_v) * Cost::largest(p) <= kLargestSum;
}

template <class Cost, class Image = ImageView<const typename Cost::Descriptor>>
Status block_match(const Image& left, const Image& right, const ImageView<const std::uint8_t>& textured,
                   Rows descriptor_rows, const BlockParams& params, Rows rows, std::span<std::byte> scratch,
                   const ImageView<std::int16_t>& disparity) {
  if (!same_size(left, right) || !same_size(left, textured) || !same_size(left, disparity)) {
    return Status::size_mismatch;
  }
  if (!params_ok<Cost>(params, left.width) || !rows_inside(rows, left) || !rows_inside(descriptor_rows, left)) {
    return Status::bad_argument;
  }
  if (scratch.size() < block_scratch_bytes(left.width, params.range.disparities, params.radius_v)) {
    return Status::scratch_too_small;
  }

  const int first = std::max(descriptor_rows.begin, rows.begin);
  const int last = std::min(descriptor_rows.end, rows.end);
  for (int v = rows.begin; v < rows.end; ++v) {
    if (v < first || v >= last) std::fill_n(disparity.row(v), disparity.width, std::int16_t{kNotSearched});
  }
  if (first >= last) return Status::ok;

  ScratchLayout layout(scratch.data());
  Window window(params, lay_out(left.width, params.range.disparities, params.radius_v, layout));
  const int top = std::max(descriptor_rows.begin, first - params.radius_v);
  for (int below = top; below < last + params.radius_v; ++below) {
    const std::span<std::uint8_t> cost = window.make_room(below);
    Status status = Status::ok;
    if (below < descriptor_rows.end)
      status = Cost::row(row_span(left, below), row_span(right, below), params, cost);
    if (status != Status::ok) return status;
    window.enter(cost);
    const int v = below - params.radius_v;
    if (v < first) continue;
    status = select_row_ref(window.add_up_row(), row_span(textured, v), params.range, params.select,
                            window.select_scratch(), row_span(disparity, v));
    if (status != Status::ok) return status;
  }
  return Status::ok;
}

}  // namespace

std::size_t block_scratch_bytes(int width, int disparities, int radius_v) {
  ScratchLayout layout;
  lay_out(width, disparities, radius_v, layout);
  return layout.used();
}

Status census_block_ref(ImageView<const CensusCode> left, ImageView<const CensusCode> right,
                        ImageView<const std::uint8_t> textured, Rows descriptor_rows, const BlockParams& params,
                        Rows rows, std::span<std::byte> scratch, ImageView<std::int16_t> disparity) {
  return block_match<CensusCost>(left, right, textured, descriptor_rows, params, rows, scratch, disparity);
}

Status sad_block_ref(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right,
                     ImageView<const std::uint8_t> textured, Rows descriptor_rows, const BlockParams& params,
                     Rows rows, std::span<std::byte> scratch, ImageView<std::int16_t> disparity) {
  return block_match<SadCost>(left, right, textured, descriptor_rows, params, rows, scratch, disparity);
}

}  // namespace lakshya

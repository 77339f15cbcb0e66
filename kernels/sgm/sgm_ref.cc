#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "kernels/base/scratch.h"
#include "kernels/base/units.h"
#include "kernels/hamming/hamming.h"
#include "kernels/sgm/sgm.h"
#include "kernels/sgm/sgm_input.h"

namespace lakshya {
namespace {

constexpr int kLargestSum = 255;
constexpr int kTopPaths = 3;  // top, top-left, top-right

// The rows that one band keeps.
struct BandRows {
  std::span<std::uint8_t> hamming[3];          // Hamming distances of the row above, this one and the one below
  std::span<std::uint8_t> cost;                // C of the current row
  std::span<std::uint8_t> sums;                // S of the current row
  std::span<std::uint8_t> above[kTopPaths];    // L_r of the row above, one buffer per path
  std::span<std::uint8_t> current[kTopPaths];  // L_r of this row
  std::span<std::uint8_t> sideways[2];         // L_r of the previous and the current pixel of a horizontal path
  std::span<std::int16_t> select;
};

BandRows lay_out(int width, int disparities, ScratchLayout& scratch) {
  const auto candidates = static_cast<std::size_t>(disparities);
  const std::size_t row = static_cast<std::size_t>(width) * candidates;
  BandRows r;
  for (std::span<std::uint8_t>& distances : r.hamming)
    distances = scratch.take<std::uint8_t>(row);
  r.cost = scratch.take<std::uint8_t>(row);
  r.sums = scratch.take<std::uint8_t>(row);
  for (int path = 0; path < kTopPaths; ++path) {
    r.above[path] = scratch.take<std::uint8_t>(row);
    r.current[path] = scratch.take<std::uint8_t>(row);
  }
  for (std::span<std::uint8_t>& pixel : r.sideways)
    pixel = scratch.take<std::uint8_t>(candidates);
  r.select = scratch.take<std::int16_t>(select_scratch_elements(width));
  return r;
}

// L_r of one pixel; `previous` empty where the path starts.
void path_cost(std::span<const std::uint8_t> cost, std::span<const std::uint8_t> previous, int p1, int p2,
               std::span<std::uint8_t> out) {
  if (previous.empty()) {
    std::copy(cost.begin(), cost.end(), out.begin());
    return;
  }
  const int least = *std::min_element(previous.begin(), previous.end());
  const std::size_t last = cost.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const int stay = previous[i];
    const int below = (i > 0 ? previous[i - 1] : 255) + p1;
    const int beyond = (i < last ? previous[i + 1] : 255) + p1;
    const int jump = least + p2;
    const int best = std::min({stay, below, beyond, jump});
    out[i] = static_cast<std::uint8_t>(std::min(cost[i] + best - least, 255));
  }
}

class Band {
 public:
  Band(const SgmParams& params, const BandRows& rows, const ImageView<const std::uint8_t>& image)
      : p_(params), rows_(rows), image_(image) {}

  void aggregate_row(int v, bool first_row) {
    v_ = v;
    std::fill(rows_.sums.begin(), rows_.sums.end(), std::uint8_t{0});
    horizontal_path(p_.range.valid_begin, p_.range.valid_end, 1);
    horizontal_path(p_.range.valid_end - 1, p_.range.valid_begin - 1, -1);
    top_path(0, 0, first_row);
    if (p_.paths == 5) {
      top_path(1, -1, first_row);
      top_path(2, 1, first_row);
    }
  }

  BandRows& rows() { return rows_; }

 private:
  template <class T>
  std::span<T> pixel(std::span<T> row, int u) const {
    const auto n = static_cast<std::size_t>(p_.range.disparities);
    return row.subspan(static_cast<std::size_t>(u) * n, n);
  }

  // P2 of the step to pixel (u, v_) from (from_u, from_v).
  int jump_penalty(int u, int from_u, int from_v) const {
    const int step = std::abs(int{image_.at(u, v_)} - int{image_.at(from_u, from_v)});
    return std::max(p_.p2 - p_.p2_slope * step, p_.p2_min);
  }

  void add_to_sums(int u, std::span<const std::uint8_t> path) {
    const std::span<std::uint8_t> sums = pixel(rows_.sums, u);
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] = static_cast<std::uint8_t>(std::min(sums[i] + path[i], kLargestSum));
  }

  void horizontal_path(int begin, int end, int step) {
    std::span<const std::uint8_t> previous;
    int side = 0;
    for (int u = begin; u != end; u += step, side = 1 - side) {
      const int p2 = u == begin ? 0 : jump_penalty(u, u - step, v_);
      path_cost(pixel(rows_.cost, u), previous, p_.p1, p2, rows_.sideways[side]);
      add_to_sums(u, rows_.sideways[side]);
      previous = rows_.sideways[side];
    }
  }

  // The path from the pixel above, shifted by `shift` columns.
  void top_path(int path, int shift, bool first_row) {
    for (int u = p_.range.valid_begin; u < p_.range.valid_end; ++u) {
      const int from = u + shift;
      const bool starts = first_row || from < p_.range.valid_begin || from >= p_.range.valid_end;
      const std::span<const std::uint8_t> previous =
          starts ? std::span<const std::uint8_t>{} : pixel(rows_.above[path], from);
      const int p2 = starts ? 0 : jump_penalty(u, from, v_ - 1);
      path_cost(pixel(rows_.cost, u), previous, p_.p1, p2, pixel(rows_.current[path], u));
      add_to_sums(u, pixel(rows_.current[path], u));
    }
    std::swap(rows_.above[path], rows_.current[path]);
  }

  const SgmParams& p_;
  BandRows rows_;
  ImageView<const std::uint8_t> image_;
  int v_ = 0;
};

// Keeps the Hamming distances of three rows and gives C of the middle one. Rows beyond the descriptors repeat the
// nearest one that has them.
class CostRows {
 public:
  CostRows(const ImageView<const CensusCode>& left, const ImageView<const CensusCode>& right,
           const SearchRange& range, Rows descriptor_rows)
      : left_(left), right_(right), range_(range), last_(descriptor_rows.end - 1), first_(descriptor_rows.begin) {}

  // For the first row of a band, then for each following one.
  Status start(int v, BandRows& rows) const {
    Status status = distances(std::max(v - 1, first_), rows.hamming[0]);
    if (status == Status::ok) status = distances(v, rows.hamming[1]);
    if (status == Status::ok) status = distances(std::min(v + 1, last_), rows.hamming[2]);
    return status == Status::ok ? smooth(rows) : status;
  }
  Status next(int v, BandRows& rows) const {
    std::rotate(std::begin(rows.hamming), std::begin(rows.hamming) + 1, std::end(rows.hamming));
    const Status status = distances(std::min(v + 1, last_), rows.hamming[2]);
    return status == Status::ok ? smooth(rows) : status;
  }

 private:
  Status distances(int v, std::span<std::uint8_t> out) const {
    return hamming_row_ref(row_span(left_, v), row_span(right_, v), range_, out);
  }
  Status smooth(BandRows& rows) const {
    return smooth_cost_row_ref(rows.hamming[0], rows.hamming[1], rows.hamming[2], range_, rows.cost);
  }

  ImageView<const CensusCode> left_;
  ImageView<const CensusCode> right_;
  SearchRange range_;
  int last_;
  int first_;
};

}  // namespace

std::size_t sgm_ref_scratch_bytes(int width, int disparities) {
  ScratchLayout layout;
  lay_out(width, disparities, layout);
  return layout.used();
}

Status sgm_ref(ImageView<const std::uint8_t> image, ImageView<const CensusCode> left,
               ImageView<const CensusCode> right, ImageView<const std::uint8_t> textured, Rows descriptor_rows,
               const SgmParams& params, Rows rows, std::span<std::byte> scratch,
               ImageView<std::int16_t> disparity) {
  const SgmInput input{image, left, right, textured, descriptor_rows, rows};
  Status status = check_sgm(input, params, scratch.size(), disparity);
  if (status != Status::ok) return status;
  const Rows aggregated = rows_to_aggregate(input, params);
  fill_not_searched(input, aggregated, disparity);

  ScratchLayout layout(scratch.data());
  Band band(params, lay_out(left.width, params.range.disparities, layout), image);
  const CostRows costs(left, right, params.range, descriptor_rows);
  for (int v = aggregated.begin; v < aggregated.end; ++v) {
    status = v == aggregated.begin ? costs.start(v, band.rows()) : costs.next(v, band.rows());
    if (status != Status::ok) return status;
    band.aggregate_row(v, v == aggregated.begin);
    if (v < rows.begin) continue;
    status = select_row_ref(band.rows().sums, row_span(textured, v), params.range, params.select,
                            band.rows().select, row_span(disparity, v));
    if (status != Status::ok) return status;
  }
  return Status::ok;
}

}  // namespace lakshya

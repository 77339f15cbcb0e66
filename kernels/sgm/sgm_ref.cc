#include <algorithm>

#include "kernels/base/units.h"
#include "kernels/hamming/hamming.h"
#include "kernels/sgm/sgm.h"

namespace lakshya {
namespace {

constexpr std::size_t kAlignment = 64;
constexpr int kTopPaths = 3;  // top, top-left, top-right

constexpr std::size_t align_up(std::size_t bytes) {
  return (bytes + kAlignment - 1) / kAlignment * kAlignment;
}

// The rows that one band keeps.
struct BandRows {
  std::span<std::uint8_t> cost;                // C of the current row
  std::span<std::uint16_t> sums;               // S of the current row
  std::span<std::uint8_t> above[kTopPaths];    // L_r of the row above, one buffer per path
  std::span<std::uint8_t> current[kTopPaths];  // L_r of this row
  std::span<std::uint8_t> sideways[2];         // L_r of the previous and the current pixel of a horizontal path
  std::span<std::int16_t> select;
};

std::size_t lay_out(int width, int disparities, std::byte* base, BandRows* rows) {
  std::size_t used = 0;
  const auto take = [&]<class T>(std::span<T>* out, std::size_t n) {
    if (rows != nullptr) *out = {reinterpret_cast<T*>(base + used), n};
    used += align_up(n * sizeof(T));
  };
  BandRows sizes_only;
  BandRows& r = rows != nullptr ? *rows : sizes_only;
  const auto pixels = static_cast<std::size_t>(width);
  const auto candidates = static_cast<std::size_t>(disparities);
  take(&r.cost, pixels * candidates);
  take(&r.sums, pixels * candidates);
  for (int path = 0; path < kTopPaths; ++path) {
    take(&r.above[path], pixels * candidates);
    take(&r.current[path], pixels * candidates);
  }
  take(&r.sideways[0], candidates);
  take(&r.sideways[1], candidates);
  take(&r.select, select_scratch_elements(width));
  return used;
}

// L_r of one pixel; `previous` empty where the path starts.
void path_cost(std::span<const std::uint8_t> cost, std::span<const std::uint8_t> previous, const SgmParams& p,
               std::span<std::uint8_t> out) {
  if (previous.empty()) {
    std::copy(cost.begin(), cost.end(), out.begin());
    return;
  }
  const int least = *std::min_element(previous.begin(), previous.end());
  const std::size_t last = cost.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const int stay = previous[i];
    const int below = (i > 0 ? previous[i - 1] : 255) + p.p1;
    const int beyond = (i < last ? previous[i + 1] : 255) + p.p1;
    const int jump = least + p.p2;
    const int best = std::min({stay, below, beyond, jump});
    out[i] = static_cast<std::uint8_t>(std::min(cost[i] + best - least, 255));
  }
}

class Band {
 public:
  Band(const SgmParams& params, const BandRows& rows) : p_(params), rows_(rows) {}

  void aggregate_row(bool first_row) {
    std::fill(rows_.sums.begin(), rows_.sums.end(), std::uint16_t{0});
    horizontal_path(p_.range.valid_begin, p_.range.valid_end, 1);
    horizontal_path(p_.range.valid_end - 1, p_.range.valid_begin - 1, -1);
    top_path(0, 0, first_row);
    if (p_.paths == 5) {
      top_path(1, -1, first_row);
      top_path(2, 1, first_row);
    }
  }

  const BandRows& rows() const { return rows_; }

 private:
  template <class T>
  std::span<T> pixel(std::span<T> row, int u) const {
    const auto n = static_cast<std::size_t>(p_.range.disparities);
    return row.subspan(static_cast<std::size_t>(u) * n, n);
  }

  void add_to_sums(int u, std::span<const std::uint8_t> path) {
    const std::span<std::uint16_t> sums = pixel(rows_.sums, u);
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] = static_cast<std::uint16_t>(sums[i] + path[i]);
  }

  void horizontal_path(int begin, int end, int step) {
    std::span<const std::uint8_t> previous;
    int side = 0;
    for (int u = begin; u != end; u += step, side = 1 - side) {
      path_cost(pixel(rows_.cost, u), previous, p_, rows_.sideways[side]);
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
      path_cost(pixel(rows_.cost, u), previous, p_, pixel(rows_.current[path], u));
      add_to_sums(u, pixel(rows_.current[path], u));
    }
    std::swap(rows_.above[path], rows_.current[path]);
  }

  const SgmParams& p_;
  BandRows rows_;
};

template <class T>
std::span<T> row_span(const ImageView<T>& image, int v) {
  return {image.row(v), static_cast<std::size_t>(image.width)};
}

bool params_ok(const SgmParams& p, int width) {
  return search_range_ok(p.range, width) && (p.paths == 3 || p.paths == 5) && 0 <= p.p1 && p.p1 <= p.p2 &&
         p.p2 <= 200 && p.warmup_rows >= 0;
}

}  // namespace

std::size_t sgm_scratch_bytes(int width, int disparities) {
  return lay_out(width, disparities, nullptr, nullptr);
}

Status sgm_ref(ImageView<const std::uint32_t> left, ImageView<const std::uint32_t> right,
               ImageView<const std::uint8_t> textured, Rows descriptor_rows, const SgmParams& params, Rows rows,
               std::span<std::byte> scratch, ImageView<std::int16_t> disparity) {
  if (!same_size(left, right) || !same_size(left, textured) || !same_size(left, disparity)) {
    return Status::size_mismatch;
  }
  if (!params_ok(params, left.width) || !rows_inside(rows, left) || !rows_inside(descriptor_rows, left)) {
    return Status::bad_argument;
  }
  if (scratch.size() < sgm_scratch_bytes(left.width, params.range.disparities)) return Status::scratch_too_small;

  BandRows band_rows;
  lay_out(left.width, params.range.disparities, scratch.data(), &band_rows);
  Band band(params, band_rows);
  const int first = std::max(descriptor_rows.begin, rows.begin - params.warmup_rows);
  const int last = std::min(descriptor_rows.end, rows.end);
  for (int v = rows.begin; v < rows.end; ++v) {
    if (v < first || v >= last) std::fill_n(disparity.row(v), disparity.width, std::int16_t{kNotSearched});
  }
  for (int v = first; v < last; ++v) {
    Status status = hamming_row_ref(row_span(left, v), row_span(right, v), params.range, band.rows().cost);
    if (status != Status::ok) return status;
    band.aggregate_row(v == first);
    if (v < rows.begin) continue;
    status = select_row_ref(band.rows().sums, row_span(textured, v), params.range, params.select,
                            band.rows().select, row_span(disparity, v));
    if (status != Status::ok) return status;
  }
  return Status::ok;
}

}  // namespace lakshya

#include <algorithm>

#include "kernels/edge/edge.h"

namespace lakshya {
namespace {

constexpr int kLogSide = 2 * kEdgeLogRadius + 1;
constexpr int kLogShift = 5;
constexpr int kLogKernel[kLogSide][kLogSide] = {
    {0, -1, -2, -3, -4, -3, -2, -1, 0},      //
    {-1, -3, -6, -9, -9, -9, -6, -3, -1},    //
    {-2, -6, -10, -6, -1, -6, -10, -6, -2},  //
    {-3, -9, -6, 21, 42, 21, -6, -9, -3},    //
    {-4, -9, -1, 42, 72, 42, -1, -9, -4},    //
    {-3, -9, -6, 21, 42, 21, -6, -9, -3},    //
    {-2, -6, -10, -6, -1, -6, -10, -6, -2},  //
    {-1, -3, -6, -9, -9, -9, -6, -3, -1},    //
    {0, -1, -2, -3, -4, -3, -2, -1, 0},
};

constexpr int kernel_sum() {
  int sum = 0;
  for (const auto& row : kLogKernel) {
    for (const int k : row)
      sum += k;
  }
  return sum;
}
static_assert(kernel_sum() == 0, "a flat image has no edges");

struct Sobel {
  static constexpr int kRadius = kEdgeSobelRadius;
  static int at(const ImageView<const std::uint8_t>& image, int u, int v) {
    const auto slope = [&](int y) { return int{image.at(u + 1, y)} - int{image.at(u - 1, y)}; };
    return slope(v - 1) + 2 * slope(v) + slope(v + 1);
  }
};

struct LaplacianOfGaussian {
  static constexpr int kRadius = kEdgeLogRadius;
  static int at(const ImageView<const std::uint8_t>& image, int u, int v) {
    int sum = 0;
    for (int y = 0; y < kLogSide; ++y) {
      const std::uint8_t* pixel = image.row(v + y - kRadius) + u - kRadius;
      for (int x = 0; x < kLogSide; ++x)
        sum += kLogKernel[y][x] * pixel[x];
    }
    return (sum + (1 << (kLogShift - 1))) >> kLogShift;
  }
};

template <class Filter>
Status filter_rows(const ImageView<const std::uint8_t>& image, int cap, Rows rows,
                   const ImageView<std::uint8_t>& out) {
  if (!same_size(image, out)) return Status::size_mismatch;
  if (cap < 1 || cap > kMaxEdgeCap || !rows_inside(rows, image)) return Status::bad_argument;
  constexpr int kRadius = Filter::kRadius;
  for (int v = rows.begin; v < rows.end; ++v) {
    const bool row_inside = v >= kRadius && v < image.height - kRadius;
    for (int u = 0; u < image.width; ++u) {
      const bool inside = row_inside && u >= kRadius && u < image.width - kRadius;
      const int g = inside ? Filter::at(image, u, v) : 0;
      out.at(u, v) = static_cast<std::uint8_t>(std::clamp(g, -cap, cap) + cap);
    }
  }
  return Status::ok;
}

}  // namespace

Status edge_sobel_ref(ImageView<const std::uint8_t> image, int cap, Rows rows, ImageView<std::uint8_t> out) {
  return filter_rows<Sobel>(image, cap, rows, out);
}

Status edge_log_ref(ImageView<const std::uint8_t> image, int cap, Rows rows, ImageView<std::uint8_t> out) {
  return filter_rows<LaplacianOfGaussian>(image, cap, rows, out);
}

}  // namespace lakshya

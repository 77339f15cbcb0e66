#include "hal/camera/bumblebee.h"

#include <algorithm>

namespace lakshya {
namespace {

// 77 R + 150 G + 29 B, whose sum is 256: grey stays grey.
constexpr int kRed = 77;
constexpr int kGreen = 150;
constexpr int kBlue = 29;

constexpr int kLeastSide = 4;

// What a pixel's own byte, the sum of its horizontal, vertical and diagonal neighbours count in the luma, in 1/1024.
struct Weights {
  int own;
  int across;
  int along;
  int corners;
};

constexpr Weights at_red_or_blue(int own, int other) {
  return {4 * own, kGreen, kGreen, other};
}
constexpr Weights at_green(int across, int along) {
  return {4 * kGreen, 2 * across, 2 * along, 0};
}

// Of the four places of a pattern, by [v % 2][u % 2].
struct Cell {
  Weights at[2][2];
};

constexpr Weights kAtRed = at_red_or_blue(kRed, kBlue);
constexpr Weights kAtBlue = at_red_or_blue(kBlue, kRed);
constexpr Weights kAtGreenBesideRed = at_green(kRed, kBlue);
constexpr Weights kAtGreenBesideBlue = at_green(kBlue, kRed);

Cell cell_of(BayerPattern pattern) {
  switch (pattern) {
    case BayerPattern::bggr:
      return {{{kAtBlue, kAtGreenBesideBlue}, {kAtGreenBesideRed, kAtRed}}};
    case BayerPattern::grbg:
      return {{{kAtGreenBesideRed, kAtRed}, {kAtBlue, kAtGreenBesideBlue}}};
    case BayerPattern::gbrg:
      return {{{kAtGreenBesideBlue, kAtBlue}, {kAtRed, kAtGreenBesideRed}}};
    case BayerPattern::rggb:
    case BayerPattern::none:
      break;
  }
  return {{{kAtRed, kAtGreenBesideRed}, {kAtGreenBesideBlue, kAtBlue}}};
}

// The pixel at `here`; above and below point to the same column.
std::uint8_t luma(const Weights& w, const std::uint8_t* above, const std::uint8_t* here,
                  const std::uint8_t* below) {
  const int sum = w.own * here[0] + w.across * (here[-1] + here[1]) + w.along * (above[0] + below[0]) +
                  w.corners * (above[-1] + above[1] + below[-1] + below[1]);
  return static_cast<std::uint8_t>((sum + 512) >> 10);
}

// Columns 1 .. width - 2, which are an odd one and an even one in turn.
void luma_row(const Weights (&weights)[2], const std::uint8_t* __restrict above,
              const std::uint8_t* __restrict here, const std::uint8_t* __restrict below, int width,
              std::uint8_t* __restrict out) {
  const Weights even = weights[0];
  const Weights odd = weights[1];
  for (int u = 1; u + 1 < width; u += 2) {
    out[u] = luma(odd, above + u, here + u, below + u);
    out[u + 1] = luma(even, above + u + 1, here + u + 1, below + u + 1);
  }
}

}  // namespace

Status split_bytes(std::span<const std::uint8_t> bytes, std::size_t bytes_per_line, ImageView<std::uint8_t> first,
                   ImageView<std::uint8_t> second) {
  if (!same_size(first, second)) return Status::size_mismatch;
  const std::size_t line = 2 * static_cast<std::size_t>(std::max(first.width, 0));
  if (first.width < 1 || first.height < 1 || bytes_per_line < line) return Status::bad_argument;
  const std::size_t rows = bytes.size() < line ? 0 : (bytes.size() - line) / bytes_per_line + 1;
  if (rows < static_cast<std::size_t>(first.height)) return Status::bad_data;
  for (int v = 0; v < first.height; ++v) {
    const std::uint8_t* __restrict from = bytes.data() + static_cast<std::size_t>(v) * bytes_per_line;
    std::uint8_t* __restrict a = first.row(v);
    std::uint8_t* __restrict b = second.row(v);
    for (std::ptrdiff_t u = 0; u < first.width; ++u) {
      a[u] = from[2 * u];
      b[u] = from[2 * u + 1];
    }
  }
  return Status::ok;
}

Status grey_of_bayer(ImageView<const std::uint8_t> mosaic, BayerPattern pattern, ImageView<std::uint8_t> grey) {
  if (!same_size(mosaic, grey)) return Status::size_mismatch;
  const int width = mosaic.width;
  const int height = mosaic.height;
  if (pattern == BayerPattern::none) {
    for (int v = 0; v < height; ++v)
      std::copy_n(mosaic.row(v), width, grey.row(v));
    return Status::ok;
  }
  if (width < kLeastSide || height < kLeastSide || width % 2 != 0 || height % 2 != 0) return Status::bad_argument;
  const Cell cell = cell_of(pattern);
  for (int v = 1; v + 1 < height; ++v) {
    std::uint8_t* const out = grey.row(v);
    luma_row(cell.at[v % 2], mosaic.row(v - 1), mosaic.row(v), mosaic.row(v + 1), width, out);
    out[0] = out[1];
    out[width - 1] = out[width - 2];
  }
  std::copy_n(grey.row(1), width, grey.row(0));
  std::copy_n(grey.row(height - 2), width, grey.row(height - 1));
  return Status::ok;
}

}  // namespace lakshya

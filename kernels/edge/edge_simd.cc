// Both filters in 16-bit numbers, on as many pixels as a vector holds.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/edge/edge_simd.cc"
#include "hwy/foreach_target.h"
// foreach_target.h comes first, whatever the alphabet says.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/edge/edge.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::ScalableTag<std::int16_t>;
using Bytes = hn::Rebind<std::uint8_t, Words>;
using WordVector = hn::Vec<Words>;

WordVector load(const std::uint8_t* pixel) {
  return hn::PromoteTo(Words(), hn::LoadU(Bytes(), pixel));
}

WordVector times(WordVector v, int factor) {
  return hn::Mul(v, hn::Set(Words(), static_cast<std::int16_t>(factor)));
}

WordVector sum(WordVector a, WordVector b) {
  return hn::Add(a, b);
}

template <class... More>
WordVector sum(WordVector a, WordVector b, More... more) {
  return sum(hn::Add(a, b), more...);
}

// clamp(g, -cap, cap) + cap; g + cap fits 16 bits.
void store_capped(WordVector g, int cap, std::uint8_t* out) {
  const auto raised = hn::DemoteTo(Bytes(), hn::Add(g, hn::Set(Words(), static_cast<std::int16_t>(cap))));
  hn::StoreU(hn::Min(raised, hn::Set(Bytes(), static_cast<std::uint8_t>(2 * cap))), Bytes(), out);
}

// Calls at(i) so that vectors from i on cover 0..count, at least one vector's lanes; the last overlaps the one before.
template <class At>
void for_each_vector(int count, const At& at) {
  const int lanes = static_cast<int>(hn::Lanes(Words()));
  for (int i = 0; i < count; i += lanes)
    at(std::min(i, count - lanes));
}

// `pixel`, `out`: the first of `count` pixels of a row that have all their neighbours.
struct Sobel {
  static constexpr int kRadius = kEdgeSobelRadius;
  static void row(const std::uint8_t* pixel, std::ptrdiff_t stride, int cap, int count, std::uint8_t* out) {
    const auto column = [&](const std::uint8_t* p) {
      return sum(load(p - stride), load(p + stride), times(load(p), 2));
    };
    for_each_vector(
        count, [&](int i) { store_capped(hn::Sub(column(pixel + i + 1), column(pixel + i - 1)), cap, out + i); });
  }
};

// The kernel is symmetric: the five kinds of its columns are sums over s0 = I(v), sj = I(v - j) + I(v + j), and each
// counts on both sides. 16 bits hold all of it, although the whole sum may reach 82620. With grey values less 128
// (which changes nothing, for the kernel adds up to 0; in wrapping arithmetic it is one constant) the sum falls into
// three parts, of columns 1, of columns 0 and 4, and of columns 2 and 3. The coefficients of each add up, without their
// signs, to 240, 216 and 192, so that no part exceeds 128 times this, 30720, 27648 and 24576: they are exact.
// Their sum saturates. Where that of the first two does, the third brings it back to 8191 at the nearest: still far more
// than the cap, as it should be.
struct LaplacianOfGaussian {
  static constexpr int kRadius = kEdgeLogRadius;
  static constexpr int kStrip = 1024;  // columns at a time, so that their sums need no memory of the caller's

  // Element i: column i - kRadius.
  using Columns = std::array<std::array<std::int16_t, kStrip + 2 * kRadius>, kRadius + 1>;

  static void sum_columns(const std::uint8_t* pixel, std::ptrdiff_t stride, int count, Columns& columns) {
    for_each_vector(count, [&](int i) {
      const std::uint8_t* p = pixel + i;
      const auto pair = [&](std::ptrdiff_t j) { return hn::Add(load(p - j * stride), load(p + j * stride)); };
      const auto store = [&](std::size_t x, WordVector v) {
        hn::StoreU(v, Words(), &columns[x][static_cast<std::size_t>(i)]);
      };
      const auto s0 = load(p);
      const auto s1 = pair(1);
      const auto s2 = pair(2);
      const auto s3 = pair(3);
      const auto s4 = pair(4);
      store(0, hn::Sub(sum(times(s0, 72), times(s1, 42)), sum(s2, times(s3, 9), times(s4, 4))));
      store(1, hn::Sub(sum(times(s0, 42), times(s1, 21)), sum(times(s2, 6), times(s3, 9), times(s4, 3))));
      // These have no positive coefficient; their signs come later.
      store(2, sum(s0, times(sum(s1, s3), 6), times(s2, 10), times(s4, 2)));
      store(3, sum(times(sum(s0, s1), 9), times(s2, 6), times(s3, 3), s4));
      store(4, sum(times(s0, 4), times(s1, 3), times(s2, 2), s3));
    });
  }

  static void combine_columns(const Columns& columns, int cap, int count, std::uint8_t* out) {
    const Words d;
    for_each_vector(count, [&](int i) {
      const auto at = [&](int x, int offset) {
        const int column = i + kRadius + offset;
        return hn::LoadU(d, &columns[static_cast<std::size_t>(x)][static_cast<std::size_t>(column)]);
      };
      const auto both = [&](int x) { return hn::Add(at(x, -x), at(x, x)); };
      const auto one = hn::Sub(both(1), hn::Set(d, 128 * 96));
      const auto zero_and_four = hn::Sub(hn::Sub(at(0, 0), both(4)), hn::Set(d, 128 * 96));
      const auto two_and_three = hn::Sub(sum(both(2), both(3)), hn::Set(d, 128 * 192));
      const auto g = hn::SaturatedSub(hn::SaturatedAdd(one, zero_and_four), two_and_three);
      store_capped(hn::ShiftRight<5>(hn::SaturatedAdd(g, hn::Set(d, 16))), cap, out + i);
    });
  }

  static void row(const std::uint8_t* pixel, std::ptrdiff_t stride, int cap, int count, std::uint8_t* out) {
    const int strips = (count + kStrip - 1) / kStrip;
    for (int i = 0; i < strips; ++i) {
      const Rows strip = rows_of_band(count, strips, i);
      const int width = strip.end - strip.begin;
      Columns columns;
      sum_columns(pixel + strip.begin - kRadius, stride, width + 2 * kRadius, columns);
      combine_columns(columns, cap, width, out + strip.begin);
    }
  }
};

// The arguments are right; false: too narrow for a vector, nothing was written.
template <class Filter>
bool filter_rows(const ImageView<const std::uint8_t>& image, int cap, Rows rows,
                 const ImageView<std::uint8_t>& out) {
  constexpr int kRadius = Filter::kRadius;
  const int count = image.width - 2 * kRadius;
  if (count < static_cast<int>(hn::Lanes(Words()))) return false;
  const auto no_edge = static_cast<std::uint8_t>(cap);
  for (int v = rows.begin; v < rows.end; ++v) {
    std::uint8_t* edges = out.row(v);
    if (v < kRadius || v >= image.height - kRadius) {
      std::fill(edges, edges + image.width, no_edge);
      continue;
    }
    std::fill(edges, edges + kRadius, no_edge);
    Filter::row(image.row(v) + kRadius, image.stride, cap, count, edges + kRadius);
    std::fill(edges + kRadius + count, edges + image.width, no_edge);
  }
  return true;
}

bool sobel_rows(const ImageView<const std::uint8_t>& image, int cap, Rows rows,
                const ImageView<std::uint8_t>& out) {
  return filter_rows<Sobel>(image, cap, rows, out);
}

bool log_rows(const ImageView<const std::uint8_t>& image, int cap, Rows rows, const ImageView<std::uint8_t>& out) {
  return filter_rows<LaplacianOfGaussian>(image, cap, rows, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lakshya {

HWY_EXPORT(sobel_rows);
HWY_EXPORT(log_rows);

Status edge_sobel_simd(ImageView<const std::uint8_t> image, int cap, Rows rows, ImageView<std::uint8_t> out) {
  if (!same_size(image, out)) return Status::size_mismatch;
  if (cap < 1 || cap > kMaxEdgeCap || !rows_inside(rows, image)) return Status::bad_argument;
  if (HWY_DYNAMIC_DISPATCH(sobel_rows)(image, cap, rows, out)) return Status::ok;
  return edge_sobel_ref(image, cap, rows, out);
}

Status edge_log_simd(ImageView<const std::uint8_t> image, int cap, Rows rows, ImageView<std::uint8_t> out) {
  if (!same_size(image, out)) return Status::size_mismatch;
  if (cap < 1 || cap > kMaxEdgeCap || !rows_inside(rows, image)) return Status::bad_argument;
  if (HWY_DYNAMIC_DISPATCH(log_rows)(image, cap, rows, out)) return Status::ok;
  return edge_log_ref(image, cap, rows, out);
}

}  // namespace lakshya
#endif

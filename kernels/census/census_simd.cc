// The reference's comparisons on as many pixels at once as a vector of bytes holds. Pixels whose window leaves the
// image go to the reference.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/census/census_simd.cc"
#include "hwy/foreach_target.h"
// foreach_target.h comes first, whatever the alphabet says.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/census/census.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Bytes = hn::ScalableTag<std::uint8_t>;

// Bits [first, first + 8) of the codes of the pixels at `pixel`, one byte each.
template <int kFirst>
hn::Vec<Bytes> code_byte(Bytes d, const std::uint8_t* pixel, std::ptrdiff_t stride) {
  auto byte = hn::Zero(d);
  for (int k = kFirst; k < kFirst + 8 && k < kCensusBits; ++k) {
    constexpr int kSide = 2 * kCensusRadiusU + 1;
    const std::ptrdiff_t x = k % kSide - kCensusRadiusU;
    const std::ptrdiff_t y = k / kSide - kCensusRadiusV;
    const auto here = hn::LoadU(d, pixel + y * stride + x);
    const auto opposite = hn::LoadU(d, pixel - y * stride - x);
    // here >= opposite
    const auto set = hn::VecFromMask(d, hn::Eq(hn::Max(here, opposite), here));
    byte = hn::Or(byte, hn::And(set, hn::Set(d, static_cast<std::uint8_t>(1U << (k - kFirst)))));
  }
  return byte;
}

// Row v, its window inside the image's rows.
void census_row(ImageView<const std::uint8_t> image, int v, ImageView<std::uint32_t> codes) {
  const Bytes d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const int begin = kCensusRadiusU;
  const int end = image.width - kCensusRadiusU;
  if (end - begin < lanes) return census_columns_ref(image, v, 0, image.width, codes);
  for (int u = begin; u < end; u += lanes) {
    const int first = std::min(u, end - lanes);  // the last vector overlaps the one before
    const std::uint8_t* pixel = image.row(v) + first;
    hn::StoreInterleaved4(code_byte<0>(d, pixel, image.stride), code_byte<8>(d, pixel, image.stride),
                          code_byte<16>(d, pixel, image.stride), code_byte<24>(d, pixel, image.stride), d,
                          reinterpret_cast<std::uint8_t*>(codes.row(v) + first));
  }
  census_columns_ref(image, v, 0, begin, codes);
  census_columns_ref(image, v, end, image.width, codes);
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lakshya {

HWY_EXPORT(census_row);

Status census_simd(ImageView<const std::uint8_t> image, Rows rows, ImageView<std::uint32_t> codes) {
  if (!same_size(image, codes)) return Status::size_mismatch;
  if (!rows_inside(rows, image)) return Status::bad_argument;
  for (int v = rows.begin; v < rows.end; ++v) {
    if (v >= kCensusRadiusV && v < image.height - kCensusRadiusV) {
      HWY_DYNAMIC_DISPATCH(census_row)(image, v, codes);
    } else {
      census_columns_ref(image, v, 0, image.width, codes);
    }
  }
  return Status::ok;
}

}  // namespace lakshya
#endif

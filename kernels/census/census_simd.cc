// The reference's comparisons on as many pixels at once as a vector of bytes holds. The seven rows of the window are
// copied to where their borders can be repeated, so that all pixels are alike, and in a form in which a comparison is one
// instruction.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/census/census_simd.cc"
#include "hwy/foreach_target.h"
// foreach_target.h comes first, whatever the alphabet says.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/census/census.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Bytes = hn::ScalableTag<std::int8_t>;
using UnsignedBytes = hn::RebindToUnsigned<Bytes>;

constexpr int kSideU = 2 * kCensusRadiusU + 1;
constexpr int kSideV = 2 * kCensusRadiusV + 1;
constexpr int kStrip = 1024;  // columns at a time, so that the copies need no memory of the caller's

// A row of the image less 128 (x86 compares signed bytes only). Element 0 belongs to column strip.begin - kCensusRadiusU.
using WindowRow = std::array<std::int8_t, kStrip + 2 * kCensusRadiusU>;

// Columns [begin, end) of the image.
struct Strip {
  int begin;
  int end;
};

void copy_row(const std::uint8_t* row, int width, Strip strip, WindowRow& copy) {
  const UnsignedBytes d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const int first_column = strip.begin - kCensusRadiusU;
  const auto index = [&](int u) { return static_cast<std::size_t>(u - first_column); };
  const int begin = std::max(strip.begin - kCensusRadiusU, 0);
  const int end = std::min(strip.end + kCensusRadiusU, width);
  for (int u = begin; u < end; u += lanes) {
    const int first = std::min(u, end - lanes);  // the last vector overlaps the one before
    const auto pixels = hn::Xor(hn::LoadU(d, row + first), hn::Set(d, 0x80));
    hn::StoreU(hn::BitCast(Bytes(), pixels), Bytes(), &copy[index(first)]);
  }
  for (int u = first_column; u < begin; ++u)
    copy[index(u)] = copy[index(begin)];
  for (int u = end; u < strip.end + kCensusRadiusU; ++u)
    copy[index(u)] = copy[index(end - 1)];
}

// Bits [kFirst, kFirst + 8) of the codes of the pixels from element i of the strip on, one byte each.
template <int kFirst>
hn::Vec<UnsignedBytes> code_byte(const std::array<const std::int8_t*, kSideV>& window, int i) {
  const Bytes d;
  constexpr int kEnd = std::min(kFirst + 8, kCensusBits);
  auto smaller = hn::Zero(d);  // the complement of the bits
  for (int k = kEnd - 1; k >= kFirst; --k) {
    const int x = kCensusOffsets[static_cast<std::size_t>(k)].x + kCensusRadiusU;
    const int y = kCensusOffsets[static_cast<std::size_t>(k)].y + kCensusRadiusV;
    const auto here = hn::LoadU(d, window[static_cast<std::size_t>(y)] + i + x);
    const auto opposite = hn::LoadU(d, window[static_cast<std::size_t>(kSideV - 1 - y)] + i + kSideU - 1 - x);
    smaller = hn::Sub(hn::Add(smaller, smaller), hn::VecFromMask(d, hn::Lt(here, opposite)));
  }
  const auto ones = hn::Set(d, static_cast<std::int8_t>((1 << (kEnd - kFirst)) - 1));
  return hn::BitCast(UnsignedBytes(), hn::Xor(smaller, ones));
}

void code_row(const std::array<const std::int8_t*, kSideV>& window, int width, CensusCode* codes) {
  const UnsignedBytes d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int i = 0; i < width; i += lanes) {
    const int first = std::min(i, width - lanes);
    hn::StoreInterleaved2(code_byte<0>(window, first), code_byte<8>(window, first), d,
                          reinterpret_cast<std::uint8_t*>(codes + first));
  }
}

void census_strip(const ImageView<const std::uint8_t>& image, Rows rows, Strip strip,
                  const ImageView<CensusCode>& codes) {
  std::array<WindowRow, kSideV> ring;
  const int first = rows.begin - kCensusRadiusV;
  const auto in_ring = [&](int v) -> WindowRow& { return ring[static_cast<std::size_t>((v - first) % kSideV)]; };
  for (int v = first; v < rows.end + kCensusRadiusV; ++v) {
    copy_row(image.row(std::clamp(v, 0, image.height - 1)), image.width, strip, in_ring(v));
    const int centre = v - kCensusRadiusV;
    if (centre < rows.begin) continue;
    std::array<const std::int8_t*, kSideV> window;
    for (int y = 0; y < kSideV; ++y)
      window[static_cast<std::size_t>(y)] = in_ring(v - kSideV + 1 + y).data();
    code_row(window, strip.end - strip.begin, codes.row(centre) + strip.begin);
  }
}

// The arguments are right.
Status census_rows(const ImageView<const std::uint8_t>& image, Rows rows, const ImageView<CensusCode>& codes) {
  if (rows.begin == rows.end) return Status::ok;
  if (image.width < static_cast<int>(hn::Lanes(Bytes()))) return census_ref(image, rows, codes);
  const int strips = (image.width + kStrip - 1) / kStrip;
  for (int i = 0; i < strips; ++i) {
    const Rows strip = rows_of_band(image.width, strips, i);
    census_strip(image, rows, {strip.begin, strip.end}, codes);
  }
  return Status::ok;
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lakshya {

HWY_EXPORT(census_rows);

Status census_simd(ImageView<const std::uint8_t> image, Rows rows, ImageView<CensusCode> codes) {
  if (!same_size(image, codes)) return Status::size_mismatch;
  if (!rows_inside(rows, image)) return Status::bad_argument;
  return HWY_DYNAMIC_DISPATCH(census_rows)(image, rows, codes);
}

}  // namespace lakshya
#endif

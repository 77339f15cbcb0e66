#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/base/peak_simd.cc"
#include "hwy/foreach_target.h"
// foreach_target.h comes first, whatever the alphabet says.
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/peak.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Bytes = hn::ScalableTag<std::uint8_t>;

std::uint8_t digest_of(hn::Vec<Bytes> v) {
  return static_cast<std::uint8_t>(hn::GetLane(hn::SumsOf8(v)));
}

// Eight chains that do not wait for each other: enough to hide the latency of one operation.
PeakWork peak_operations(std::int64_t rounds) {
  constexpr std::uint64_t kOperationsPerRound = 16;
  const Bytes d;
  const auto step = hn::Set(d, std::uint8_t{3});
  const auto limit = hn::Set(d, std::uint8_t{201});
  auto a = hn::Iota(d, 0), b = hn::Iota(d, 1), c = hn::Iota(d, 2), e = hn::Iota(d, 3);
  auto f = hn::Iota(d, 4), g = hn::Iota(d, 5), h = hn::Iota(d, 6), i = hn::Iota(d, 7);
  for (std::int64_t round = 0; round < rounds; ++round) {
    a = hn::Min(hn::SaturatedAdd(a, step), limit);
    b = hn::Min(hn::SaturatedAdd(b, step), limit);
    c = hn::Min(hn::SaturatedAdd(c, step), limit);
    e = hn::Min(hn::SaturatedAdd(e, step), limit);
    f = hn::Min(hn::SaturatedAdd(f, step), limit);
    g = hn::Min(hn::SaturatedAdd(g, step), limit);
    h = hn::Min(hn::SaturatedAdd(h, step), limit);
    i = hn::Min(hn::SaturatedAdd(i, step), limit);
  }
  const auto all = hn::Max(hn::Max(hn::Max(a, b), hn::Max(c, e)), hn::Max(hn::Max(f, g), hn::Max(h, i)));
  return {kOperationsPerRound * hn::Lanes(d) * static_cast<std::uint64_t>(rounds), digest_of(all)};
}

PeakWork peak_read(std::span<const std::uint8_t> bytes) {
  const Bytes d;
  const std::size_t lanes = hn::Lanes(d);
  auto a = hn::Zero(d), b = hn::Zero(d), c = hn::Zero(d), e = hn::Zero(d);
  std::size_t at = 0;
  for (; at + 4 * lanes <= bytes.size(); at += 4 * lanes) {
    a = hn::Or(a, hn::LoadU(d, bytes.data() + at));
    b = hn::Or(b, hn::LoadU(d, bytes.data() + at + lanes));
    c = hn::Or(c, hn::LoadU(d, bytes.data() + at + 2 * lanes));
    e = hn::Or(e, hn::LoadU(d, bytes.data() + at + 3 * lanes));
  }
  return {at, digest_of(hn::Or(hn::Or(a, b), hn::Or(c, e)))};
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lakshya {

HWY_EXPORT(peak_operations);
HWY_EXPORT(peak_read);

PeakWork peak_operations_simd(std::int64_t rounds) {
  return HWY_DYNAMIC_DISPATCH(peak_operations)(rounds);
}

PeakWork peak_read_simd(std::span<const std::uint8_t> bytes) {
  return HWY_DYNAMIC_DISPATCH(peak_read)(bytes);
}

}  // namespace lakshya
#endif

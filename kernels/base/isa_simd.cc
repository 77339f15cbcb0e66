#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/base/isa_simd.cc"
#include "hwy/foreach_target.h"
// foreach_target.h comes first, whatever the alphabet says.
#include <array>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/base/isa.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {

// What this copy of the code was compiled for.
std::int64_t compiled_for() {
  return HWY_TARGET;
}

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lakshya {
namespace {

HWY_EXPORT(compiled_for);

struct NamedTarget {
  const char* name;
  std::int64_t target;
};

#if HWY_ARCH_X86
constexpr NamedTarget kTargets[] = {
    {"avx3_dl", HWY_AVX3_DL}, {"avx3", HWY_AVX3}, {"avx2", HWY_AVX2}, {"sse4", HWY_SSE4}, {"ssse3", HWY_SSSE3}};
#elif HWY_ARCH_ARM
constexpr NamedTarget kTargets[] = {
    {"sve2", HWY_SVE2 | HWY_SVE2_128}, {"sve", HWY_SVE | HWY_SVE_256}, {"neon", HWY_NEON}};
#else
constexpr NamedTarget kTargets[] = {{"portable", ~std::int64_t{0}}};
#endif

struct Available {
  std::array<const char*, std::size(kTargets)> names{};
  std::array<std::int64_t, std::size(kTargets)> targets{};
  std::size_t count = 0;
};

const Available& available() {
  static const Available found = [] {
    Available a;
    const std::int64_t usable = HWY_SUPPORTED_TARGETS & HWY_TARGETS;
    for (const NamedTarget& t : kTargets) {
      if ((usable & t.target) == 0) continue;
      a.names[a.count] = t.name;
      a.targets[a.count] = t.target;
      ++a.count;
    }
    return a;
  }();
  return found;
}

void choose([[maybe_unused]] std::int64_t target) {
#if (HWY_TARGETS & (HWY_TARGETS - 1)) != 0
  hwy::GetChosenTarget().Update(target);
#endif
}

}  // namespace

std::span<const char* const> available_isas() {
  return {available().names.data(), available().count};
}

const char* active_isa() {
  const std::int64_t active = HWY_DYNAMIC_DISPATCH(compiled_for)();
  for (const NamedTarget& t : kTargets) {
    if ((active & t.target) != 0) return t.name;
  }
  return "none";
}

Status use_isa(std::string_view name) {
  const std::string_view wanted = name == "avx512" ? "avx3" : name;
  const Available& a = available();
  for (std::size_t i = 0; i < a.count; ++i) {
    if (wanted != "best" && wanted != a.names[i]) continue;
    choose(a.targets[i]);
    return Status::ok;
  }
  return Status::bad_argument;
}

}  // namespace lakshya
#endif

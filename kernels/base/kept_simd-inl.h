// A vector as part of a class: vectors of SVE have no size that the compiler knows and may not be members or elements of
// arrays, so that there the lanes lie in memory.
#if defined(LAKSHYA_KEPT_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LAKSHYA_KEPT_SIMD_INL
#undef LAKSHYA_KEPT_SIMD_INL
#else
#define LAKSHYA_KEPT_SIMD_INL
#endif

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace lakshya {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Constructors are written out: g++ compiles implicit ones for the baseline, without the target's instructions.
template <class D>
class Kept {
 public:
  using V = hn::Vec<D>;

#if HWY_ARCH_ARM && HWY_TARGET != HWY_NEON
  HWY_INLINE Kept() {}
  HWY_INLINE Kept(V v) {
    hn::StoreU(v, D(), lanes_);
  }
  HWY_INLINE V get() const {
    return hn::LoadU(D(), lanes_);
  }

 private:
  hn::TFromD<D> lanes_[hn::MaxLanes(D())];
#else
  HWY_INLINE Kept() {}
  HWY_INLINE Kept(V v) : v_(v) {}
  HWY_INLINE V get() const {
    return v_;
  }

 private:
  V v_;
#endif
};

}  // namespace HWY_NAMESPACE
}  // namespace lakshya
HWY_AFTER_NAMESPACE();

#endif

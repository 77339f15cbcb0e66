// Counts calls of operator new in this executable. Include in one source file of a test only. Under clang's
// ThreadSanitizer, which brings its own operator new, nothing is counted; the other presets do.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace lakshya::test {

inline std::atomic<int> allocations = 0;

}  // namespace lakshya::test

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define LAKSHYA_OPERATOR_NEW_IS_TAKEN
#endif
#endif

#ifndef LAKSHYA_OPERATOR_NEW_IS_TAKEN
// Not inlined: g++ 12 would see malloc meet delete and warn.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++lakshya::test::allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++lakshya::test::allocations;
  const auto step = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(step, (size + step - 1) / step * step)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
  std::free(memory);
}
#endif

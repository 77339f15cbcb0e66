// Which instruction set the *_simd.cc kernels run on. They are compiled for several (on x86) or for the one that the
// compiler targets (on Arm boards), and choose the best that the machine has; tests, comparisons and benchmarks
// choose one by name. All of them give the same results, bit for bit.
#pragma once

#include <span>
#include <string_view>

#include "kernels/base/status.h"

namespace lakshya {

// Names, best first: avx3_dl, avx3, avx2, sse4; neon; sve2, sve. Compiled in, and this machine has them.
std::span<const char* const> available_isas();

// The one that kernels use now, asked by the call that kernels make.
const char* active_isa();

// From now on, in the whole process; not while a kernel runs. "best" (the state at start), a name of available_isas(),
// or avx512 for avx3. bad_argument: not available here; nothing changes.
Status use_isa(std::string_view name);

}  // namespace lakshya

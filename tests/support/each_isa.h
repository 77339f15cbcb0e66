// Tests of *_simd kernels run on every instruction set that is compiled in and that the machine has.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "kernels/base/isa.h"

namespace lakshya::test {

// Calls test(name) with each instruction set in use, says which ran, and leaves the best one chosen. It fails when none
// ran: a test that compared nothing must not pass.
template <class Test>
void for_each_isa(Test&& test) {
  std::string ran;
  for (const char* isa : available_isas()) {
    ASSERT_EQ(use_isa(isa), Status::ok) << isa;
    ASSERT_STREQ(active_isa(), isa);
    SCOPED_TRACE(isa);
    test(isa);
    if (testing::Test::HasFatalFailure()) break;
    ran += ran.empty() ? isa : std::string(",") + isa;
  }
  EXPECT_EQ(use_isa("best"), Status::ok);
  ASSERT_FALSE(ran.empty()) << "no instruction set to test";
  testing::Test::RecordProperty("instruction_sets", ran);
}

// 0, 1 and around every vector length in bytes, and around a multiple with a remainder.
inline std::vector<int> awkward_widths() {
  return {0, 1, 7, 8, 15, 16, 17, 23, 24, 25, 31, 32, 33, 40, 41, 63, 64, 65, 71, 72, 73, 127, 128, 129, 203};
}

}  // namespace lakshya::test

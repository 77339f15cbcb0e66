// Instruction sets by name, and that choosing one changes what runs.
#include "kernels/base/isa.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#ifdef __ARM_FEATURE_SVE
#include <arm_sve.h>
#endif

namespace lakshya {
namespace {

std::vector<std::string> available() {
  return {available_isas().begin(), available_isas().end()};
}

// Variables of the preset and of ./dev test-arm; nullptr: nothing is expected.
const char* expected(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0' ? value : nullptr;
}

class Isa : public testing::Test {
 protected:
  void TearDown() override { EXPECT_EQ(use_isa("best"), Status::ok); }
};

TEST_F(Isa, TheBestIsInUseAtTheStart) {
  ASSERT_FALSE(available_isas().empty());
  EXPECT_STREQ(active_isa(), available_isas().front());
}

TEST_F(Isa, NamesAreKnownAndInOrder) {
  const std::vector<std::string> best_first = {"avx3_dl", "avx3", "avx2", "sse4", "ssse3", "sve2", "sve", "neon"};
  std::vector<std::string> in_order;
  for (const std::string& name : best_first) {
    if (const auto names = available(); std::find(names.begin(), names.end(), name) != names.end()) {
      in_order.push_back(name);
    }
  }
  EXPECT_EQ(available(), in_order);
}

TEST_F(Isa, EachCanBeChosenAndBestLeadsBack) {
  for (const std::string& name : available()) {
    EXPECT_EQ(use_isa(name), Status::ok);
    EXPECT_EQ(active_isa(), name);
  }
  EXPECT_EQ(use_isa("best"), Status::ok);
  EXPECT_STREQ(active_isa(), available_isas().front());
}

TEST_F(Isa, AnUnknownNameChangesNothing) {
  ASSERT_EQ(use_isa(available_isas().back()), Status::ok);
  for (const char* name : {"", "avx", "AVX2", "avx2 ", "none", "rvv"}) {
    EXPECT_EQ(use_isa(name), Status::bad_argument) << name;
    EXPECT_STREQ(active_isa(), available_isas().back()) << name;
  }
}

TEST_F(Isa, Avx512IsAvx3) {
  const auto names = available();
  const bool here = std::find(names.begin(), names.end(), "avx3") != names.end();
  EXPECT_EQ(use_isa("avx512"), here ? Status::ok : Status::bad_argument);
  EXPECT_STREQ(active_isa(), here ? "avx3" : available_isas().front());
}

#ifdef __x86_64__
TEST_F(Isa, EveryX86MachineHasSse4) {
  EXPECT_EQ(available().back(), "sse4");
  EXPECT_EQ(available().size() > 1, __builtin_cpu_supports("avx2") != 0);
}
#endif

TEST_F(Isa, RunsOnWhatThePresetWasMadeFor) {
  const char* isa = expected("LAKSHYA_EXPECT_ISA");
  if (isa == nullptr) GTEST_SKIP() << "LAKSHYA_EXPECT_ISA is not set";
  EXPECT_EQ(available(), std::vector<std::string>{isa});
  EXPECT_STREQ(active_isa(), isa);
}

#ifdef __ARM_FEATURE_SVE
TEST_F(Isa, VectorsAreAsLongAsAskedFor) {
  const char* bits = expected("LAKSHYA_EXPECT_VECTOR_BITS");
  if (bits == nullptr) GTEST_SKIP() << "LAKSHYA_EXPECT_VECTOR_BITS is not set";
  EXPECT_EQ(std::to_string(8 * svcntb()), bits);
}
#endif

}  // namespace
}  // namespace lakshya

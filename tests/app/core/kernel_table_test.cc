#include "app/core/kernel_table.h"

#include <gtest/gtest.h>

#include <string>

#include "app/core/input_error.h"

namespace lakshya {
namespace {

std::string refusal_of(const char* choice) {
  try {
    (void)kernels_by_name(choice);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(KernelTable, OneNameIsThatBackendForAllKernels) {
  const KernelTable simd = kernels_by_name("simd");
  EXPECT_EQ(simd.rectify, rectify_simd);
  EXPECT_EQ(simd.polar_histogram, polar_histogram_simd);
  const KernelTable ref = kernels_by_name("ref");
  EXPECT_EQ(ref.rectify, rectify_ref);
  EXPECT_EQ(ref.polar_histogram, polar_histogram_ref);
}

TEST(KernelTable, ExceptionsReplaceSingleKernels) {
  const KernelTable mixed = kernels_by_name("simd,sgm=ref,polar_histogram=ref");
  EXPECT_EQ(mixed.sgm, sgm_ref);
  EXPECT_EQ(mixed.polar_histogram, polar_histogram_ref);
  EXPECT_EQ(mixed.census, census_simd);
}

TEST(KernelTable, UnknownNamesAreRefusedWithThoseThatExist) {
  EXPECT_NE(refusal_of("gpu").find("ref, simd"), std::string::npos) << refusal_of("gpu");
  EXPECT_NE(refusal_of("simd,sgn=ref").find("polar_histogram"), std::string::npos) << refusal_of("simd,sgn=ref");
  EXPECT_NE(refusal_of("simd,sgm").find("kernel=backend"), std::string::npos) << refusal_of("simd,sgm");
}

TEST(KernelTable, BothBackendsTakeBuffersOfTheHost) {
  for (const Backend& backend : kBackends)
    EXPECT_EQ(backend.kernels->memory, Memory::host) << backend.name;
}

}  // namespace
}  // namespace lakshya

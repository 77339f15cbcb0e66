// sgm_simd against sgm_ref: shapes, ranges and parameters at random, on every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>

#include "kernels/census/census.h"
#include "kernels/sgm/sgm.h"
#include "tests/support/each_isa.h"
#include "tests/support/test_image.h"
#include "tests/support/test_scratch.h"

namespace lakshya {
namespace {

using test::PaddedImage;
using test::Scratch;

// An emulated processor takes fifty times as long.
#if defined(__aarch64__)
constexpr int kTrials = 250;
#else
constexpr int kTrials = 1000;
#endif

struct Trial {
  int width = 0;
  int height = 0;
  Rows descriptor_rows;
  Rows rows;
  SgmParams params;

  std::string text() const {
    std::ostringstream out;
    const SearchRange& r = params.range;
    out << width << "x" << height << " rows " << rows.begin << ".." << rows.end << " of " << descriptor_rows.begin
        << ".." << descriptor_rows.end << ", first " << r.first << ", disparities " << r.disparities << ", columns "
        << r.valid_begin << ".." << r.valid_end << ", paths " << params.paths << ", p1 " << params.p1 << ", p2 "
        << params.p2_min << ".." << params.p2 << " slope " << params.p2_slope << ", uniqueness "
        << params.select.uniqueness_percent << ", left-right " << params.select.left_right_max;
    return out.str();
  }
};

class SgmSimd : public testing::Test {
 protected:
  int between(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  template <class T>
  T one_of(std::initializer_list<T> values) {
    return values.begin()[between(0, static_cast<int>(values.size()) - 1)];
  }

  Trial random_trial() {
    Trial t;
    t.width = one_of({1, 2, 7, 15, 16, 17, 31, 33, 47, 64, 65, 90, 130});
    t.height = between(1, 9);
    t.descriptor_rows = {between(0, t.height / 2), between(t.height / 2, t.height)};
    t.rows = {between(0, t.height), t.height};
    if (between(0, 1) == 0) t.rows.begin = 0;
    if (between(0, 1) == 0) t.descriptor_rows = {0, t.height};
    SgmParams& p = t.params;
    p.range.disparities = one_of({16, 32, 48, 64, 80, 96, 112, 128, 144, 192, 256, 512});
    p.range.first = one_of({0, 0, 0, 1, 5, -3, -20, 40, 200, -600, 3000});
    p.range.valid_begin = one_of({0, 0, between(0, t.width)});
    p.range.valid_end = one_of({t.width, t.width, between(p.range.valid_begin, t.width)});
    p.select.uniqueness_percent = one_of({0, 4, 15, 60, 99});
    p.select.left_right_max = one_of({-1, 0, 1, 3});
    p.select.offset16 = std::max(0, -16 * p.range.first) + between(0, 20);
    p.paths = one_of({3, 5});
    p.p2_min = between(0, 182);
    p.p1 = one_of({0, std::min(14, p.p2_min), p.p2_min});
    p.p2 = between(p.p2_min, 182);
    p.p2_slope = one_of({0, 1, 2, 30, 255});
    p.warmup_rows = between(0, 4);
    return t;
  }

  // Two views of one random texture, more or less apart and more or less noisy; now and then with nothing in common.
  void make_images(const Trial& t) {
    left_ = PaddedImage<std::uint8_t>(t.width, t.height);
    right_ = PaddedImage<std::uint8_t>(t.width, t.height);
    textured_ = PaddedImage<std::uint8_t>(t.width, t.height);
    const int contrast = one_of({0, 3, 60, 255});
    const int noise = one_of({0, 0, 2, 40});
    const int shift = t.params.range.first + between(0, t.params.range.disparities);
    test::fill_random(left_.view(), random_, 0, contrast);
    test::fill_random(textured_.view(), random_, 0, 4);
    for (int v = 0; v < t.height; ++v) {
      for (int u = 0; u < t.width; ++u) {
        const int from = std::clamp(u + shift, 0, t.width - 1);
        right_.view().at(u, v) =
            static_cast<std::uint8_t>(std::min(left_.view().at(from, v) + between(0, noise), 255));
      }
    }
    left_codes_ = PaddedImage<CensusCode>(t.width, t.height);
    right_codes_ = PaddedImage<CensusCode>(t.width, t.height);
    ASSERT_EQ(census_ref(left_.view(), {0, t.height}, left_codes_.view()), Status::ok);
    ASSERT_EQ(census_ref(right_.view(), {0, t.height}, right_codes_.view()), Status::ok);
  }

  template <class Sgm>
  void run(Sgm&& sgm, const Trial& t, PaddedImage<std::int16_t>& out) {
    Scratch scratch(sgm_scratch_bytes(t.width, t.params.range.disparities));
    EXPECT_EQ(sgm(left_.view(), left_codes_.view(), right_codes_.view(), textured_.view(), t.descriptor_rows,
                  t.params, t.rows, scratch.span(), out.view()),
              Status::ok)
        << t.text();
    EXPECT_TRUE(out.canaries_alive()) << t.text();
  }

  std::mt19937 random_{11};
  PaddedImage<std::uint8_t> left_{0, 0}, right_{0, 0}, textured_{0, 0};
  PaddedImage<CensusCode> left_codes_{0, 0}, right_codes_{0, 0};
};

TEST_F(SgmSimd, EqualsTheReference) {
  for (int round = 0; round < kTrials; ++round) {
    const Trial t = random_trial();
    make_images(t);
    PaddedImage<std::int16_t> expected(t.width, t.height);
    run(sgm_ref, t, expected);
    test::for_each_isa([&](const char* isa) {
      PaddedImage<std::int16_t> out(t.width, t.height);
      run(sgm_simd, t, out);
      ASSERT_TRUE(test::equal_images(out.view(), expected.view())) << isa << ": " << t.text();
    });
    if (HasFatalFailure()) return;
  }
}

TEST_F(SgmSimd, RefusesWhatTheReferenceRefuses) {
  Trial t;
  t.width = 40;
  t.height = 3;
  t.descriptor_rows = t.rows = {0, 3};
  t.params.range = {.first = 0, .disparities = 16, .valid_begin = 0, .valid_end = 40};
  make_images(t);
  PaddedImage<std::int16_t> out(40, 3);
  Scratch scratch(sgm_scratch_bytes(40, 16));
  const auto status = [&](const SgmParams& params, std::span<std::byte> bytes, ImageView<std::int16_t> disparity) {
    return sgm_simd(left_.view(), left_codes_.view(), right_codes_.view(), textured_.view(), t.descriptor_rows,
                    params, t.rows, bytes, disparity);
  };
  EXPECT_EQ(status(t.params, scratch.span(), out.view()), Status::ok);
  SgmParams wrong = t.params;
  wrong.paths = 4;
  EXPECT_EQ(status(wrong, scratch.span(), out.view()), Status::bad_argument);
  EXPECT_EQ(status(t.params, scratch.span().first(100), out.view()), Status::scratch_too_small);
  PaddedImage<std::int16_t> small(39, 3);
  EXPECT_EQ(status(t.params, scratch.span(), small.view()), Status::size_mismatch);
}

}  // namespace
}  // namespace lakshya

#include "kernels/block/block.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kernels/base/units.h"
#include "kernels/census/census.h"
#include "kernels/edge/edge.h"
#include "tests/support/block_pair.h"
#include "tests/support/each_isa.h"
#include "tests/support/test_image.h"
#include "tests/support/test_scratch.h"

namespace lakshya {
namespace {

using test::BlockPair;
using test::PaddedImage;
using test::Scratch;

BlockParams params_for(int width, int disparities = 16) {
  BlockParams p;
  p.range = {.first = 0, .disparities = disparities, .valid_begin = 0, .valid_end = width};
  return p;
}

::testing::AssertionResult same_disparities(const PaddedImage<std::int16_t>& a,
                                            const PaddedImage<std::int16_t>& b) {
  for (int v = 0; v < a.view().height; ++v) {
    for (int u = 0; u < a.view().width; ++u) {
      if (a.view().at(u, v) != b.view().at(u, v)) {
        return ::testing::AssertionFailure()
               << "(" << u << "," << v << "): " << a.view().at(u, v) << " and " << b.view().at(u, v);
      }
    }
  }
  return ::testing::AssertionSuccess();
}

template <class Matcher>
class Block : public ::testing::Test {};
using Matchers = ::testing::Types<test::CensusBlock, test::SadBlock, test::CensusBlockSimd, test::SadBlockSimd>;
TYPED_TEST_SUITE(Block, Matchers);

// Three equal rows; at u = 18 with radius 1 the costs of columns 17, 18, 19 per row are
//   i = 4: |9-28| + |30-20| + |21- 0| = 50
//   i = 5: |9-10| + |30-28| + |21-20| =  4
//   i = 6: |9- 0| + |30-10| + |21-28| = 36, all others larger.
// num = 14, den = 78: floor((16 * 14 + 78) / 156) = 1, and the same with the rows' number in num and den.
TEST(SadBlock, HandComputedWindow) {
  constexpr int kWidth = 20;
  PaddedImage<std::uint8_t> left(kWidth, 3, 5, 0);
  PaddedImage<std::uint8_t> right(kWidth, 3, 5, 0);
  for (int v = 0; v < 3; ++v) {
    left.view().at(17, v) = 9;
    left.view().at(18, v) = 30;
    left.view().at(19, v) = 21;
    right.view().at(12, v) = 10;
    right.view().at(13, v) = 28;
    right.view().at(14, v) = 20;
  }
  const PaddedImage<std::uint8_t> textured(kWidth, 3, 3, 1);
  PaddedImage<std::int16_t> out(kWidth, 3);
  BlockParams p = params_for(kWidth);
  p.select = {.uniqueness_percent = 0, .left_right_max = -1, .offset16 = 0};
  p.radius_u = p.radius_v = 1;
  const Scratch scratch(block_scratch_bytes(kWidth, 16, 1));
  const auto disparity_at_18 = [&](int v) {
    EXPECT_EQ(
        sad_block_ref(left.view(), right.view(), textured.view(), {0, 3}, p, {0, 3}, scratch.span(), out.view()),
        Status::ok);
    return out.view().at(18, v);
  };
  EXPECT_EQ(disparity_at_18(0), 16 * 5 + 1);  // window of two rows
  EXPECT_EQ(disparity_at_18(1), 16 * 5 + 1);
  EXPECT_EQ(disparity_at_18(2), 16 * 5 + 1);
  // Row 2 now costs 9 + 30 + 21 = 60 for every candidate: S = 160, 68, 132 at v = 1, so num = 28, den = 156. At v =
  // 0 row 2 is not in the window.
  std::fill_n(right.view().row(2), kWidth, std::uint8_t{0});
  EXPECT_EQ(disparity_at_18(1), 16 * 5 + 1);
  EXPECT_EQ(disparity_at_18(0), 16 * 5 + 1);
  // Without the columns at the sides: S = 10, 2, 20: num = -10, den = 26: floor((-160 + 26) / 52) = -3.
  p.radius_u = p.radius_v = 0;
  EXPECT_EQ(disparity_at_18(1), 16 * 5 - 3);
}

TYPED_TEST(Block, EqualsTheDefinition) {
  struct Case {
    int width, height, radius_u, radius_v, first, begin, end;
    Rows descriptor_rows;
  };
  const Case cases[] = {
      {1, 1, 4, 4, 0, 0, 1, {0, 1}},       // smaller than the window
      {7, 9, 0, 0, -3, 0, 7, {0, 9}},      // no window
      {23, 9, 1, 2, 0, 1, 22, {1, 8}},     //
      {40, 12, 4, 4, 2, 4, 36, {3, 9}},    // window higher than the rows with descriptors
      {40, 11, 7, 0, -5, 3, 37, {2, 11}},  //
      {21, 20, 0, 7, -2, 0, 21, {0, 20}},  //
      {33, 33, 15, 15, -8, 0, 33, {0, 33}}, {30, 8, 2, 2, 0, 12, 12, {0, 8}},  // no column
      {30, 8, 2, 2, 0, 0, 30, {5, 5}},                                         // no row
      {0, 4, 2, 2, 0, 0, 0, {0, 4}},                                           // no pixel
      {9, 0, 2, 2, 0, 0, 9, {0, 0}},
  };
  unsigned seed = 0;
  for (const Case& c : cases) {
    for (const bool strict : {false, true}) {
      SCOPED_TRACE(::testing::Message() << c.width << "x" << c.height << " radii " << c.radius_u << ","
                                        << c.radius_v << (strict ? " strict" : " every winner"));
      BlockParams p = params_for(c.width, 32);
      p.range.first = c.first;
      p.range.valid_begin = c.begin;
      p.range.valid_end = c.end;
      p.radius_u = c.radius_u;
      p.radius_v = c.radius_v;
      p.edge_cap = 34;
      p.select.offset16 = std::max(0, -16 * c.first);
      if (!strict) p.select.uniqueness_percent = 0;
      if (!strict) p.select.left_right_max = -1;
      const BlockPair<TypeParam> pair(c.width, c.height, ++seed, p.edge_cap);
      EXPECT_TRUE(same_disparities(pair.matched(p, c.descriptor_rows), pair.defined(p, c.descriptor_rows)));
    }
  }
}

TYPED_TEST(Block, BandsGiveWhatTheWholeImageGives) {
  constexpr int kWidth = 31;
  constexpr int kHeight = 30;
  const BlockPair<TypeParam> pair(kWidth, kHeight, 7);
  for (const int radius_v : {0, 2, 15}) {
    BlockParams p = params_for(kWidth);
    p.radius_v = radius_v;
    p.select = {.uniqueness_percent = 0, .left_right_max = -1, .offset16 = 0};
    const Rows descriptor_rows{3, kHeight - 3};
    const PaddedImage<std::int16_t> whole = pair.matched(p, descriptor_rows);
    const Scratch scratch(block_scratch_bytes(kWidth, 16, radius_v));
    for (const int bands : {2, 5, kHeight}) {
      PaddedImage<std::int16_t> out(kWidth, kHeight, 5, 999);
      for (int b = bands - 1; b >= 0; --b) {
        const Rows rows = rows_of_band(kHeight, bands, b);
        ASSERT_EQ(pair.match(p, descriptor_rows, rows, scratch.span(), out.view()), Status::ok);
        ASSERT_TRUE(b == 0 || out.view().at(0, rows.begin - 1) == 999) << "a row above the band was written";
      }
      EXPECT_TRUE(same_disparities(out, whole)) << bands << " bands, radius " << radius_v;
      EXPECT_TRUE(out.canaries_alive());
    }
  }
}

// Random texture shifted by a known disparity, with a step half way down.
TYPED_TEST(Block, FindsAKnownShift) {
  constexpr int kWidth = 120;
  constexpr int kHeight = 48;
  std::mt19937 random(6);
  PaddedImage<std::uint8_t> left(kWidth, kHeight);
  PaddedImage<std::uint8_t> right(kWidth, kHeight);
  test::fill_random(left.view(), random, 0, 255);
  test::fill_random(right.view(), random, 0, 255);
  const auto shift = [](int v) { return v < 24 ? 5 : 11; };
  for (int v = 0; v < kHeight; ++v)
    std::copy_n(left.view().row(v) + shift(v), kWidth - shift(v), right.view().row(v));

  PaddedImage<typename TypeParam::Descriptor> left_described(kWidth, kHeight);
  PaddedImage<typename TypeParam::Descriptor> right_described(kWidth, kHeight);
  ASSERT_EQ(TypeParam::kDescribe(left.view(), {0, kHeight}, left_described.view()), Status::ok);
  ASSERT_EQ(TypeParam::kDescribe(right.view(), {0, kHeight}, right_described.view()), Status::ok);
  const PaddedImage<std::uint8_t> textured(kWidth, kHeight, 3, 1);
  PaddedImage<std::int16_t> out(kWidth, kHeight);
  BlockParams p = params_for(kWidth, 32);
  p.range.valid_begin = TypeParam::kRadiusU;
  p.range.valid_end = kWidth - TypeParam::kRadiusU;
  const Rows descriptor_rows{TypeParam::kRadiusV, kHeight - TypeParam::kRadiusV};
  const Scratch scratch(block_scratch_bytes(kWidth, 32, p.radius_v));
  ASSERT_EQ(TypeParam::kMatch(left_described.view(), right_described.view(), textured.view(), descriptor_rows, p,
                              {0, kHeight}, scratch.span(), out.view()),
            Status::ok);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const int d16 = out.view().at(u, v);
      const bool row_inside = v >= descriptor_rows.begin && v < descriptor_rows.end;
      if (!row_inside || u < p.range.valid_begin || u >= p.range.valid_end) {
        ASSERT_EQ(d16, kNotSearched);
      } else if (u >= 32 && (v < 16 || v >= 32)) {  // farther from the step than window and descriptor reach
        ASSERT_NEAR(d16, 16 * shift(v), 4) << u << "," << v;
      }
    }
  }
}

TYPED_TEST(Block, ScratchIsOfTheStatedSizeAndNotOverrun) {
  constexpr int kWidth = 17;
  for (const int radius_v : {0, 4}) {
    const std::size_t bytes = block_scratch_bytes(kWidth, 16, radius_v);
    EXPECT_LT(bytes, static_cast<std::size_t>(17 * 16 * (2 * radius_v + 5) + 17 * 1024));
    const BlockPair<TypeParam> pair(kWidth, 100, 8);
    BlockParams p = params_for(kWidth);
    p.radius_v = radius_v;
    PaddedImage<std::int16_t> out(kWidth, 100);
    const Scratch scratch(bytes + 64);
    std::fill(scratch.span().begin(), scratch.span().end(), std::byte{0x5A});
    ASSERT_EQ(pair.match(p, {0, 100}, {0, 100}, scratch.span().first(bytes), out.view()), Status::ok);
    for (std::size_t i = bytes; i < bytes + 64; ++i)
      ASSERT_EQ(scratch.span()[i], std::byte{0x5A});
  }
}

TYPED_TEST(Block, RefusesWrongArguments) {
  const BlockPair<TypeParam> pair(20, 10, 9);
  PaddedImage<std::int16_t> out(20, 10);
  const Scratch scratch(block_scratch_bytes(20, 16, kMaxBlockRadius));
  const auto run = [&](const BlockParams& p, Rows descriptor_rows = {0, 10}, Rows rows = {0, 10}) {
    return pair.match(p, descriptor_rows, rows, scratch.span(), out.view());
  };
  const BlockParams good = params_for(20);
  ASSERT_EQ(run(good), Status::ok);
  EXPECT_EQ(run(good, {0, 11}), Status::bad_argument);
  EXPECT_EQ(run(good, {0, 10}, {-1, 10}), Status::bad_argument);
  EXPECT_EQ(run(good, {0, 10}, {6, 5}), Status::bad_argument);
  for (const int radius : {-1, kMaxBlockRadius + 1}) {
    BlockParams p = good;
    p.radius_u = radius;
    EXPECT_EQ(run(p), Status::bad_argument);
    p = good;
    p.radius_v = radius;
    EXPECT_EQ(run(p), Status::bad_argument);
  }
  BlockParams p = good;
  p.range.disparities = 15;
  EXPECT_EQ(run(p), Status::bad_argument);
  p = good;
  p.select.uniqueness_percent = 100;
  EXPECT_EQ(run(p), Status::bad_argument);
  const std::size_t enough = block_scratch_bytes(20, 16, good.radius_v);
  EXPECT_EQ(pair.match(good, {0, 10}, {0, 10}, scratch.span().first(enough - 1), out.view()),
            Status::scratch_too_small);
  PaddedImage<std::int16_t> wrong(19, 10);
  EXPECT_EQ(pair.match(good, {0, 10}, {0, 10}, scratch.span(), wrong.view()), Status::size_mismatch);
}

template <class Matcher>
class BlockSimd : public ::testing::Test {};
using SimdMatchers = ::testing::Types<test::CensusBlockSimd, test::SadBlockSimd>;
TYPED_TEST_SUITE(BlockSimd, SimdMatchers);

// Widths around every vector, all kinds of candidates, more of them than columns, both signs of the first.
TYPED_TEST(BlockSimd, EqualsTheReference) {
  std::mt19937 random(12);
  const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  test::for_each_isa([&](const char* isa) {
    for (const int disparities : {16, 32, 48, 64, 96, 128, 192, 512}) {
      for (const int width : {0, 1, 15, 16, 17, 40, 65, 97, 160}) {
        constexpr int kHeight = 13;
        BlockParams p = params_for(width, disparities);
        p.radius_u = pick(0, 7);
        p.radius_v = pick(0, 5);
        p.range.first = pick(-40, 20);
        p.range.valid_begin = std::min(pick(0, 5), width);
        p.range.valid_end = std::max(p.range.valid_begin, width - pick(0, 5));
        p.edge_cap = pick(1, 127);
        p.select.offset16 = std::max(0, -16 * p.range.first) + pick(0, 20);
        p.select.uniqueness_percent = pick(0, 3) == 0 ? 0 : pick(0, 30);
        p.select.left_right_max = pick(-1, 3);
        const int largest_window = (2 * p.radius_u + 1) * (2 * p.radius_v + 1) * 2 * p.edge_cap;
        if (largest_window > 65535) p.edge_cap = 20;
        const Rows described{pick(0, 3), kHeight - pick(0, 3)};
        const BlockPair<TypeParam> pair(width, kHeight, static_cast<unsigned>(pick(0, 1000)), p.edge_cap);
        ASSERT_TRUE(same_disparities(pair.matched(p, described), pair.reference(p, described)))
            << isa << " " << width << " columns, " << disparities << " candidates from " << p.range.first
            << ", radii " << p.radius_u << "," << p.radius_v << ", uniqueness " << p.select.uniqueness_percent;
      }
    }
  });
}

TEST(SadBlock, RefusesCapsAndWindowsWhoseSumsWouldNotFit) {
  const BlockPair<test::SadBlock> pair(20, 10, 10);
  PaddedImage<std::int16_t> out(20, 10);
  const Scratch scratch(block_scratch_bytes(20, 16, kMaxBlockRadius));
  const auto run = [&](int radius_u, int radius_v, int cap) {
    BlockParams p = params_for(20);
    p.radius_u = radius_u;
    p.radius_v = radius_v;
    p.edge_cap = cap;
    return pair.match(p, {0, 10}, {0, 10}, scratch.span(), out.view());
  };
  EXPECT_EQ(run(1, 1, 0), Status::bad_argument);
  EXPECT_EQ(run(1, 1, 128), Status::bad_argument);
  EXPECT_EQ(run(15, 15, 34), Status::ok);            // 961 * 68 = 65348
  EXPECT_EQ(run(15, 15, 35), Status::bad_argument);  // 67270
  EXPECT_EQ(run(14, 14, 38), Status::ok);            // 841 * 76 = 63916
  EXPECT_EQ(run(14, 14, 39), Status::bad_argument);  // 65598
  EXPECT_EQ(run(10, 10, 63), Status::ok);            // 441 * 126 = 55566
  EXPECT_EQ(run(11, 11, 63), Status::bad_argument);  // 66654
  EXPECT_EQ(run(7, 8, 127), Status::ok);             // 255 * 254 = 64770
  EXPECT_EQ(run(8, 8, 127), Status::bad_argument);   // 73406
}

TEST(CensusBlock, AcceptsEveryWindowWhateverTheEdgeCap) {
  const BlockPair<test::CensusBlock> pair(20, 10, 11);
  BlockParams p = params_for(20);
  p.radius_u = p.radius_v = kMaxBlockRadius;
  p.edge_cap = 0;
  pair.matched(p, {0, 10});
}

}  // namespace
}  // namespace lakshya

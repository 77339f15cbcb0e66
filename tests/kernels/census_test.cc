#include "kernels/census/census.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/each_isa.h"
#include "tests/support/test_image.h"

namespace lakshya {
namespace {

using test::PaddedImage;

constexpr std::uint32_t kAllBits = (1U << kCensusBits) - 1;

std::uint32_t code_of_center(const PaddedImage<std::uint8_t>& image) {
  PaddedImage<CensusCode> codes(9, 7);
  EXPECT_EQ(census_ref(image.view(), {0, 7}, codes.view()), Status::ok);
  return codes.view().at(4, 3);
}

TEST(Census, FlatImageSetsEveryBit) {
  EXPECT_EQ(code_of_center(PaddedImage<std::uint8_t>(9, 7, 3, 50)), kAllBits);
}

TEST(Census, BrighteningDownwardsClearsTheUpperRows) {
  PaddedImage<std::uint8_t> image(9, 7);
  for (int v = 0; v < 7; ++v) {
    for (int u = 0; u < 9; ++u)
      image.view().at(u, v) = static_cast<std::uint8_t>(10 * v);
  }
  // Rows -3..-1 (14 bits) are darker than their opposites; within row 0 all are equal: the last two bits stay.
  EXPECT_EQ(code_of_center(image), 0x3U << 14);
}

// The squares of one colour of a chessboard, row by row down to the centre, are the bits; the others say nothing.
TEST(Census, OnePixelMovesOneBitOrNone) {
  unsigned bit = 1;
  for (int v = 0; v <= 3; ++v) {
    for (int u = 0; u < (v < 3 ? 9 : 4); ++u) {
      const bool compared = (u + v) % 2 == 0;
      const std::uint32_t expected = compared ? kAllBits & ~bit : kAllBits;
      PaddedImage<std::uint8_t> image(9, 7, 3, 100);
      image.view().at(u, v) = 99;  // now smaller than its opposite
      EXPECT_EQ(code_of_center(image), expected) << u << "," << v;
      image.view().at(u, v) = 100;
      image.view().at(8 - u, 6 - v) = 101;
      EXPECT_EQ(code_of_center(image), expected) << "opposite of " << u << "," << v;
      if (compared) bit <<= 1;
    }
  }
  EXPECT_EQ(bit, 1U << kCensusBits);
}

TEST(Census, TheCentreDoesNotMatter) {
  PaddedImage<std::uint8_t> image(9, 7, 3, 100);
  image.view().at(4, 3) = 0;
  EXPECT_EQ(code_of_center(image), kAllBits);
}

TEST(Census, UnchangedByGainAndOffset) {
  std::mt19937 random(2);
  PaddedImage<std::uint8_t> image(41, 19);
  test::fill_random(image.view(), random, 0, 100);
  PaddedImage<std::uint8_t> brighter(41, 19);
  for (int v = 0; v < 19; ++v) {
    for (int u = 0; u < 41; ++u) {
      brighter.view().at(u, v) = static_cast<std::uint8_t>(2 * image.view().at(u, v) + 30);
    }
  }
  PaddedImage<CensusCode> a(41, 19);
  PaddedImage<CensusCode> b(41, 19);
  ASSERT_EQ(census_ref(image.view(), {0, 19}, a.view()), Status::ok);
  ASSERT_EQ(census_ref(brighter.view(), {0, 19}, b.view()), Status::ok);
  for (int v = 0; v < 19; ++v) {
    for (int u = 0; u < 41; ++u)
      ASSERT_EQ(a.view().at(u, v), b.view().at(u, v));
  }
}

// As if the image were larger, with its border pixels repeated outwards.
TEST(Census, TheBorderIsRepeated) {
  std::mt19937 random(8);
  for (const int width : {1, 8, 9, 13}) {
    for (const int height : {1, 6, 7, 11}) {
      PaddedImage<std::uint8_t> image(width, height);
      test::fill_random(image.view(), random, 0, 255);
      PaddedImage<std::uint8_t> larger(width + 8, height + 6);
      for (int v = 0; v < height + 6; ++v) {
        for (int u = 0; u < width + 8; ++u) {
          larger.view().at(u, v) =
              image.view().at(std::clamp(u - 4, 0, width - 1), std::clamp(v - 3, 0, height - 1));
        }
      }
      PaddedImage<CensusCode> codes(width, height);
      PaddedImage<CensusCode> expected(width + 8, height + 6);
      ASSERT_EQ(census_ref(image.view(), {0, height}, codes.view()), Status::ok);
      ASSERT_EQ(census_ref(larger.view(), {0, height + 6}, expected.view()), Status::ok);
      for (int v = 0; v < height; ++v) {
        for (int u = 0; u < width; ++u)
          ASSERT_EQ(codes.view().at(u, v), expected.view().at(u + 4, v + 3)) << u << "," << v;
      }
      EXPECT_TRUE(codes.canaries_alive());
    }
  }
}

TEST(Census, EmptyImage) {
  const PaddedImage<std::uint8_t> image(0, 0);
  PaddedImage<CensusCode> codes(0, 0);
  EXPECT_EQ(census_ref(image.view(), {0, 0}, codes.view()), Status::ok);
}

TEST(Census, RowRangesGiveTheSameAsTheWhole) {
  std::mt19937 random(3);
  PaddedImage<std::uint8_t> image(30, 20);
  test::fill_random(image.view(), random, 0, 255);
  PaddedImage<CensusCode> whole(30, 20);
  PaddedImage<CensusCode> parts(30, 20);
  ASSERT_EQ(census_ref(image.view(), {0, 20}, whole.view()), Status::ok);
  ASSERT_EQ(census_ref(image.view(), {0, 7}, parts.view()), Status::ok);
  ASSERT_EQ(census_ref(image.view(), {7, 20}, parts.view()), Status::ok);
  for (int v = 0; v < 20; ++v) {
    for (int u = 0; u < 30; ++u)
      ASSERT_EQ(parts.view().at(u, v), whole.view().at(u, v));
  }
}

TEST(CensusSimd, EqualsTheReference) {
  std::mt19937 random(4);
  test::for_each_isa([&](const char* isa) {
    std::vector<int> widths = test::awkward_widths();
    widths.insert(widths.end(), {4, 5, 1023, 1024, 1025, 2100});  // strips of 1024 columns
    for (const int width : widths) {
      for (const int height : {0, 1, 6, 7, 12}) {
        PaddedImage<std::uint8_t> image(width, height, 0);
        test::fill_random(image.view(), random, 0, 255);
        PaddedImage<CensusCode> expected(width, height);
        PaddedImage<CensusCode> codes(width, height);
        ASSERT_EQ(census_ref(image.view(), {0, height}, expected.view()), Status::ok);
        for (const Rows rows : {Rows{0, height / 2}, Rows{height / 2, height}})
          ASSERT_EQ(census_simd(image.view(), rows, codes.view()), Status::ok);
        ASSERT_TRUE(test::equal_images(codes.view(), expected.view())) << isa << " " << width << "x" << height;
        EXPECT_TRUE(codes.canaries_alive()) << isa << " " << width << "x" << height;
      }
    }
  });
}

TEST(CensusSimd, RefusesWrongShapes) {
  PaddedImage<std::uint8_t> image(9, 7);
  PaddedImage<CensusCode> codes(9, 8);
  EXPECT_EQ(census_simd(image.view(), {0, 7}, codes.view()), Status::size_mismatch);
  PaddedImage<CensusCode> right(9, 7);
  EXPECT_EQ(census_simd(image.view(), {0, 8}, right.view()), Status::bad_argument);
}

TEST(Census, RefusesWrongShapes) {
  PaddedImage<std::uint8_t> image(9, 7);
  PaddedImage<CensusCode> codes(9, 8);
  EXPECT_EQ(census_ref(image.view(), {0, 7}, codes.view()), Status::size_mismatch);
  PaddedImage<CensusCode> right(9, 7);
  EXPECT_EQ(census_ref(image.view(), {0, 8}, right.view()), Status::bad_argument);
}

}  // namespace
}  // namespace lakshya

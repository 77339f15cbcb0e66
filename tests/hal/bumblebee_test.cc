#include "hal/camera/bumblebee.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/bumblebee_bytes.h"
#include "tests/support/test_image.h"

namespace lakshya {
namespace {

using test::PaddedImage;

constexpr BayerPattern kPatterns[] = {BayerPattern::bggr, BayerPattern::rggb, BayerPattern::grbg,
                                      BayerPattern::gbrg};

TEST(BumblebeeBytes, EveryOtherByteIsTheOtherEyes) {
  const std::vector<std::uint8_t> bytes = {1, 11, 2, 12, 3, 13, 99, 4, 14, 5, 15, 6, 16};  // 7 bytes per line
  PaddedImage<std::uint8_t> first(3, 2);
  PaddedImage<std::uint8_t> second(3, 2);
  ASSERT_EQ(split_bytes(bytes, 7, first.view(), second.view()), Status::ok);
  EXPECT_TRUE(test::equal_images(first.view(), PaddedImage<std::uint8_t>(3, 2, {1, 2, 3, 4, 5, 6}).view()));
  EXPECT_TRUE(test::equal_images(second.view(), PaddedImage<std::uint8_t>(3, 2, {11, 12, 13, 14, 15, 16}).view()));
  EXPECT_TRUE(first.canaries_alive() && second.canaries_alive());
}

TEST(BumblebeeBytes, RandomOnesOfOddWidths) {
  std::mt19937 random(5);
  for (const int width : {1, 15, 16, 17, 31, 33, 100}) {
    PaddedImage<std::uint8_t> a(width, 5);
    PaddedImage<std::uint8_t> b(width, 5);
    test::fill_random(a.view(), random, 0, 255);
    test::fill_random(b.view(), random, 0, 255);
    PaddedImage<std::uint8_t> first(width, 5);
    PaddedImage<std::uint8_t> second(width, 5);
    const auto line = 2 * static_cast<std::size_t>(width);
    ASSERT_EQ(split_bytes(test::interleaved(a.view(), b.view()), line, first.view(), second.view()), Status::ok);
    EXPECT_TRUE(test::equal_images(first.view(), a.view())) << width;
    EXPECT_TRUE(test::equal_images(second.view(), b.view())) << width;
    EXPECT_TRUE(first.canaries_alive() && second.canaries_alive());
  }
}

TEST(BumblebeeBytes, WhatIsRefused) {
  const std::vector<std::uint8_t> bytes(12);
  PaddedImage<std::uint8_t> first(3, 2);
  PaddedImage<std::uint8_t> second(3, 2);
  PaddedImage<std::uint8_t> narrow(2, 2);
  EXPECT_EQ(split_bytes(bytes, 6, first.view(), second.view()), Status::ok);
  EXPECT_EQ(split_bytes(bytes, 6, first.view(), narrow.view()), Status::size_mismatch);
  EXPECT_EQ(split_bytes(bytes, 5, first.view(), second.view()), Status::bad_argument);
  EXPECT_EQ(split_bytes(bytes, 6, {}, {}), Status::bad_argument);
  EXPECT_EQ(split_bytes(std::span(bytes).first(11), 6, first.view(), second.view()), Status::bad_data);
  EXPECT_EQ(split_bytes(bytes, 7, first.view(), second.view()), Status::bad_data);
  EXPECT_EQ(split_bytes({}, 6, first.view(), second.view()), Status::bad_data);
}

// One bright red, green or blue pixel at (2, 2) of an RGGB mosaic, by hand: 200 of red spreads as 1, 1/2 and 1/4.
TEST(BayerGrey, OneRedPixelByHand) {
  PaddedImage<std::uint8_t> mosaic(6, 6);
  for (int v = 0; v < 6; ++v) {
    for (int u = 0; u < 6; ++u)
      mosaic.view().at(u, v) = u == 2 && v == 2 ? 200 : 0;
  }
  PaddedImage<std::uint8_t> grey(6, 6);
  ASSERT_EQ(grey_of_bayer(mosaic.view(), BayerPattern::rggb, grey.view()), Status::ok);
  // 77 * 200 / 256 = 60.2, half: 30.1, a quarter: 15.04. The border repeats.
  EXPECT_TRUE(test::equal_images(grey.view(), PaddedImage<std::uint8_t>(6, 6,
                                                                        {
                                                                            15, 15, 30, 15, 0, 0,  //
                                                                            15, 15, 30, 15, 0, 0,  //
                                                                            30, 30, 60, 30, 0, 0,  //
                                                                            15, 15, 30, 15, 0, 0,  //
                                                                            0,  0,  0,  0,  0, 0,  //
                                                                            0,  0,  0,  0,  0, 0,
                                                                        })
                                                  .view()));
  EXPECT_TRUE(grey.canaries_alive());
  // The same place is blue in BGGR: 29 * 200 / 256 = 22.7.
  ASSERT_EQ(grey_of_bayer(mosaic.view(), BayerPattern::bggr, grey.view()), Status::ok);
  EXPECT_EQ(grey.view().at(2, 2), 23);
  EXPECT_EQ(grey.view().at(1, 2), 11);
  EXPECT_EQ(grey.view().at(3, 3), 6);
  // And green in the other two: 150 * 200 / 256 = 117.2, 150 * 50 / 256 = 29.3 at the four sides, nothing at the corners.
  for (const BayerPattern pattern : {BayerPattern::grbg, BayerPattern::gbrg}) {
    ASSERT_EQ(grey_of_bayer(mosaic.view(), pattern, grey.view()), Status::ok);
    EXPECT_EQ(grey.view().at(2, 2), 117);
    EXPECT_EQ(grey.view().at(1, 2), 29);
    EXPECT_EQ(grey.view().at(2, 3), 29);
    EXPECT_EQ(grey.view().at(3, 3), 0);
  }
}

TEST(BayerGrey, OneColourEverywhereIsItsLuma) {
  for (const BayerPattern pattern : kPatterns) {
    for (const auto& [r, g, b] :
         {std::array{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {90, 90, 90}, {255, 255, 255}, {10, 200, 77}}) {
      PaddedImage<std::uint8_t> mosaic(18, 8);
      for (int v = 0; v < 8; ++v) {
        for (int u = 0; u < 18; ++u) {
          const char color = test::color_at(pattern, u, v);
          mosaic.view().at(u, v) = static_cast<std::uint8_t>(color == 'R' ? r : color == 'G' ? g : b);
        }
      }
      PaddedImage<std::uint8_t> grey(18, 8);
      ASSERT_EQ(grey_of_bayer(mosaic.view(), pattern, grey.view()), Status::ok);
      const int luma = (77 * r + 150 * g + 29 * b + 128) >> 8;
      for (int v = 0; v < 8; ++v) {
        for (int u = 0; u < 18; ++u)
          ASSERT_EQ(grey.view().at(u, v), luma) << u << ", " << v;
      }
    }
  }
}

// The definition by another road: each colour's plane first, in doubles.
TEST(BayerGrey, RandomMosaicsAreTheDefinition) {
  std::mt19937 random(8);
  for (const BayerPattern pattern : kPatterns) {
    for (const int width : {4, 16, 18, 34, 66}) {
      PaddedImage<std::uint8_t> mosaic(width, 10);
      test::fill_random(mosaic.view(), random, 0, 255);
      PaddedImage<std::uint8_t> grey(width, 10);
      ASSERT_EQ(grey_of_bayer(mosaic.view(), pattern, grey.view()), Status::ok);
      EXPECT_TRUE(grey.canaries_alive());
      for (int y = 0; y < 10; ++y) {
        for (int x = 0; x < width; ++x) {
          const int u = std::clamp(x, 1, width - 2);
          const int v = std::clamp(y, 1, 8);
          double sum[3] = {};
          int count[3] = {};
          for (const bool own : {true, false}) {
            for (int j = -1; j <= 1; ++j) {
              for (int i = -1; i <= 1; ++i) {
                const char color = test::color_at(pattern, u + i, v + j);
                const int c = color == 'R' ? 0 : color == 'G' ? 1 : 2;
                const bool centre = i == 0 && j == 0;
                const bool is_own = test::color_at(pattern, u, v) == color;
                if (is_own != own || (own && !centre)) continue;
                sum[c] += mosaic.view().at(u + i, v + j);
                ++count[c];
              }
            }
          }
          const double luma = (77 * sum[0] / count[0] + 150 * sum[1] / count[1] + 29 * sum[2] / count[2]) / 256;
          ASSERT_EQ(grey.view().at(x, y), std::floor(luma + 0.5)) << x << ", " << y << " of " << width;
        }
      }
    }
  }
}

TEST(BayerGrey, WhatIsRefusedAndGreyHeads) {
  PaddedImage<std::uint8_t> image(6, 5);
  std::mt19937 random(9);
  test::fill_random(image.view(), random, 0, 255);
  PaddedImage<std::uint8_t> grey(6, 5);
  EXPECT_EQ(grey_of_bayer(image.view(), BayerPattern::none, grey.view()), Status::ok);
  EXPECT_TRUE(test::equal_images(grey.view(), image.view()));
  EXPECT_EQ(grey_of_bayer(image.view(), BayerPattern::rggb, grey.view()), Status::bad_argument);
  PaddedImage<std::uint8_t> other(6, 4);
  EXPECT_EQ(grey_of_bayer(image.view(), BayerPattern::none, other.view()), Status::size_mismatch);
  PaddedImage<std::uint8_t> small(2, 4);
  EXPECT_EQ(grey_of_bayer(small.view(), BayerPattern::rggb, small.view()), Status::bad_argument);
}

}  // namespace
}  // namespace lakshya
